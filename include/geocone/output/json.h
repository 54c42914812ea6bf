// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_json_h
#define geocone_output_json_h

#include <nlohmann/json.hpp>

#include <cmath>

namespace geocone
{
  /** JSON object that keeps the order of insertion of its entries, as in
   *  summary.json. */
  using Json = nlohmann::ordered_json;

  /** JSON number, or null if the value is not finite, e.g. the displacement of a
   *  point that has left the mesh. */
  inline Json
  finite_or_null(const double value)
  {
    return std::isfinite(value) ? Json(value) : Json();
  }
} // namespace geocone

#endif
