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
  /** One line with the size of the body and the strength of each material, also
   *  relative to gamma H, the weight of a column of its height, which reveals
   *  wrong units. */
  std::string
  text_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);

  /** Warnings about sizes, densities, stiffnesses and strengths outside the
   *  range of soils, most often because of a wrong unit. */
  std::vector<std::string>
  warn_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);
} // namespace geocone::GEOCONE_DIM

#endif
