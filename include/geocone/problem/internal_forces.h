// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_internal_forces_h
#define geocone_problem_internal_forces_h

#include <geocone/base/state_row.h>
#include <geocone/materials/material_library.h>
#include <geocone/points/material_points.h>
#include <geocone/problem/cell_pressures.h>
#include <geocone/problem/term.h>
#include <geocone/problem/turned_dofs.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
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
     *  lags or remembers, while the other numbers are those of the law that was
     *  solved. */
    double cone_excess = 0.;

    /** |s - P_C(s - 2G y)| / stress scale of the exact law: natural_map where that is
     *  what was solved. */
    double exact_natural_map = 0.;

    /** Plastic work by which the strength that was solved for differs from the exact one,
     *  over the plastic work, of a step; see InternalForces::excess_work(). */
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
   * The internal forces of a step,
   *   sum_p V_p B_p' s_p(v),   s_p(v) = material(h B_p v, state at t_n).
   * Undrained soil has an excess pore pressure beside it,
   *   p_p(v) = p_p - K_w/n tr(h B_p v),
   * and what is in equilibrium is the total stress s_p - p_p I; the law, its modes and
   * its checks are those of the effective stress s_p.
   * Where soil dilates, B-bar comes with CellPressures.
   * The state at t_n is const; the trial states, which are those of the last
   * residual(), live here.
   */
  class InternalForces : public Term
  {
  public:
    InternalForces(const MaterialPoints &points,
                   const Materials      &materials,
                   const Unknowns       &unknowns,
                   const MPI_Comm        comm);

    /** @param step h (s) */
    void
    begin_step(const double step);

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    /** part = sum V B's of the stresses at t_n, in all owned rows (N/m). */
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

    /** Adds how many points of this rank are on the smooth part of the cone, at
     *  the apex, and in another mode than at the residual before. */
    void
    count_modes(double *counts) const;

    /** Largest |R| of NaturalMap over the stress scale, or what is left in
     *  CellPressures::difference(); 0 for the return map alone.
     *  Collective. */
    double
    local_error() const;

    /** Whether there are CellPressures; the same on all ranks. */
    bool
    has_cell_pressures() const
    {
      return cell_pressures.has_value();
    }

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

    /** Checks of the trial states; the same on all ranks.
     *  @param excess_work as the function excess_work() finds it (J/m) */
    Quality
    quality(const double excess_work) const;

    /** Names a point whose trial state is not a number, or nothing. Collective. */
    std::string
    not_a_number() const;

    /** sum V |z_t| ||s_t| - a s_n - k| over the plastic points where friction lags or has
     *  a memory (J/m): 0 for the exact law. Collective. */
    double
    excess_work() const;

    /** @p excess_work over the plastic work of the step, 0 for the exact law. Collective. */
    double
    excess_share(const double excess_work) const;

    /** @name Trial states, by point */
    /** @{ */
    const std::vector<Mandel> &
    trial_stress() const
    {
      return stress;
    }
    /** Less the excess pore pressure: what is in equilibrium. */
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
    /** History variables, laid out as those of the points at t_n. */
    std::vector<double>
    trial_history() const;

    /** -z: the plastic part of the strain increment of a point. */
    SpatialMandel
    plastic_strain_increment(const unsigned int point) const;

    /** @name Stress of a point, the trial one and at t_n, with s_zz of laws that are
     *  spatial (else 0) */
    /** @{ */
    SpatialMandel
    whole_stress(const unsigned int point) const;
    SpatialMandel
    whole_stress_n(const unsigned int point) const;
    /** @} */

    /** Of a point in the step, per volume (J/m^3). */
    struct Work
    {
      double elastic; ///< s:S(s - s_n), and p (p - p_n)/(K_w/n) of the fluid
      double plastic; ///< s:(plastic strain increment)
    };
    Work
    work(const unsigned int point) const;
    /** @} */

    /** Calls f(p, dof, column of B_p for a local dof) for all that are not 0. */
    void
    for_each_strain_column(
      const std::function<
        void(const unsigned int, const unsigned int, const Mandel &)> &f) const;

  private:
    /** Points from begin to end share a material. */
    struct Run
    {
      unsigned int begin, end, material;
    };
    std::vector<Run> runs;

    /** What a run asks of its material at the last residual(). */
    Increment
    increment_of(const Run &run) const;

    StepLaw
    step_law() const
    {
      return {h, friction_lag};
    }

    /** Asks the materials, run by run, of all points, or with tangents of those from
     *  begin to before end. */
    void
    update_materials(const bool with_tangent) const;
    void
    update_materials(const unsigned int begin, const unsigned int end) const;
    void
    update_material(const Run &run, const bool with_tangent) const;

    /** Makes the tangents of the last residual(), if it has not made them. */
    void
    update_tangents() const
    {
      if (!by_natural_map && !cell_pressures)
        update_materials(true);
    }

    /** strain[p] = factor B_p v for the points of a cell, and around an axis the hoop
     *  strain. */
    template <int n>
    void
    strains_of_cell(const unsigned int   c,
                    const double        *cell_v,
                    const double         factor,
                    std::vector<Mandel> &strain,
                    std::vector<double> &strain_zz) const;

    /** cell_f += sum B_p' s_p, s_p the stress times the weight, in the plane and, of
     *  round bodies, along the hoop. */
    template <int n, typename WeightedStress, typename WeightedHoopStress>
    void
    add_forces_of_cell(const unsigned int        c,
                       const WeightedStress     &weighted_stress,
                       const WeightedHoopStress &weighted_hoop_stress,
                       double                   *cell_f) const;

    /** Adds the part of low rank that the pressure of a cell leaves to K. */
    template <int n>
    void
    add_pressure_stiffness(const unsigned int              c,
                           const CellPressures::Condensed &condensed,
                           double                         *K) const;

    /** part = sum V B's. @param hoop_stress of a point, asked of round bodies only */
    template <typename HoopStress>
    void
    sum_forces(const std::vector<Mandel> &stress,
               const HoopStress          &hoop_stress,
               Vector                    &part) const;

    /** The parts of a point's tangent out of the plane, with the fluid's, times h and
     *  the weight. */
    OutOfPlaneTangent
    tangent_zz_of(const unsigned int p, const double blend) const;

    /** K += those parts. */
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

    /** K_w/n of a point (Pa). */
    double
    fluid_modulus(const unsigned int point) const
    {
      return materials[points.material[point]].fluid_modulus();
    }

    /** The trial pressures and total stresses. */
    void
    update_pressures();

    /** The strain increment of a point. */
    SpatialMandel
    whole_strain(const unsigned int point) const;

    const MaterialPoints &points;
    const Materials      &materials;
    const MPI_Comm        comm;
    TurnedDofs            turned;

    double            h = 0.;
    NaturalMap::Error map_error;

    /** @name The law of the last residual() */
    /** @{ */
    double friction_lag   = 0.;
    bool   by_natural_map = false;
    /** @} */

    std::vector<Mandel>               strain;
    mutable std::vector<Mandel>       stress;
    mutable std::vector<Mode>         mode;
    std::vector<Mode>                 previous_mode;
    mutable std::vector<MandelMatrix> tangent;

    /** B-bar where soil dilates; then tangents are those of the last residual(). */
    mutable std::optional<CellPressures> cell_pressures;

    /** @name Excess pore pressure, and the stress less it: empty but for scenes with
     *  undrained soil */
    /** @{ */
    std::vector<double> pressure;
    std::vector<Mandel> total;
    /** @} */

    /** @name Out of the plane: empty but for laws that are spatial, the strain and
     *  the tangent but for scenes around an axis */
    /** @{ */
    std::vector<double>                    strain_zz;
    mutable std::vector<double>            stress_zz;
    mutable std::vector<OutOfPlaneTangent> tangent_zz;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
