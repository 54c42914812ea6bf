// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_holes_h
#define geocone_geometry_holes_h

#include <geocone/geometry/geometry.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Hole of a plane body. */
  struct Hole
  {
    std::string name; ///< the given one, or "hole 0", "hole 1", ...
    Polygon     outline;
  };

  /**
   * Converts the description of the holes of a plane body to polygons. The
   * holes are separated by |. A hole is a polygon x, y; x, y; ... or circle(x,
   * y, r) or circle(x, y, r, n), which may follow a name and a colon. A circle
   * is replaced by a regular polygon whose n vertices lie on the circle,
   * counterclockwise from the lowest vertex.
   * @throws InputError if a hole is not a polygon, is not inside the outline,
   * or meets the outline or another hole
   */
  std::vector<Hole>
  holes_of(const std::string &text, const Polygon &outline);
} // namespace geocone::GEOCONE_DIM

#endif
