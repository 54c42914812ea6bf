// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_json_h
#define geocone_output_json_h

#include <nlohmann/json.hpp>

#include <cmath>

namespace geocone
{
  /** JSON as summary.json has it: entries stay in the order in which they came. */
  using Json = nlohmann::ordered_json;

  /** A number that may have no value, e.g. the displacement of a point that has left. */
  inline Json
  finite_or_null(const double value)
  {
    return std::isfinite(value) ? Json(value) : Json();
  }
} // namespace geocone

#endif
