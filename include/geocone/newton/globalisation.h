// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_globalisation_h
#define geocone_newton_globalisation_h

#include <geocone/newton/contact_direction.h>
#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /** A line v + x d from an iterate along a Newton direction. */
  class NewtonLine
  {
  public:
    NewtonLine(const StepWorkspace &work, const LocalLaw &law);

    /** Starts at the present iterate. */
    void
    begin()
    {
      start = work.v;
    }

    /** Moves the iterate to v + x d and evaluates the residual there. */
    void
    move(const double x);

    /** Slope R.d at the iterate: for associated flow the slope of a convex
     *  function. A ContactDirection has its own. */
    double
    slope() const
    {
      return contact != nullptr
               ? contact->slope(direction)
               : work.problem.free_dot(work.residual, direction);
    }

    /** Merit function sum R_i^2 / D_i at the iterate, D the diagonal of the
     *  elastic Jacobian. */
    double
    merit() const
    {
      return work.problem.merit(work.residual);
    }

    Vector                  direction;         ///< d
    const ContactDirection *contact = nullptr; ///< that made it, if one did
    ResidualReport          state;             ///< at the iterate

  private:
    const StepWorkspace &work;
    const LocalLaw      &law;
    Vector               start;
  };

  /**
   * Globalisation of Newton's method: the step length along its directions, and
   * the part of the elastic stiffness blended into its tangent. This base class
   * takes full steps with the unmodified tangent.
   */
  class Globalisation
  {
  public:
    virtual ~Globalisation() = default;

    /**
     * Part w of the elastic stiffness in the tangent (1 - w) C + w D of the
     * next direction.
     * @param residual relative to the forces
     */
    virtual double
    blend(const double residual) const;

    /** Moves the iterate. @return the length x of the step */
    virtual double
    move(NewtonLine &line);

    /** Whether directions must be descent directions, NewtonLine::slope() <
     *  0. */
    virtual bool
    needs_descent() const
    {
      return false;
    }
  };

  /** Globalisation by line_search(). */
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

  /** Globalisation by full steps with w = min(1/2, c |R_free| / |B'V s|), which
   *  vanishes with the residual. */
  class ElasticBlend : public Globalisation
  {
  public:
    /** Values of c that proved effective. */
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

  /** Globalisation by halving steps until the merit function decreases. If that
   *  stalls, the tangent is blended, w = max(0.02, 3 w), until it succeeds
   *  again. */
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
