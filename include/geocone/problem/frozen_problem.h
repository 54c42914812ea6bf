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
   * An incremental problem as data: all input of the solver in a step, without
   * the scene, the mesh and the method. It can be written, read and solved
   * again with other options.
   */
  struct FrozenProblem
  {
    /** Section `Materials` of the parameter file. */
    std::string materials;

    bool   particles       = false; ///< whether the points moved
    double h               = 0.;    ///< step (s)
    double consistent_part = 0.;    ///< of the mass, c of Inertia

    /** Only the data used by an incremental problem. */
    MaterialPoints points;

    /** @name By dof, dim per node */
    /** @{ */
    /** Kind: 0, Unknowns::prescribed_row or Unknowns::massless_row. */
    std::vector<int>    kind;
    std::vector<double> mass;       ///< lumped (kg/m); empty without inertia
    std::vector<double> force;      ///< F (N/m); empty without loads
    std::vector<double> velocity_L; ///< vL (m/s)
    std::vector<double> prescribed; ///< of prescribed dofs (m/s)
    std::vector<double> start;      ///< initial guess (m/s)
    /** @} */

    /** GhostStencil by stencil: three nodes; three coefficients and k. */
    std::vector<int>    ghost_nodes;
    std::vector<double> ghost_values;

    /** Rows H v = q over these dofs. */
    std::vector<int> constrained_dofs;
    Eigen::MatrixXd  H;
    Eigen::VectorXd  q;

    /** Writes an HDF5 file. @throws RunError */
    void
    write(const std::string &file_name) const;

    /** Reads a file. @throws RunError naming the file and the error in it */
    static FrozenProblem
    read(const std::string &file_name);
  };
} // namespace geocone::GEOCONE_DIM

#endif
