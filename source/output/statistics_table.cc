// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/output/statistics_table.h>

#include <cmath>

namespace geocone
{
  void
  check_finite(const std::string &column, const double value)
  {
    if (!std::isfinite(value))
      throw StepFailure("'" + column + "'" + not_finite_remedy);
  }
} // namespace geocone
