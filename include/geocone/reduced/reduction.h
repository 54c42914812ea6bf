// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduction_h
#define geocone_reduced_reduction_h

#include <geocone/problem/incremental_problem.h>
#include <geocone/reduced/reduced_problem.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Reduction of an IncrementalProblem to a ReducedProblem for its stresses (paper, eqs
   * 61, 74), and the recovery of the velocity. With v* = vL + h M^-1 F on the free dofs
   * and the prescribed velocities elsewhere, and each point's law multiplied by its
   * volume so that W is symmetric,
   *   W = V S + h^2 V B M^-1 B' V, q = -V S s_n - h V B v*,
   *   C = h^2 V B M^-1 H', L = h^2 H M^-1 H', d = h (H v* - q_H),
   * where B, M and H are those of the free dofs: W is in m^2/Pa. Its factors are G = V
   * B in cone axes and m = h^2/M.
   */
  class Reduction
  {
  public:
    /** Largest number of points with a dense W: 650 MB. */
    static constexpr unsigned int most_projected = 3000;

    /**
     * Checks that the problem can be reduced. Excluded are several ranks, problems
     * without inertia, a consistent mass, and materials without a cone. Collective.
     * @param parameter that requests the reduction, and its value
     * @param projected whether the multipliers are to be eliminated, which makes W a
     * dense matrix
     * @throws InputError
     */
    static void
    check(const IncrementalProblem &problem,
          const std::string        &parameter,
          const std::string        &value,
          const bool                projected);

    /** @param problem accepted by check() */
    explicit Reduction(const IncrementalProblem &problem);

    const ReducedProblem &
    problem() const
    {
      return reduced;
    }

    /** Stress at t_n in cone axes (Pa). */
    Eigen::VectorXd
    stress_at_start() const;

    /** Velocity v = v* - h M^-1 (B'V s - H' lambda) on the free dofs, with lambda from
     *  s, and the prescribed velocities elsewhere. */
    void
    recover_velocity(const Eigen::VectorXd &s, Vector &v) const;

  private:
    const IncrementalProblem &incremental;
    ReducedProblem            reduced;
    Vector                    velocity; ///< v*
  };
} // namespace geocone::GEOCONE_DIM

#endif
