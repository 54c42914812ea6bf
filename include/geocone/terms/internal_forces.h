// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_internal_forces_h
#define geocone_terms_internal_forces_h

#include <geocone/base/state_row.h>
#include <geocone/laws/material_library.h>
#include <geocone/points/material_points.h>
#include <geocone/terms/cell_pressures.h>
#include <geocone/terms/pore_pressures.h>
#include <geocone/terms/term.h>
#include <geocone/terms/turned_dofs.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Residuals of the yield condition and the flow rule at a computed state,
   * evaluated independently of the solver. They are maxima over all points,
   * with z = S (s - s_n) - h B v recomputed from the state, y = Psi(z), the
   * stress scale max |s| + max k, and the strain scale max |y|, at least stress
   * scale/2G (without plastic flow y is rounding).
   */
  struct Quality
  {
    double natural_map     = 0.; ///< |s - P_C(s - 2G y)| / stress scale
    double cone_violation  = 0.; ///< max(0, |s_t| - a s_n - k) / stress scale
    double dual_violation  = 0.; ///< max(0, a |y_t| - y_n) / strain scale
    double complementarity = 0.; ///< |<y, s + (k/a) n>| / (both scales)

    /** Violation max(0, |s_t| - a s_n - k) of the yield cone of the exact
     *  friction law (Pa). It is nonzero with lagged friction or friction with
     *  memory, for which the other members refer to the law that was solved. */
    double cone_excess = 0.;

    /** Residual |s - P_C(s - 2G y)| of the natural map of the exact law at a
     *  stress s, divided by the stress scale. It equals natural_map if the
     *  exact law was solved. */
    double exact_natural_map = 0.;

    /** Ratio of the plastic work due to lagged friction or friction with memory
     *  (excess_work()) to the plastic work in the step. The excess is due to
     *  the difference between the strength used and the exact strength. */
    double excess_share = 0.;

    void
    state(StateRow &row)
    {
      row(natural_map,
          cone_violation,
          dual_violation,
          complementarity,
          cone_excess,
          exact_natural_map,
          excess_share);
    }

    void
    take_worse(const Quality &other)
    {
      natural_map       = std::max(natural_map, other.natural_map);
      cone_violation    = std::max(cone_violation, other.cone_violation);
      dual_violation    = std::max(dual_violation, other.dual_violation);
      complementarity   = std::max(complementarity, other.complementarity);
      cone_excess       = std::max(cone_excess, other.cone_excess);
      exact_natural_map = std::max(exact_natural_map, other.exact_natural_map);
      excess_share      = std::max(excess_share, other.excess_share);
    }
  };

  /**
   * Internal forces sum_p V_p B_p' s_p(v) of a step, with the stresses s_p at
   * the points as functions of the velocities v. The stress of point p follows
   * from the constitutive law,
   *   s_p(v) = material(h B_p v, state at t_n).
   * Undrained soil additionally has an excess pore pressure,
   *   p_p(v) = p_p - K_w/n tr(h B_p v),
   * or, if it consolidates, that of PorePressures.
   * Equilibrium uses the total stress s_p - p_p I; the law, its modes and its
   * checks use the effective stress s_p. With dilatant soil, B-bar includes
   * CellPressures. The state at t_n is const; the trial states stored here are
   * those of the last call to residual().
   */
  class InternalForces : public Term
  {
  public:
    InternalForces(const MaterialPoints &points,
                   const Materials      &materials,
                   const Unknowns       &unknowns,
                   const MPI_Comm        comm);

    /** Takes the excess pore pressures of the points from unknowns of the step.
     *  The object must outlive this one. */
    void
    take_pressures(PorePressures &of_flow)
    {
      flow = &of_flow;
    }

    /** Sets the size of the step. @param step h (s) */
    void
    begin_step(const double step);

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    /** Computes the internal forces sum V B's of the stresses at t_n, in all owned
     *  rows (N/m). */
    void
    forces_at_start(Vector &part) const;

    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    void
    apply_tangent(Vector &dst, const Vector &dv) const override;

    void
    add_elastic_diagonal(Vector &dst) const override;

    /** Counts the yielding points of this rank, and the points whose plastic mode
     *  has changed. They are the points on the smooth part of the cone, the points
     *  at the apex, and the points whose mode has changed since the previous
     *  residual(). */
    void
    count_modes(double *counts) const;

    /** Largest relative residual of the constitutive equations of the step over
     *  all points. It is |R| of NaturalMap divided by the stress scale, or
     *  CellPressures::difference(); 0 for the return map alone. Collective. */
    double
    local_error() const;

    /** Returns true if the mean stress is required to be a polynomial in each
     *  cell (see CellPressures). This is the case for the B-bar method with
     *  dilatant soil. The result is the same on all ranks. */
    bool
    has_cell_pressures() const
    {
      return cell_pressures.has_value();
    }

    /**
     * Estimated rounding error in the residual norm for a velocity field (N/m).
     * It is
     *   N^2 = eps^2 sum_p sum_i |grad N_i|^2 (V_p K_p h sum_j |grad N_j| |v_j|)^2
     * with K_p = 2 (lambda + G). The terms of the strain e_p = h B_p v have the
     * relative error eps, but their sum is smaller by the ratio of the sizes of
     * cell and body, and in nearly isochoric deformation K_p is much larger
     * than the shear stiffness. Collective.
     * @param v with its ghosts, as for residual()
     */
    double
    rounding_floor(const Vector &v) const;

    /** Evaluates the residuals of the yield condition and the flow rule for the
     *  trial states of the points. The result is the same on all ranks.
     *  @param excess_work result of excess_work() (J/m) */
    Quality
    quality(const double excess_work) const;

    /** Returns a description of a point whose trial state is NaN, or an empty
     *  string. Collective. */
    std::string
    not_a_number() const;

    /** Excess plastic work: plastic work due to the difference between the
     *  strength used and the exact strength, with lagged friction or friction
     *  with memory (J/m). It is the sum of V |z_t| ||s_t| - a s_n - k| over the
     *  plastic points: 0 for the exact law. Collective. */
    double
    excess_work() const;

    /** Ratio of the excess plastic work, due to lagged friction or friction
     *  with memory, to the plastic work of the step. Collective.
     *  @param excess_work result of excess_work() (J/m) */
    double
    excess_share(const double excess_work) const;

    /** @name Trial states, by point */
    /** @{ */
    const std::vector<Mandel> &
    trial_stress() const
    {
      return stress;
    }
    /** Total trial stresses of the points: effective stress minus excess pore
     *  pressure (tension positive). */
    const std::vector<Mandel> &
    total_stress() const
    {
      return is_undrained() ? total : stress;
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
    /** Trial history variables of all points, in the memory layout of
     *  MaterialPoints. */
    std::vector<double>
    trial_history() const;

    /** Plastic strain increment -z of a material point in the step. */
    SpatialMandel
    plastic_strain_increment(const unsigned int point) const;

    /** @name Full stress tensor of a point, in the trial state and at t_n; s_zz is
     *  0 unless the law is three-dimensional */
    /** @{ */
    SpatialMandel
    whole_stress(const unsigned int point) const;
    SpatialMandel
    whole_stress_n(const unsigned int point) const;
    /** @} */

    /** Internal work in the step at a point, per unit volume (J/m^3). */
    struct Work
    {
      double elastic; ///< s:S(s - s_n), plus p (p - p_n)/(K_w/n) of the fluid
      double plastic; ///< s:(plastic strain increment)
    };
    Work
    work(const unsigned int point) const;
    /** @} */

    /** Calls f(p, dof, column of B_p) for each nonzero column of the strain matrix
     *  B_p of each point p. The number dof is local. */
    void
    for_each_strain_column(
      const std::function<
        void(const unsigned int, const unsigned int, const Mandel &)> &f) const;

  private:
    /** Contiguous range [begin, end) of points of one material. */
    struct Run
    {
      unsigned int begin, end, material;
    };
    std::vector<Run> runs;

    /** Strain increments and states at t_n for a range of points. They are the
     *  input to the material in the last call to residual(). */
    Increment
    increment_of(const Run &run) const;

    StepData
    step_law() const
    {
      return {h, friction_lag};
    }

    /** Updates the stresses and plastic modes (elastic, cone or apex) of the
     *  points [begin, end), with their tangents unless null. */
    void
    update_materials(const unsigned int begin,
                     const unsigned int end,
                     MandelMatrix      *tangents) const;

    /**
     * Tangents of the points at the state of the last call to residual(), a few
     * cells after the other: so many tangents need not be stored.
     */
    class TangentsByCell
    {
    public:
      TangentsByCell(const InternalForces &forces)
        : forces(forces)
      {}

      /** Returns the tangents of the points of a cell. Cells are asked for in
       *  ascending order. */
      const MandelMatrix *
      of_cell(const unsigned int c);

    private:
      const InternalForces     &forces;
      std::vector<MandelMatrix> computed;
      unsigned int              begin = 0, end = 0; ///< points computed
    };

    /** Computes the strains B_p v at the points of a cell from the velocities
     *  v, multiplied by a factor (e.g. the step size). In axisymmetric problems
     *  hoop strains are included. */
    template <int n>
    void
    strains_of_cell(const unsigned int   c,
                    const double        *cell_v,
                    const double         factor,
                    std::vector<Mandel> &strain,
                    std::vector<double> &strain_zz) const;

    /** Adds the internal forces sum B_p' s_p of the points of a cell to the
     *  cell vector cell_f. The stress s_p is multiplied by the weight of the
     *  point; in axisymmetric problems the hoop stress is included. */
    template <int n, typename WeightedStress, typename WeightedHoopStress>
    void
    add_forces_of_cell(const unsigned int        c,
                       const WeightedStress     &weighted_stress,
                       const WeightedHoopStress &weighted_hoop_stress,
                       double                   *cell_f) const;

    /** Adds the low-rank contribution of B-bar in dilatant soil (CellPressures)
     *  to the stiffness matrix K of a cell. */
    template <int n>
    void
    add_pressure_stiffness(const unsigned int              c,
                           const CellPressures::Condensed &condensed,
                           double                         *K) const;

    /** Computes the internal forces sum V B's from given stresses.
     *  @param hoop_stress of a point, for axisymmetric problems only */
    template <typename HoopStress>
    void
    sum_forces(const std::vector<Mandel> &stress,
               const HoopStress          &hoop_stress,
               Vector                    &part) const;

    /** Out-of-plane components of the tangent at a point, including the pore fluid.
     *  They are multiplied by h and the weight of the point. */
    OutOfPlaneTangent
    tangent_zz_of(const unsigned int p, const double blend) const;

    /** Adds the stiffness of the out-of-plane components of a point's tangent to
     *  the cell matrix K. */
    template <int n>
    void
    add_hoop_stiffness(const unsigned int       p,
                       const OutOfPlaneTangent &C,
                       double                  *K) const;

    bool
    is_axisymmetric() const
    {
      return !points.hoop.empty();
    }

    bool
    is_undrained() const
    {
      return !pressure.empty();
    }

    /** Derivative of the excess pore pressure of a point by its volumetric
     *  strain: K_w/n if it keeps its water (Pa). */
    double
    fluid_modulus(const unsigned int point) const
    {
      return flow != nullptr
               ? flow->fluid_modulus(point)
               : materials[points.material[point]].fluid_modulus();
    }

    /** Updates the trial excess pore pressures and total stresses. */
    void
    update_pressures();

    /** Strain increment of a point as a full (three-dimensional) tensor. */
    SpatialMandel
    whole_strain(const unsigned int point) const;

    const MaterialPoints &points;
    const Materials      &materials;
    const MPI_Comm        comm;
    TurnedDofs            turned;
    PorePressures        *flow = nullptr; ///< null unless soil consolidates

    double            h = 0.;
    NaturalMap::Error map_error;

    /** @name Local law of the last call to residual() */
    /** @{ */
    double            friction_lag = 0.;
    const NaturalMap *natural_map  = nullptr; ///< until the end of its attempt
    /** @} */

    std::vector<Mandel>         strain;
    mutable std::vector<Mandel> stress;
    mutable std::vector<Mode>   mode;
    std::vector<Mode>           previous_mode;

    /** Polynomial mean stresses of the cells, for B-bar with dilatant soil, and
     *  the tangents of the last call to residual(), empty without. */
    mutable std::optional<CellPressures> cell_pressures;
    std::vector<MandelMatrix>            tangent;

    /** @name Excess pore pressure and total stress: empty without undrained
     *  soil */
    /** @{ */
    std::vector<double> pressure;
    std::vector<Mandel> total;
    /** @} */

    /** @name Out-of-plane components: empty unless laws are three-dimensional;
     *  strain and tangent only in axisymmetric problems */
    /** @{ */
    std::vector<double>                    strain_zz;
    mutable std::vector<double>            stress_zz;
    mutable std::vector<OutOfPlaneTangent> tangent_zz;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
