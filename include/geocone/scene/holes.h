// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_holes_h
#define geocone_scene_holes_h

#include <geocone/scene/geometry.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Holes of a plane body, separated by |: polygons x, y; x, y; ... or
   * circle(x, y, r), circle(x, y, r, n), a regular polygon whose n vertices lie
   * on the circle, from its lowest vertex on counterclockwise.
   *
   * @throws InputError if one of them is no polygon, is not inside the outline,
   * or meets the outline or another hole
   */
  std::vector<Polygon>
  holes_of(const std::string &text, const Polygon &outline);
} // namespace geocone::GEOCONE_DIM

#endif
