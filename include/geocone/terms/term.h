// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_term_h
#define geocone_terms_term_h

#include <geocone/conditions/jacobian_pattern.h>
#include <geocone/terms/natural_map.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Options that determine how IncrementalProblem::residual() evaluates
   *  stresses and contact forces. */
  struct LocalLaw
  {
    /** Weight of the lagged normal stress (at t_n) in the yield condition of
     *  the return mapping (StepData::friction_lag); 0: exact law. */
    double friction_lag = 0.;

    /** Natural map that replaces the return mapping; null if the return mapping
     *  is used. Each residual() updates it. */
    NaturalMap *natural_map = nullptr;

    /** True if contact is frictional, false if friction is omitted. The
     *  solution without friction is an initial guess for the solution with
     *  friction. */
    bool contact_friction = true;

    /** True if initially active contacts are bilateral, false if they can open.
     *  The bilateral solution is an initial guess for the solution with
     *  separation. */
    bool contact_is_bilateral = false;
  };

  /**
   * Term of the residual R(v) of an implicit step; the residual is the sum of
   * all terms. R is the sum of all terms. Member functions not overridden
   * contribute zero. Forces are per metre of thickness (N/m); at rotated dofs
   * (Unknowns::turned_nodes) they have the components along the rotated axes.
   */
  class Term
  {
  public:
    virtual ~Term() = default;

    /**
     * Evaluates the term in all owned rows and stores the data for its tangent.
     * @param[out] part value of the term
     * @param v with its ghosts
     */
    virtual void
    residual(Vector &part, const Vector &v, const LocalLaw &law) = 0;

    /** Appends the squared reference norms of the term, which normalise the
     *  residual. They are sums on this rank: |part|^2 unless overridden. */
    virtual void
    add_sizes(const Vector &part, std::vector<double> &sizes) const
    {
      double square = 0.;
      for (unsigned int i = 0; i < part.locally_owned_size(); ++i)
        square += part.local_element(i) * part.local_element(i);
      sizes.push_back(square);
    }

    /**
     * Adds the term's Jacobian dR/dv at the state of the last call to
     * residual() to the matrix.
     * @param elastic_blend w in (1 - w) C + w D, for a tangent C
     */
    virtual void
    linearise([[maybe_unused]] const JacobianPattern &pattern,
              [[maybe_unused]] const double           elastic_blend,
              [[maybe_unused]] SparseMatrix          &matrix) const
    {}

    /** Adds the term's Jacobian-vector product (dR/dv) dv at the state of the
     *  last call to residual() to dst, in all owned rows.
     *  @param dv with its ghosts */
    virtual void
    apply_tangent([[maybe_unused]] Vector       &dst,
                  [[maybe_unused]] const Vector &dv) const
    {}

    /** Groups of local nodes that are coupled in the term's Jacobian without
     *  sharing a cell. */
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
