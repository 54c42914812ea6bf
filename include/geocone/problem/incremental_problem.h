// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_incremental_problem_h
#define geocone_problem_incremental_problem_h

#include <geocone/contact/contact.h>
#include <geocone/linear/nodal_rows.h>
#include <geocone/problem/bars.h>
#include <geocone/problem/external_forces.h>
#include <geocone/problem/ghost_stiffness.h>
#include <geocone/problem/inertia.h>
#include <geocone/problem/internal_forces.h>
#include <geocone/problem/step_traits.h>

#include <memory>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  struct FrozenProblem;

  /** Results of residual(), summed over the ranks. */
  struct ResidualReport
  {
    double       norm       = 0.; ///< Euclidean norm over the free rows (N/m)
    double       force_norm = 0.; ///< largest norm of a part of R (N/m)
    unsigned int n_cone     = 0;  ///< points on the smooth part of the cone
    unsigned int n_apex     = 0;  ///< points at the apex
    unsigned int n_switched = 0;  ///< points whose mode has changed

    double local_error = 0.; ///< see InternalForces::local_error()

    /** Over potential contact nodes: norm of F (N/m) and the sum of its
     *  reference Contact::Touch::size. Contact forces may be small compared
     *  with those of the soil. */
    double contact_norm = 0., contact_size = 0.;
  };

  /**
   * One implicit step as a root-finding problem for the velocities v of the
   * free dofs (backward Euler):
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

    /** Adds a term, which must outlive the problem. */
    void
    add(Term &term)
    {
      terms.push_back(&term);
    }

    /** Adds bars, which must outlive the problem. */
    void
    add(Bars &of_scene)
    {
      bars = &of_scene;
      terms.push_back(bars);
    }

    bool
    has_bars() const
    {
      return bars != nullptr;
    }

    /** Not copyable: its terms refer to each other's data. */
    IncrementalProblem(const IncrementalProblem &) = delete;

    /**
     * Sets the data of a step of size h.
     * @param force F at its end, or null for none
     * @param velocity_L vL, velocities at t_n
     * @param prescribed prescribed velocities at its end
     * @param touching potential contacts, see Contact
     */
    void
    begin_step(const double  h,
               const Vector *force,
               const Vector &velocity_L,
               const Vector &prescribed,
               ContactStep   touching = {});

    /**
     * Evaluates trial states and R(v) in all rows by a local law; in prescribed
     * rows R is the reaction, in rows of contact nodes F. @p v needs its
     * ghosts.
     */
    ResidualReport
    residual(Vector &dst, const Vector &v, const LocalLaw &law = {});

    /** Local law that linearises the complementarity problem in each
     *  residual(); arguments as for NaturalMap. */
    NaturalMap
    make_natural_map(const double rho, const std::vector<Mandel> &start) const
    {
      return NaturalMap(points, materials, {h}, rho, start);
    }

    /** Properties of the current step, over all ranks. Collective. */
    StepTraits
    traits() const;

    /** Whether the Jacobian is symmetric positive definite. */
    bool
    is_symmetric() const
    {
      return materials.traits().symmetric && !contact_term;
    }

    bool
    has_inertia() const
    {
      return inertia.has_value();
    }

    /**
     * Sparsity pattern of the Jacobian on the free dofs, with zero values.
     * @param one_triangle whether only the lower triangle of a symmetric one is
     * stored
     */
    SparseMatrix
    make_pattern(const bool one_triangle);

    /** Nodes of the rows of the Jacobian. Collective. */
    NodalRows
    nodal_rows() const;

    /** Whether the couplings of the step differ from those of the last pattern.
     *  Collective with contact. */
    bool
    needs_pattern() const;

    /**
     * Generalised Jacobian dR/dv = M/h + h sum V B' C B at the last residual(),
     * with C replaced by (1 - w) C + w D, w the elastic blend.
     * @return contribution of free obstacles or of bars
     */
    LowRank
    linearise(SparseMatrix &matrix, const double elastic_blend = 0.) const;

    /** Computes dst = (dR/dv) dv in all rows, at the last residual(). */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Sets the prescribed components of v at the end of the step. */
    void
    set_prescribed(Vector &v) const;

    const Unknowns &
    free_dofs() const
    {
      return unknowns;
    }

    /** Multipliers at the last residual(): forces along the rows of H (N/m). */
    const Eigen::VectorXd &
    multipliers() const
    {
      return lambda;
    }

    /** Inertia term of a dynamic problem. */
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

    /** @name Contact, if there may be any */
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

    /** Internal forces, with the trial states of the points. */
    const InternalForces &
    internal_forces() const
    {
      return internal;
    }

    /** Stress at t_n, by point. */
    const std::vector<Mandel> &
    stress_at_start() const
    {
      return points.stress;
    }

    /** Diagonal of the elastic Jacobian M/h + h sum V B'DB (kg/(m s)). */
    const Vector &
    scale();

    /** Merit function sum R_i^2 / scale_i over the free dofs. */
    double
    merit(const Vector &residual);

    /** Scalar product over the free dofs. */
    double
    free_dot(const Vector &a, const Vector &b) const;

    /** A zero vector with the layout of velocities and forces. */
    Vector
    make_vector() const
    {
      return Vector(layout);
    }

    /** Size h of the step (s). */
    double
    time_step() const
    {
      return h;
    }

    /**
     * Exports the problem as data, on the first rank, without the data of the
     * time stepper (parameters of materials, whether points move). Collective.
     */
    FrozenProblem
    freeze(const Vector &start) const;

  private:
    /** Reduction formulates the same problem for the stresses alone and uses
     *  all of the data. */
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
    std::vector<Term *>    terms; ///< all of them
    Bars                  *bars = nullptr; ///< if there are any

    bool of_particles = false;

    double h = 0.;
    Vector velocity_L;
    Vector prescribed;

    Vector          part;             ///< of a term in residual()
    Vector          elastic_diagonal; ///< of the present h, or empty
    Eigen::VectorXd lambda;
    JacobianPattern pattern;

    using Links = std::vector<std::vector<unsigned int>>;
    Links links_now; ///< of the step, Contact::links()
    Links links;     ///< of the pattern

    /** Factors of H in the metric of scale(), for the present step, or
     *  empty. */
    Multipliers::Factors row_factors;
  };
} // namespace geocone::GEOCONE_DIM

#endif
