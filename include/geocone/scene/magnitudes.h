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
  /** The size of the body, and of each material its strength, also over gamma H, the
   *  weight of a column of its height: by them wrong units are seen. One line. */
  std::string
  text_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);

  /** Warnings of sizes, densities, stiffnesses and strengths that no soil has: most often
   *  their unit is another one than the parameter's. */
  std::vector<std::string>
  warn_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body);
} // namespace geocone::GEOCONE_DIM

#endif
