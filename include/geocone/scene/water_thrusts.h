// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_water_thrusts_h
#define geocone_scene_water_thrusts_h

#include <geocone/scene/scene.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Warnings of thrusts of the pore water that no equation contains: in holes, on
   *  closed sides of the body, on free obstacles and on plates at a side. */
  std::vector<std::string>
  warn_of_water_thrusts(const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
