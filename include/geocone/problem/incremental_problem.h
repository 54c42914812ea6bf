// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_incremental_problem_h
#define geocone_problem_incremental_problem_h

#include <geocone/contact/contact.h>
#include <geocone/linear/nodal_rows.h>
#include <geocone/terms/bars.h>
#include <geocone/terms/external_forces.h>
#include <geocone/terms/ghost_stiffness.h>
#include <geocone/terms/inertia.h>
#include <geocone/terms/internal_forces.h>
#include <geocone/terms/step_traits.h>

#include <memory>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  struct FrozenProblem;

  /** Norms and counts of an evaluated residual, summed over the ranks. */
  struct ResidualReport
  {
    double       norm       = 0.; ///< Euclidean norm over the free rows (N/m)
    double       force_norm = 0.; ///< largest norm of a term of R (N/m)
    unsigned int n_cone     = 0;  ///< points on the smooth part of the cone
    unsigned int n_apex     = 0;  ///< points at the apex
    unsigned int n_switched = 0;  ///< points whose mode has switched

    double local_error = 0.; ///< see InternalForces::local_error()

    /** Residual norm of the contact equations and sum of the reference forces
     *  Contact::NodalContact::size (N/m), both over the potential contact nodes.
     *  Contact forces can be small compared with the internal forces of the
     *  soil. */
    double contact_norm = 0., contact_size = 0.;
  };

  /**
   * Nonlinear problem of an implicit time step (backward Euler) for the nodal
   * velocities v. At the free dofs,
   *   R(v) = M (v - vL)/h + sum_p V_p B_p' s_p(v) - F - H' lambda,   H v = q.
   * The residual is a sum of terms (Inertia, InternalForces, ExternalForces,
   * GhostStiffness) and of the reactions of linear constraints; prescribed
   * velocities are eliminated. The multipliers are functions of v: they
   * minimise the residual in the metric of scale(), and at the solution they
   * are the exact multipliers. The problem consists of points, weights,
   * gradients and constraints, independent of FEM or MPM. The state at t_n is
   * const; trial states are stored in the terms and belong to the last
   * residual(). In the rows of potential contact nodes, Contact replaces R by
   * its equations.
   */
  class IncrementalProblem
  {
  public:
    /**
     * Creates the terms of the residual.
     * @param lumped_mass the diagonal of Inertia, or null for a quasi-static
     * problem
     * @param consistent_part c of Inertia, nonzero only for points with N and
     * mass
     * @param ghosts stencils of GhostStiffness
     * @param has_contact whether there may be contact, the same on all ranks
     */
    IncrementalProblem(
      const MaterialPoints &points,
      const Materials      &materials,
      const Unknowns       &unknowns,
      const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout,
      const Vector             *lumped_mass,
      const double              consistent_part = 0.,
      std::vector<GhostStencil> ghosts          = {},
      const bool                has_contact     = false);

    /** Appends a term to the residual. The term must outlive the problem. */
    void
    add(Term &term)
    {
      terms.push_back(&term);
    }

    /** Appends the bars of the scene as a term of the residual. They must
     *  outlive the problem. */
    void
    add(Bars &of_scene)
    {
      bars = &of_scene;
      terms.push_back(bars);
    }

    /** Adds excess pore pressures to the unknowns. They must outlive the
     *  problem. */
    void
    add(PorePressures &pressures)
    {
      pore_pressures = &pressures;
      internal.take_pressures(pressures);
    }

    /** Excess pore pressures that are unknowns of the problem; null without
     *  consolidation. */
    PorePressures *
    pressures() const
    {
      return pore_pressures;
    }

    bool
    has_bars() const
    {
      return bars != nullptr;
    }

    /** Not copyable, because the terms hold references to data of the
     *  problem. */
    IncrementalProblem(const IncrementalProblem &) = delete;

    /**
     * Sets the loads, prescribed velocities and contacts of a step of size h.
     * @param force F at the end of the step, or null for none
     * @param velocity_L vL, velocities at t_n
     * @param prescribed prescribed velocities at the end of the step
     * @param touching potential contacts, see Contact
     */
    void
    begin_step(const double  h,
               const Vector *force,
               const Vector &velocity_L,
               const Vector &prescribed,
               ContactStep   touching = {});

    /**
     * Evaluates the trial states of the points and the residual R(v), with the
     * options of LocalLaw. In the rows of prescribed dofs R is the reaction; in
     * the rows of contact nodes, F of Contact. The ghosts of @p v must be up to
     * date.
     */
    ResidualReport
    residual(Vector &dst, const Vector &v, const LocalLaw &law = {});

    /** Creates a natural map, which can replace the return mapping in
     *  residual(). Arguments as for NaturalMap. */
    NaturalMap
    make_natural_map(const double rho, const std::vector<Mandel> &start) const
    {
      return NaturalMap(points, materials, {h}, rho, start);
    }

    /** Features of the current step that determine the solution strategy, combined
     *  over all ranks. Collective. */
    StepTraits
    traits() const;

    /** Returns true if the Jacobian is symmetric positive definite. It is
     *  indefinite if pore pressures are unknowns. */
    bool
    is_symmetric() const
    {
      return materials.traits().symmetric && !contact_term && !pore_pressures;
    }

    bool
    has_inertia() const
    {
      return inertia.has_value();
    }

    /**
     * Creates a sparse matrix with the sparsity pattern of the Jacobian on the free
     * dofs. Its entries are zero.
     * @param one_triangle whether only the lower triangle of a symmetric Jacobian
     * is stored
     * @param shares_columns see SparseMatrix::column_start
     */
    SparseMatrix
    make_pattern(const bool one_triangle, const bool shares_columns = false);

    /** Global index of the node to which each row of the Jacobian belongs, for
     *  algebraic multigrid. Collective. */
    NodalRows
    nodal_rows() const;

    /** Returns true if the Jacobian of this step requires a new sparsity
     *  pattern. This is so if other dofs are coupled than in the last pattern.
     *  Collective with contact. */
    bool
    needs_pattern() const;

    /**
     * Assembles the generalised Jacobian dR/dv = M/h + h sum V B' C B at the
     * state of the last call to residual(), with the tangents C of the points.
     * The tangent C is replaced by (1 - w) C + w D, w the elastic blend.
     * @return low-rank contribution of free obstacles or of bars
     */
    LowRank
    linearise(SparseMatrix &matrix, const double elastic_blend = 0.) const;

    /** Computes the Jacobian-vector product dst = (dR/dv) dv in all rows, at
     *  the state of the last call to residual(). */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Sets the prescribed components of the velocity v to their values at the end
     *  of the step. */
    void
    set_prescribed(Vector &v) const;

    const Unknowns &
    free_dofs() const
    {
      return unknowns;
    }

    /** Lagrange multipliers lambda of the constraints H v = q at the state of
     *  the last call to residual() (N/m). */
    const Eigen::VectorXd &
    multipliers() const
    {
      return lambda;
    }

    /** Inertia term of the residual. It exists only in a dynamic problem. */
    const Inertia &
    inertia_term() const
    {
      return *inertia;
    }

    bool
    has_contact() const
    {
      return contact_term.has_value();
    }

    /** @name Contact term; only for problems with possible contact */
    /** @{ */
    const Contact &
    contact() const
    {
      return *contact_term;
    }
    Contact &
    contact()
    {
      return *contact_term;
    }
    /** @} */

    const GhostStiffness &
    ghost_stiffness() const
    {
      return ghost;
    }

    /** Internal forces of the step, with the trial states of the points. */
    const InternalForces &
    internal_forces() const
    {
      return internal;
    }

    /** Stresses of all material points at t_n. */
    const std::vector<Mandel> &
    stress_at_start() const
    {
      return points.stress;
    }

    /** Diagonal of the elastic Jacobian M/h + h sum V B'DB (kg/(m s)), with
     *  mass M, step size h and elastic stiffness D. */
    const Vector &
    scale();

    /** Merit function sum R_i^2 / scale_i over the free dofs, with the residual
     *  R and the diagonal scale(). */
    double
    merit(const Vector &residual);

    /** Scalar product a.b over the free dofs of all ranks. */
    double
    free_dot(const Vector &a, const Vector &b) const;

    /** Creates a zero vector with the parallel layout of velocities and forces. */
    Vector
    make_vector() const
    {
      return Vector(layout);
    }

    /** Size h of the time step (s). */
    double
    time_step() const
    {
      return h;
    }

    /**
     * Exports the incremental problem as data on the first rank. Data of the
     * time stepper are not included (parameters of materials, whether points
     * move). Collective.
     */
    FrozenProblem
    freeze(const Vector &start) const;

  private:
    /** Friend, since Reduction needs all data to formulate the problem with
     *  stresses as the unknowns. */
    friend class Reduction;

    const MaterialPoints                                            &points;
    const Materials                                                 &materials;
    const Unknowns                                                  &unknowns;
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    InternalForces         internal;
    ExternalForces         external;
    std::optional<Inertia> inertia;
    GhostStiffness         ghost;
    std::optional<Contact> contact_term;
    std::vector<Term *>    terms;          ///< terms of the residual
    Bars                  *bars = nullptr; ///< null without bars
    PorePressures         *pore_pressures = nullptr;

    bool of_particles = false;

    double h = 0.;
    Vector velocity_L;
    Vector prescribed;

    Vector          part;             ///< value of a term in residual()
    Vector          elastic_diagonal; ///< scale() for the current h, or empty
    Eigen::VectorXd lambda;
    JacobianPattern pattern;

    using Links = std::vector<std::vector<unsigned int>>;
    Links links_now; ///< Contact::links() of the current step
    Links links;     ///< Contact::links() of the last pattern

    /** Factorisation of the constraint matrix H for the current step, in the
     *  metric of the diagonal scale(). It can be empty. */
    Multipliers::Factors row_factors;
  };
} // namespace geocone::GEOCONE_DIM

#endif
