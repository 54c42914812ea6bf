// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bound_solution_h
#define geocone_plane_bounds_bound_solution_h

#include <geocone/conic/conic_solver.h>
#include <geocone/plane_bounds/bound_problem.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Result of the interior-point method for a plane problem of limit analysis. */
  struct BoundSolution : ConicSolution
  {
    std::vector<Eigen::Vector3d> s; ///< stress of each point in cone axes
  };

  /** Solves a plane problem of limit analysis as a conic problem, with the cones and the
   *  cylinders (PlaneCone, PlaneCylinder) of its points in a group each. */
  BoundSolution
  solve(const BoundProblem &plane, const ConicOptions &options);
} // namespace geocone::GEOCONE_DIM

#endif
