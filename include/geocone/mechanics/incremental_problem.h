// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_incremental_problem_h
#define geocone_mechanics_incremental_problem_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/base/state_row.h>
#include <geocone/discretisation/material_points.h>
#include <geocone/materials/material_library.h>
#include <geocone/mechanics/natural_map.h>
#include <geocone/mechanics/turned_dofs.h>
#include <geocone/mechanics/unknowns.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace geocone
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

    /** Largest |R| of NaturalMap over the stress scale; 0 for the return map. */
    double natural_map = 0.;
  };

  /**
   * How well a computed state satisfies the cone law, whatever solver made it:
   * maxima over all points, with z = S (s - s_n) - h B v recomputed from the
   * state, y = Psi(z), the stress scale max |s| + max k, and the strain scale
   * max |y|, at least stress scale/2G (y is rounding where nothing flows).
   */
  struct Quality
  {
    double natural_map     = 0.; ///< |s - P_C(s - 2G y)| / stress scale
    double cone_violation  = 0.; ///< max(0, |s_t| - a s_n - k) / stress scale
    double dual_violation  = 0.; ///< max(0, a |y_t| - y_n) / strain scale
    double complementarity = 0.; ///< |<y, s + (k/a) n>| / (both scales)

    /** max(0, |s_t| - a s_n - k) of the exact cone (Pa): not zero where friction
     *  is delayed, while the other numbers are those of the law that was solved. */
    double cone_excess = 0.;

    void
    state(StateRow &row)
    {
      row(natural_map,
          cone_violation,
          dual_violation,
          complementarity,
          cone_excess);
    }

    void
    take_worse(const Quality &other)
    {
      natural_map     = std::max(natural_map, other.natural_map);
      cone_violation  = std::max(cone_violation, other.cone_violation);
      dual_violation  = std::max(dual_violation, other.dual_violation);
      complementarity = std::max(complementarity, other.complementarity);
      cone_excess     = std::max(cone_excess, other.cone_excess);
    }
  };

  /** Where residual() takes the stresses from. */
  struct LocalLaw
  {
    /** The materials' closed-form return maps, with a part of the normal stress on
     *  which strength depends from t_n (Increment::friction_lag). */
    double friction_lag = 0.;

    /** Or the iterate of the natural map, which moves with each residual(). */
    NaturalMap *natural_map = nullptr;
  };

  /**
   * One implicit step as a root-finding problem for the velocities v of the free
   * dofs (backward Euler):
   *   R(v) = M (v - vL)/h + sum_p V_p B_p' s_p(v) - F - H' lambda,
   *   s_p(v) = material(h B_p v, state at t_n),   H v = q,
   * with prescribed velocities eliminated. The multipliers are functions of v:
   * those that leave the least residual in the metric of scale(), which at the
   * solution are the multipliers. The mass is M = (1 - c) diag(m) + c M_c, with
   * M_c the sum of m_p N_p' N_p over the points. It knows points, weights, gradients and
   * constraints, and never asks whether they are FEM or MPM. The state at t_n is
   * const; trial states live here, and are those of the last residual().
   */
  class IncrementalProblem
  {
  public:
    /**
     * @param lumped_mass the diagonal m, or null for a quasi-static problem
     * @param consistent_part c, not zero only for points with N and mass
     */
    IncrementalProblem(
      const MaterialPoints &points,
      const Materials      &materials,
      const Unknowns       &unknowns,
      const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout,
      const Vector *lumped_mass,
      const double  consistent_part = 0.);

    /**
     * Sets the data of a step of size h.
     * @param force F at its end, or null for none
     * @param velocity_L vL, velocities at t_n
     * @param prescribed velocities at its end, where they are prescribed
     */
    void
    begin_step(const double  h,
               const Vector *force,
               const Vector &velocity_L,
               const Vector &prescribed);

    /**
     * Evaluates trial states and R(v) in all rows by a local law; in prescribed
     * rows it is the reaction. @p v needs its ghosts.
     */
    ResidualReport
    residual(Vector &dst, const Vector &v, const LocalLaw &law = {});

    /** The law that linearises the complementarity problem itself at each
     *  residual(). */
    NaturalMap
    make_natural_map(const double rho, const std::vector<Mandel> &start) const
    {
      return NaturalMap(points, materials, rho, start);
    }

    /** Whether the Jacobian is symmetric positive definite. */
    bool
    is_symmetric() const
    {
      return materials.symmetric();
    }

    bool
    has_inertia() const
    {
      return mass != nullptr;
    }

    /** Largest (a - b)/a of the materials. */
    double
    non_associativity() const
    {
      return materials.non_associativity();
    }

    /**
     * The pattern of the Jacobian on the free dofs, with zero values.
     * @param one_triangle whether the lower triangle of a symmetric one is enough
     */
    SparseMatrix
    make_pattern(const bool one_triangle);

    /**
     * Generalised Jacobian dR/dv = M/h + h sum V B' C B at the last residual(),
     * with C replaced by (1 - w) C + w D, w the elastic blend.
     */
    void
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

    /** dst = M x in all rows. @p x needs its ghosts. */
    void
    apply_mass(Vector &dst, const Vector &x) const;

    /** The diagonal of the elastic Jacobian M/h + h sum V B'DB (kg/(m s)). */
    const Vector &
    scale();

    /** sum R_i^2 / scale_i over the free dofs. */
    double
    merit(const Vector &residual);

    /**
     * The size N of the rounding in the residual's norm at a velocity (N/m),
     *   N^2 = eps^2 sum_p sum_i |grad N_i|^2 (V_p K_p h sum_j |grad N_j| |v_j|)^2
     * with K_p = 2 (lambda + G): the terms of the strain e_p = h B_p v have the
     * relative error eps, but their sum is smaller by the size of the cell over
     * that of the body, and K_p is much larger than the stiffness to shear where
     * volume hardly changes. Collective.
     * @param v with its ghosts, as for residual()
     */
    double
    rounding_floor(const Vector &v) const;

    /** Scalar product over the free dofs. */
    double
    free_dot(const Vector &a, const Vector &b) const;

    /** A zero vector with the layout of velocities and forces. */
    Vector
    make_vector() const
    {
      return Vector(layout);
    }

    /**
     * The problem as data, on the first rank; it lacks what only the time stepper
     * knows (materials' parameters, whether points move). Collective.
     */
    FrozenProblem
    freeze(const Vector &start) const;

    /** Checks of the last residual()'s state; the same on all ranks. */
    Quality
    quality() const;

    /** Names a point whose trial state is not a number, or nothing. Collective. */
    std::string
    not_a_number() const;

    /** Stress at t_n, by point. */
    const std::vector<Mandel> &
    stress_at_start() const
    {
      return points.stress;
    }

    /** @name Trial states at the last residual(), by point */
    /** @{ */
    const std::vector<Mandel> &
    trial_stress() const
    {
      return stress;
    }
    const std::vector<Mandel> &
    strain_increment() const
    {
      return strain;
    }
    const std::vector<Mode> &
    modes() const
    {
      return mode;
    }
    /** History variables, laid out as those of the points at t_n. */
    std::vector<double>
    trial_history() const;

    /** -z: the plastic part of the strain increment of a point. */
    Mandel
    plastic_strain_increment(const unsigned int point) const;
    /** @} */

    /** Size h of the step (s). */
    double
    time_step() const
    {
      return h;
    }

  private:
    /** The same problem for the stresses alone needs all of the data. */
    friend class Reduction;

    /** Calls f(p, dof, column of B_p for a local dof) for all that are not 0. */
    void
    for_each_strain_column(
      const std::function<
        void(const unsigned int, const unsigned int, const Mandel &)> &f) const;

    /** Points from begin to end share a material. */
    struct Run
    {
      unsigned int begin, end, material;
    };
    std::vector<Run> runs;

    /** What a run asks of its material at the last residual(). */
    Increment
    increment_of(const Run &run) const;

    /** Asks the materials, run by run. */
    void
    update_materials(const bool with_tangent) const;

    /** Makes the tangents of the last residual(), if it has not yet. */
    void
    update_tangents() const
    {
      if (law.natural_map == nullptr)
        update_materials(true);
    }

    const MaterialPoints                                            &points;
    const Materials                                                 &materials;
    const Unknowns                                                  &unknowns;
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    const Vector                                                    *mass;
    const double consistent_part;

    double        h     = 0.;
    const Vector *force = nullptr;
    Vector        velocity_L;
    Vector        prescribed;
    LocalLaw      law; ///< of the last residual()

    Vector          elastic_diagonal; ///< of the present h, or empty
    Eigen::VectorXd lambda;
    Vector          inertia; ///< scratch for a consistent mass

    /** strain[p] = factor B_p v for the points of a cell. */
    template <int n>
    void
    strains_of_cell(const unsigned int   c,
                    const double        *cell_v,
                    const double         factor,
                    std::vector<Mandel> &strain) const;

    /** cell_f += sum B_p' s_p, s_p the stress times the weight. */
    template <int n, typename WeightedStress>
    void
    add_forces_of_cell(const unsigned int    c,
                       const WeightedStress &weighted_stress,
                       double               *cell_f) const;

    std::vector<Mandel>               strain;
    mutable std::vector<Mandel>       stress;
    mutable std::vector<Mode>         mode;
    std::vector<Mode>                 previous_mode;
    mutable std::vector<MandelMatrix> tangent;

    /**
     * Per cell the places in the matrix of its (dim n_nodes)^2 entries, or of
     * one of each symmetric pair if one triangle is stored; -1 for prescribed.
     */
    std::vector<int> scatter;
    bool             one_triangle = false;
    /** Place of the diagonal entry of each free row. */
    std::vector<int> diagonal;

    TurnedDofs turned;

    /** Of H in the metric of scale(), for the present step, or empty. */
    Multipliers::Factors row_factors;
  };
} // namespace geocone

#endif
