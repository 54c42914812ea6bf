// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_frozen_problem_h
#define geocone_problem_frozen_problem_h

#include <geocone/problem/incremental_problem.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Incremental problem stored as data: the complete input of the solver in one
   * step. It contains no scene, mesh or spatial discretisation. The problem can be
   * written, read and solved again with other solver options.
   */
  struct FrozenProblem
  {
    /** Section `Materials` of the parameter file. */
    std::string materials;

    bool   particles       = false; ///< material points (moving points)
    double h               = 0.;    ///< step size (s)
    double consistent_part = 0.;    ///< fraction c of Inertia

    /** Material points, with only the data that an incremental problem uses. */
    MaterialPoints points;

    /** @name Nodal data by dof, dim dofs per node */
    /** @{ */
    /** Kind of each dof: 0 (free), Unknowns::prescribed_row or
     *  Unknowns::massless_row. */
    std::vector<int>    kind;
    std::vector<double> mass;       ///< lumped (kg/m); empty without inertia
    std::vector<double> force;      ///< F (N/m); empty without loads
    std::vector<double> velocity_L; ///< velocities vL at t_n (m/s)
    std::vector<double> prescribed; ///< velocities of prescribed dofs (m/s)
    std::vector<double> start;      ///< initial guess (m/s)
    /** @} */

    /** Stencils of the ghost stiffness (GhostStencil): three nodes per stencil.
     *  There are also three coefficients and the stiffness k (Pa) per
     *  stencil. */
    std::vector<int>    ghost_nodes;
    std::vector<double> ghost_values;

    /** Linear constraints H v = q on the velocities v of the listed dofs. */
    std::vector<int> constrained_dofs;
    Eigen::MatrixXd  H;
    Eigen::VectorXd  q;

    /** Writes the incremental problem to an HDF5 file. @throws RunError if that
     *  fails */
    void
    write(const std::string &file_name) const;

    /** Reads an incremental problem from an HDF5 file. @throws RunError naming the
     *  file and the error */
    static FrozenProblem
    read(const std::string &file_name);
  };
} // namespace geocone::GEOCONE_DIM

#endif
