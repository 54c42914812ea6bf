// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_magnitudes_h
#define geocone_scene_magnitudes_h

#include <geocone/scene/scene.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Returns a line of text with the size of the body and the strength of each
   *  material. The strength is also given relative to gamma H, i.e. unit weight
   *  times height of the body. The values reveal input in wrong units. */
  std::string
  text_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);

  /** Returns warnings about dimensions, densities, stiffnesses and strengths
   *  outside the usual range of soils, whose most frequent cause is a wrong
   *  unit, and those of warn_of_water_thrusts(). */
  std::vector<std::string>
  warn_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);
} // namespace geocone::GEOCONE_DIM

#endif
