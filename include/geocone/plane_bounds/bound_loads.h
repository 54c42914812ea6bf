// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bound_loads_h
#define geocone_plane_bounds_bound_loads_h

#include <geocone/plane_bounds/bound_problem.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Calls f(component, value) for the velocities prescribed by a condition at x, in
   *  scaled units. @param n outward normal */
  void
  for_prescribed(const BoundaryCondition                         &condition,
                 const dealii::Point<dim>                        &x,
                 const dealii::Tensor<1, dim>                    &n,
                 const double                                     unit,
                 const std::function<void(unsigned int, double)> &f);

  /** Returns the self-weight of a cell per unit area, in scaled units. */
  dealii::Tensor<1, dim>
  weight_of_cell(const BoundScene &scene, const unsigned int cell);

  /** Returns the seepage force of a cell per unit area, in scaled units: that of the water,
   *  or of its pressures at the vertices with linear pressures between them. */
  dealii::Tensor<1, dim>
  seepage_force_of_cell(const BoundScene &scene, const unsigned int cell);

  /** Adds a body force to the load vector F of a problem, in scaled units. The force per
   *  unit area is constant in the cell. */
  void
  add_force_of_cell(const BoundScene             &scene,
                    const BoundSide               side,
                    const unsigned int            cell,
                    const dealii::Tensor<1, dim> &force,
                    Eigen::VectorXd              &F);

  /** Adds a traction boundary condition to the load vector F of a problem, in scaled
   *  units. @param time at which it acts (s) */
  void
  add_tractions(const BoundScene        &scene,
                const BoundSide          side,
                const BoundaryCondition &load,
                Eigen::VectorXd         &F,
                const double             time = 0.);

  /** Returns the maximum magnitude of a traction boundary condition over the loaded
   *  vertices (Pa). */
  double
  largest_traction(const BoundScene &scene, const BoundaryCondition &load);

  /** Largest departure of a traction from its linear interpolation between the
   *  vertices, at some points of the edges, over its largest value. Both bounds are those
   *  of slightly different loads where it is not zero. @param time (s) */
  double
  departure_of_traction(const BoundScene        &scene,
                        const BoundaryCondition &load,
                        const double             time = 0.);

  /** Adds the forces of a cell: weight, and the force of water, which is a dead load
   *  unless the weight is bounded with all other loads. */
  void
  add_body_forces(BoundProblem      &problem,
                  const BoundScene  &bound,
                  const BoundSide    side,
                  const unsigned int cell);

  /** chi u of Bishop's effective stress at the vertices of a cell, linear between
   *  them, in units of stress; no value where suction adds no strength. */
  std::optional<std::array<double, 3>>
  suction_of_cell(const BoundScene &bound, const unsigned int cell);

  /** Adds the power of a suction p at a point with rates B q: the volume times p div
   *  v. */
  void
  add_suction(BoundProblem                    &problem,
              const BoundScene                &bound,
              const double                     volume,
              const double                     p,
              const StrainMatrix              &B,
              const std::vector<unsigned int> &dofs);

  /** Prescribes the velocities of boundary conditions and adds tractions. */
  void
  apply_conditions(const BoundScene &bound,
                   const BoundSide   side,
                   BoundProblem     &problem);
} // namespace geocone::GEOCONE_DIM

#endif
