// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_time_in_bounds_h
#define geocone_bounds_time_in_bounds_h

#include <geocone/scene/scene.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Returns warnings of what bounds do not know, since they have neither time nor
   *  stages: tractions that depend on time, of which the values at t = 0 count,
   *  and changes of the body and of its water by stages. */
  std::vector<std::string>
  warn_of_time_in_bounds(const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
