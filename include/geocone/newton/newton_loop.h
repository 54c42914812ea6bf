// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_newton_loop_h
#define geocone_newton_newton_loop_h

#include <geocone/newton/globalisation.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Semismooth Newton iteration for R(v) = 0 with one local law and its
   * generalised Jacobian. The change of the prescribed velocities and the
   * defect of the constraints H v = q enter the first linear system, whose step
   * is full. Convergence:
   *   |R_free| <= max(tolerance x greatest norm of a part of R, absolute),
   * or StepWorkspace::is_balanced() up to rounding.
   */
  struct NewtonLoop
  {
    /**
     * Relative residual below which an iterate is a useful initial guess for
     * another law, or worth continuing beyond the allowed iterations.
     */
    static constexpr double near = 1e-3;

    /** Relative residual above which an iterate is far from a solution. */
    static constexpr double far = 0.1;

    LocalLaw     law;
    double       tolerance          = 1e-10; ///< relative
    double       absolute_tolerance = 1e-12; ///< (N/m)
    unsigned int allowed            = 60;    ///< iterations; doubled if near
    /** Allowed iterations while no point yields, so that only contact is
     *  nonlinear. */
    unsigned int allowed_without_flow =
      std::numeric_limits<unsigned int>::max();
    /** Iterations after which an iterate far from a solution is abandoned. */
    unsigned int allowed_if_far = std::numeric_limits<unsigned int>::max();

    bool elastic_first = false; ///< uses D as the first tangent
    bool moves         = false; ///< at least one iteration
    bool exact_contact = false; ///< with ContactDirection

    /** Iterates from the present iterate; adds its cost to the report. */
    void
    run(Globalisation &globalisation, const StepWorkspace &work) const;

  private:
    /** Factorises with the given blend, or the least larger one that makes the
     *  matrix regular.
     *  @return the blend, or nothing if it remains singular */
    static std::optional<double>
    factorise(const double wanted, const StepWorkspace &work);

    /** Records in the report why the iteration terminates. */
    static void
    give_up(const ResidualReport &state, const StepWorkspace &work);
  };
} // namespace geocone::GEOCONE_DIM

#endif
