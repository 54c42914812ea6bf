// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_incremental_problem_h
#define geocone_problem_incremental_problem_h

#include <geocone/contact/contact.h>
#include <geocone/linear/nodal_rows.h>
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

  /** What residual() has found, summed over the ranks. */
  struct ResidualReport
  {
    double       norm       = 0.; ///< Euclidean norm over the free rows (N/m)
    double       force_norm = 0.; ///< greatest norm of a part of R (N/m)
    unsigned int n_cone     = 0;  ///< points on the smooth part of the cone
    unsigned int n_apex     = 0;  ///< points at the apex
    unsigned int n_switched = 0;  ///< points whose mode differs from last time

    double local_error = 0.; ///< see InternalForces::local_error()

    /** Of the nodes that may touch: the norm of F (N/m), and the sum of what it is made of,
     *  Contact::Touch::size. Forces of contact may be small beside those of soil. */
    double contact_norm = 0., contact_size = 0.;
  };

  /**
   * One implicit step as a root-finding problem for the velocities v of the free
   * dofs (backward Euler):
   *   R(v) = M (v - vL)/h + sum_p V_p B_p' s_p(v) - F - H' lambda,   H v = q.
   * It is a sum of terms (Inertia, InternalForces, ExternalForces, GhostStiffness)
   * and of the reactions of linear constraints; prescribed velocities are eliminated. The
   * multipliers are functions of v: those that leave the least residual in the
   * metric of scale(), which at the solution are the multipliers. It knows points,
   * weights, gradients and constraints, and never asks whether they are FEM or MPM.
   * The state at t_n is const; trial states live in the terms, and are those of the
   * last residual(). Where nodes may touch obstacles, Contact puts its equations in
   * the place of R in their rows.
   */
  class IncrementalProblem
  {
  public:
    /**
     * @param lumped_mass the diagonal of Inertia, or null for a quasi-static
     * problem
     * @param consistent_part c of Inertia, not zero only for points with N and
     * mass
     * @param ghosts stencils of GhostStiffness
     * @param has_contact whether something may touch, the same on all ranks
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

    /** One more term, which has to stay. */
    void
    add(Term &term)
    {
      terms.push_back(&term);
    }

    /** Its terms refer to each other's data. */
    IncrementalProblem(const IncrementalProblem &) = delete;

    /**
     * Sets the data of a step of size h.
     * @param force F at its end, or null for none
     * @param velocity_L vL, velocities at t_n
     * @param prescribed velocities at its end, where they are prescribed
     * @param touching what may touch, see Contact
     */
    void
    begin_step(const double  h,
               const Vector *force,
               const Vector &velocity_L,
               const Vector &prescribed,
               ContactStep   touching = {});

    /**
     * Evaluates trial states and R(v) in all rows by a local law; in prescribed
     * rows it is the reaction, in those of contact F. @p v needs its ghosts.
     */
    ResidualReport
    residual(Vector &dst, const Vector &v, const LocalLaw &law = {});

    /** The law that linearises the complementarity problem itself at each
     *  residual(), for the arguments of NaturalMap. */
    NaturalMap
    make_natural_map(const double rho, const std::vector<Mandel> &start) const
    {
      return NaturalMap(points, materials, {h}, rho, start);
    }

    /** Of the step that has begun, all ranks together. Collective. */
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
     * The pattern of the Jacobian on the free dofs, with zero values.
     * @param one_triangle whether the lower triangle of a symmetric one is enough
     */
    SparseMatrix
    make_pattern(const bool one_triangle);

    /** What the rows of the Jacobian stand for. Collective. */
    NodalRows
    nodal_rows() const;

    /** Whether other nodes meet in the step's Jacobian than in the last pattern.
     *  Collective where there is contact. */
    bool
    needs_pattern() const;

    /**
     * Generalised Jacobian dR/dv = M/h + h sum V B' C B at the last residual(),
     * with C replaced by (1 - w) C + w D, w the elastic blend.
     * @return what free obstacles add to it
     */
    LowRank
    linearise(SparseMatrix &matrix, const double elastic_blend = 0.) const;

    /** dst = (dR/dv) dv in all rows, at the last residual(). */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Sets the prescribed components of v to their values at the step's end. */
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

    /** The mass, where there is inertia. */
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

    /** @name What touches, where something may */
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

    /** The points with their trial states. */
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

    /** The diagonal of the elastic Jacobian M/h + h sum V B'DB (kg/(m s)). */
    const Vector &
    scale();

    /** sum R_i^2 / scale_i over the free dofs. */
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
     * The problem as data, on the first rank; it lacks what only the time stepper
     * knows (materials' parameters, whether points move). Collective.
     */
    FrozenProblem
    freeze(const Vector &start) const;

  private:
    /** The same problem for the stresses alone needs all of the data. */
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

    /** Of H in the metric of scale(), for the present step, or empty. */
    Multipliers::Factors row_factors;
  };
} // namespace geocone::GEOCONE_DIM

#endif
