// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_folder_json_h
#define geocone_folder_json_h

#include <nlohmann/json.hpp>

#include <cmath>

namespace geocone
{
  /** JSON object whose entries keep their order of insertion, as in
   *  summary.json. */
  using Json = nlohmann::ordered_json;

  /** Converts a number to JSON, or to null if the number is not finite. An
   *  example is the displacement of a point that has left the mesh. */
  inline Json
  finite_or_null(const double value)
  {
    return std::isfinite(value) ? Json(value) : Json();
  }
} // namespace geocone

#endif
