// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduction_h
#define geocone_reduced_reduction_h

#include <geocone/problem/incremental_problem.h>
#include <geocone/reduced/reduced_problem.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Reduces an incremental problem in velocities to a problem in stresses, and recovers
   * the velocities (Guillet et al. 2025, eqs 61, 74). With v* = vL + h M^-1 F at the
   * free dofs and the prescribed velocities at the other dofs, and the law of each
   * point multiplied by the volume of the point so that W is symmetric,
   *   W = V S + h^2 V B M^-1 B' V, q = -V S s_n - h V B v*,
   *   C = h^2 V B M^-1 H', L = h^2 H M^-1 H', d = h (H v* - q_H),
   * with B, M and H of the free dofs; W is in m^2/Pa. The factors of W are G = V B in
   * cone axes and m = h^2/M.
   */
  class Reduction
  {
  public:
    /** Maximum number of material points for a dense matrix W (650 MB). */
    static constexpr unsigned int most_projected = 3000;

    /**
     * Checks that an incremental problem can be reduced to a problem in the
     * stresses alone. Not supported are several ranks, problems without
     * inertia, a consistent mass matrix, and materials without a cone.
     * Collective.
     * @param parameter name of the parameter that requests the reduction, with its value
     * @param projected whether the multipliers are to be eliminated, which makes W a
     * dense matrix
     * @throws InputError
     */
    static void
    check(const IncrementalProblem &problem,
          const std::string        &parameter,
          const std::string        &value,
          const bool                projected);

    /** Computes the matrices of the reduced problem.
     *  @param problem accepted by check() */
    explicit Reduction(const IncrementalProblem &problem);

    const ReducedProblem &
    problem() const
    {
      return reduced;
    }

    /** Stresses at t_n in cone axes (Pa), the initial guess of the solvers. */
    Eigen::VectorXd
    stress_at_start() const;

    /** Computes the nodal velocities v from stresses s. At the free dofs
     *  v = v* - h M^-1 (B'V s - H' lambda) with lambda = multipliers(s), and at the
     *  other dofs v is the prescribed velocity. */
    void
    recover_velocity(const Eigen::VectorXd &s, Vector &v) const;

  private:
    const IncrementalProblem &incremental;
    ReducedProblem            reduced;
    Vector                    velocity; ///< v*
  };
} // namespace geocone::GEOCONE_DIM

#endif
