// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_newton_loop_h
#define geocone_newton_newton_loop_h

#include <geocone/newton/globalisation.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * The semismooth Newton iteration for R(v) = 0 by one local law, with the
   * generalised Jacobian of that law. The change of the prescribed velocities and
   * the defect of the constraints H v = q enter the first linear system, whose
   * step is full. Convergence: |R_free| <= max(tolerance x greatest norm of a part
   * of R, absolute), or StepWorkspace::is_balanced() up to rounding.
   */
  struct NewtonLoop
  {
    /**
     * Relative residual at which an iterate is near enough to a solution to go on
     * from: with another law, or beyond the iterations that were allowed.
     */
    static constexpr double near = 1e-3;

    /** Relative residual above which it is far from one. */
    static constexpr double far = 0.1;

    LocalLaw     law;
    double       tolerance          = 1e-10; ///< relative
    double       absolute_tolerance = 1e-12; ///< (N/m)
    unsigned int allowed            = 60;    ///< iterations; twice if near
    /** Iterations while no point flows, so that only contact is not linear. */
    unsigned int allowed_without_flow =
      std::numeric_limits<unsigned int>::max();
    /** Iterations after which an iterate that is far is given up. */
    unsigned int allowed_if_far = std::numeric_limits<unsigned int>::max();

    bool elastic_first = false; ///< takes D as the first tangent
    bool moves         = false; ///< solves once at least
    bool exact_contact = false; ///< takes directions of ContactDirection

    /** Runs from the iterate; what it spends is added to the report. */
    void
    run(Globalisation &globalisation, const StepWorkspace &work) const;

  private:
    /** Factorises with a blend, or with as little more as makes it regular.
     *  @return the blend, or nothing if it stays singular */
    static std::optional<double>
    factorise(const double wanted, const StepWorkspace &work);

    /** Says in the report why no more iterations are made. */
    static void
    give_up(const ResidualReport &state, const StepWorkspace &work);
  };
} // namespace geocone::GEOCONE_DIM

#endif
