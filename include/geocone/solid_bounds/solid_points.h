// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_points_h
#define geocone_solid_bounds_solid_points_h

#include <geocone/solid_bounds/solid_bounds.h>

/** Points and forces of both problems of three-dimensional bodies. */
namespace geocone::GEOCONE_DIM
{
  using SolidPoints =
    CellPoints<12, MohrCoulombCones, CircularCone, CutMohrCoulombCones>;

  /** Cone of a material with a tensile strength. */
  CutMohrCoulombCones
  cut_law(const SpatialStrength &one);

  /** Groups of the points of cells, without points. */
  SolidPoints
  empty_points(const SolidScene &bound);

  /** Least strength of the initial stresses (ConicProblem). */
  double
  least_start(const SolidScene &bound);

  /** sym(b x g) of the unit vector b along a component. */
  Eigen::Matrix<double, 6, 1>
  symmetric_product(const unsigned int            component,
                    const dealii::Tensor<1, dim> &g);

  /** Adds a force to a node. @param dof of its x component */
  void
  add_load(ConicProblem           &problem,
           const unsigned int      dof,
           const SolidScene::Load &load);

  inline SolidScene::Load
  operator*(const double a, const SolidScene::Load &load)
  {
    return {a * load.dead, a * load.live};
  }
} // namespace geocone::GEOCONE_DIM

#endif
