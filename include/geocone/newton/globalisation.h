// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_globalisation_h
#define geocone_newton_globalisation_h

#include <geocone/newton/contact_direction.h>
#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /** Line search along v + x d, from an iterate v in the Newton direction d. */
  class NewtonLine
  {
  public:
    NewtonLine(const StepWorkspace &work, const LocalLaw &law);

    /** Sets the starting point v of the line search to the current iterate. */
    void
    begin()
    {
      start = work.v;
    }

    /** Moves the iterate to v + x d (step length x, Newton direction d) and
     *  evaluates the residual at the new iterate. */
    void
    move(const double x);

    /** Directional residual R.d at the current iterate, along the Newton
     *  direction d. For associated flow it is the derivative of a convex
     *  function along d. A ContactDirection defines its own slope. */
    double
    slope() const
    {
      return contact != nullptr
               ? contact->slope(direction)
               : work.problem.free_dot(work.residual, direction);
    }

    /** Merit function sum R_i^2 / D_i of the residual R at the current iterate,
     *  with the diagonal D of the elastic Jacobian. */
    double
    merit() const
    {
      return work.problem.merit(work.residual);
    }

    Vector                  direction;         ///< d
    const ContactDirection *contact = nullptr; ///< null: linearised contact
    ResidualReport          state;             ///< R at the iterate

  private:
    const StepWorkspace &work;
    const LocalLaw      &law;
    Vector               start;
  };

  /**
   * Base class of globalisation strategies for Newton's method. A strategy
   * selects the step length along a Newton direction and the fraction of
   * elastic stiffness blended into the tangent. This base class performs full
   * steps with the unmodified tangent.
   */
  class Globalisation
  {
  public:
    virtual ~Globalisation() = default;

    /**
     * Weight w of the elastic stiffness D in the tangent (1 - w) C + w D for
     * the next Newton direction.
     * @param residual relative residual (by the norm of the forces)
     */
    virtual double
    blend(const double residual) const;

    /** Moves the iterate along the search direction. @return the step length
     *  x */
    virtual double
    move(NewtonLine &line);

    /** Returns true if only descent directions (NewtonLine::slope() < 0) are
     *  accepted. */
    virtual bool
    needs_descent() const
    {
      return false;
    }
  };

  /** Globalisation by a line search; see line_search(). */
  class LineSearch : public Globalisation
  {
  public:
    double
    move(NewtonLine &line) override;

    bool
    needs_descent() const override
    {
      return true;
    }
  };

  /** Globalisation by full Newton steps with a blend of tangent and elastic
   *  stiffness. The weight w = min(1/2, c |R_free| / |B'V s|) vanishes with the
   *  residual. */
  class ElasticBlend : public Globalisation
  {
  public:
    /** Empirical factors c in the weight w = min(1/2, c |R_free| / |B'V s|) of
     *  the elastic stiffness, with residual R_free and internal forces B'V
     *  s. */
    static constexpr double with_return_map = 0.3, with_natural_map = 0.05;

    /** @param factor c */
    explicit ElasticBlend(const double factor)
      : factor(factor)
    {}

    double
    blend(const double residual) const override;

  private:
    double factor;
  };

  /** Globalisation by halving the step length until the merit function
   *  decreases. While the merit function does not decrease, elastic stiffness
   *  is blended into the tangent, w = max(0.02, 3 w). */
  class MeritSearch : public Globalisation
  {
  public:
    double
    blend(const double residual) const override;
    double
    move(NewtonLine &line) override;

  private:
    double damping = 0.; ///< w
  };
} // namespace geocone::GEOCONE_DIM

#endif
