// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_newton_loop_h
#define geocone_newton_newton_loop_h

#include <geocone/newton/globalisation.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Semismooth Newton iteration for R(v) = 0 with a generalised Jacobian. The
   * change of the prescribed velocities and the defect of the constraints H v =
   * q enter the first linear system, followed by a full step. Convergence
   * criterion:
   *   |R_free| <= max(tolerance x largest norm of a term of R, absolute),
   * or StepWorkspace::is_balanced() up to rounding.
   */
  struct NewtonLoop
  {
    /**
     * Threshold of the relative residual below which an iterate is used as the
     * initial guess of the next attempt. Iterations beyond the allowed number
     * are then justified.
     */
    static constexpr double near_tolerance = 1e-3;

    /** Threshold of the relative residual above which an iterate is considered
     *  far from a solution. */
    static constexpr double far_threshold = 0.1;

    LocalLaw     law;
    double       tolerance          = 1e-10; ///< relative, for |R_free|
    double       absolute_tolerance = 1e-12; ///< for |R_free| (N/m)
    unsigned int allowed            = 60;    ///< iterations; doubled if near
    /** Maximum number of iterations while no point yields and contact is the
     *  only nonlinearity. */
    unsigned int allowed_without_flow =
      std::numeric_limits<unsigned int>::max();
    /** Number of iterations after which the loop terminates if the iterate is
     *  far from a solution. */
    unsigned int allowed_if_far = std::numeric_limits<unsigned int>::max();

    bool elastic_first = false; ///< starts with the elastic tangent D
    bool moves         = false; ///< performs at least one iteration
    bool exact_contact = false; ///< contact laws by ContactDirection

    /** Performs Newton iterations from the current iterate. The numbers of
     *  iterations and factorisations are added to the report. */
    void
    run(Globalisation &globalisation, const StepWorkspace &work) const;

  private:
    /** Factorises the Jacobian with a requested fraction of elastic stiffness.
     *  If the matrix is singular, the smallest larger blend with a regular
     *  matrix is used.
     *  @return the blend used; empty if the matrix remains singular */
    static std::optional<double>
    factorise(const double wanted, const StepWorkspace &work);

    /** Reports why the iteration terminated without convergence. */
    static void
    give_up(const ResidualReport &state, const StepWorkspace &work);
  };
} // namespace geocone::GEOCONE_DIM

#endif
