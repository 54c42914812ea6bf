// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_inertia_h
#define geocone_terms_inertia_h

#include <geocone/terms/term.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Inertia term M (v - vL)/h of the residual, with the mass matrix M and the
   * initial velocity vL of the step. The mass matrix is M = (1 - c) diag(m) + c
   * M_c, with M_c the sum of m_p N_p' N_p over the points.
   */
  class Inertia : public Term
  {
  public:
    /**
     * Creates the inertia term.
     * @param lumped_mass m, by dof
     * @param consistent_part c, nonzero only for points with N and mass
     */
    Inertia(const MaterialPoints &points,
            const Unknowns       &unknowns,
            const Vector         &lumped_mass,
            const double          consistent_part);

    /** Sets the step size and the velocities vL of a step. @param step size h (s)
     *  @param velocity_n vL, which must outlive the step */
    void
    begin_step(const double step, const Vector &velocity_n);

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    /** Appends the squared reference norms of the inertia term, which include a
     *  fraction 1e-6 of |M vL/h|^2. The latter is the only nonzero reference of
     *  a body in free flight. */
    void
    add_sizes(const Vector &part, std::vector<double> &sizes) const override;

    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    void
    apply_tangent(Vector &dst, const Vector &dv) const override;

    void
    add_elastic_diagonal(Vector &dst) const override;

    /** Computes the product dst = M x with the mass matrix M in all rows. The
     *  ghosts of
     *  @p x must be up to date. */
    void
    apply_mass(Vector &dst, const Vector &x) const;

    const Vector &
    lumped_mass() const
    {
      return mass;
    }

    /** Fraction c of the consistent mass matrix in the mass matrix M; the
     *  remaining fraction is lumped. */
    double
    consistent_part() const
    {
      return consistent;
    }

  private:
    const MaterialPoints &points;
    const Unknowns       &unknowns;
    const Vector         &mass;
    const double          consistent;
    double                h          = 0.;
    const Vector         *velocity_L = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
