// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_term_h
#define geocone_problem_term_h

#include <geocone/conditions/jacobian_pattern.h>
#include <geocone/problem/natural_map.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Where residual() takes the stresses from. */
  struct LocalLaw
  {
    /** The materials' closed-form return maps, with a part of the normal stress on
     *  which strength depends from t_n (Increment::friction_lag). */
    double friction_lag = 0.;

    /** Or the iterate of the natural map, which moves with each residual(). */
    NaturalMap *natural_map = nullptr;

    /** Whether obstacles rub: without, a step is a start for one that does. */
    bool obstacles_rub = true;

    /** Whether what touches at the beginning stays in touch, whatever the force: a start
     *  for a step that lets it go. */
    bool contact_holds = false;
  };

  /**
   * A part of the residual R(v) of an implicit step, which is a sum of such terms:
   * what is not overridden is zero. Forces are per metre of thickness (N/m); dofs
   * that are turned (Unknowns::turned_nodes) have their components.
   */
  class Term
  {
  public:
    virtual ~Term() = default;

    /**
     * Evaluates its part of R(v), in all owned rows, and what its tangent needs.
     * @param[out] part is overwritten
     * @param v with its ghosts
     */
    virtual void
    residual(Vector &part, const Vector &v, const LocalLaw &law) = 0;

    /** Appends the squares of norms to compare a residual with, the sums on this
     *  rank: |part|^2, unless it knows better. */
    virtual void
    add_sizes(const Vector &part, std::vector<double> &sizes) const
    {
      double square = 0.;
      for (unsigned int i = 0; i < part.locally_owned_size(); ++i)
        square += part.local_element(i) * part.local_element(i);
      sizes.push_back(square);
    }

    /**
     * matrix += its part of dR/dv at the last residual().
     * @param elastic_blend w in (1 - w) C + w D, for a tangent C
     */
    virtual void
    linearise([[maybe_unused]] const JacobianPattern &pattern,
              [[maybe_unused]] const double           elastic_blend,
              [[maybe_unused]] SparseMatrix          &matrix) const
    {}

    /** dst += its part of (dR/dv) dv at the last residual(), in all owned rows.
     *  @param dv with its ghosts */
    virtual void
    apply_tangent([[maybe_unused]] Vector       &dst,
                  [[maybe_unused]] const Vector &dv) const
    {}

    /** dst += the diagonal of its part of the elastic Jacobian (kg/(m s)). */
    virtual void
    add_elastic_diagonal([[maybe_unused]] Vector &dst) const
    {}
  };
} // namespace geocone::GEOCONE_DIM

#endif
