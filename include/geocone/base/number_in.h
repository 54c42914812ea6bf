// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_number_in_h
#define geocone_base_number_in_h

#include <cstdlib>
#include <optional>
#include <string>

namespace geocone
{
  /** Parses a string as a floating-point number. Empty if the string is not a
   *  number. */
  inline std::optional<double>
  number_in(const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0')
      return std::nullopt;
    return value;
  }
} // namespace geocone

#endif
