// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_term_h
#define geocone_problem_term_h

#include <geocone/conditions/jacobian_pattern.h>
#include <geocone/problem/natural_map.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Local law by which residual() computes the stresses. */
  struct LocalLaw
  {
    /** Closed-form return maps of the materials, with the fraction of the
     *  normal stress that determines strength taken from t_n
     *  (Increment::friction_lag). */
    double friction_lag = 0.;

    /** Alternatively, the iterate of the natural map, updated in each
     *  residual(). */
    NaturalMap *natural_map = nullptr;

    /** Whether contact has friction; a step without friction is an initial
     *  guess for one with friction. */
    bool contact_friction = true;

    /** Whether initially active contacts are bilateral, as an initial guess for
     *  a step with separation. */
    bool contact_holds = false;
  };

  /**
   * Term of the residual R(v) of an implicit step, which is a sum of such
   * terms. Functions not overridden contribute zero. Forces are per metre of
   * thickness (N/m); rotated dofs (Unknowns::turned_nodes) have their
   * components.
   */
  class Term
  {
  public:
    virtual ~Term() = default;

    /**
     * Evaluates the term in all owned rows, and the data for its tangent.
     * @param[out] part is overwritten
     * @param v with its ghosts
     */
    virtual void
    residual(Vector &part, const Vector &v, const LocalLaw &law) = 0;

    /** Appends squared reference norms for the residual, the sums on this rank:
     *  |part|^2 unless overridden. */
    virtual void
    add_sizes(const Vector &part, std::vector<double> &sizes) const
    {
      double square = 0.;
      for (unsigned int i = 0; i < part.locally_owned_size(); ++i)
        square += part.local_element(i) * part.local_element(i);
      sizes.push_back(square);
    }

    /**
     * Adds the term's dR/dv at the last residual() to the matrix.
     * @param elastic_blend w in (1 - w) C + w D, for a tangent C
     */
    virtual void
    linearise([[maybe_unused]] const JacobianPattern &pattern,
              [[maybe_unused]] const double           elastic_blend,
              [[maybe_unused]] SparseMatrix          &matrix) const
    {}

    /** Adds the term's (dR/dv) dv at the last residual() to dst, in all owned
     *  rows.
     *  @param dv with its ghosts */
    virtual void
    apply_tangent([[maybe_unused]] Vector       &dst,
                  [[maybe_unused]] const Vector &dv) const
    {}

    /** Groups of local nodes that couple in the term's matrix, besides those of
     *  cells. */
    virtual std::vector<std::vector<unsigned int>>
    node_groups() const
    {
      return {};
    }

    /** Adds the diagonal of the term's elastic Jacobian to dst (kg/(m s)). */
    virtual void
    add_elastic_diagonal([[maybe_unused]] Vector &dst) const
    {}
  };
} // namespace geocone::GEOCONE_DIM

#endif
