// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_loading_h
#define geocone_scene_loading_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/functions/expression.h>
#include <geocone/scene/geometry.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** One stage of the loading programme: duration, time steps, and changes of
   *  the body and the loads. */
  class Stage : public dealii::ParameterAcceptor
  {
  public:
    explicit Stage(const std::string &name);

    void
    prepare();

    /** Sizes of the time steps in order (s); their sum is the duration. */
    std::vector<double>
    step_sizes() const;

    /** Approximate number of time steps, in closed form; differs from the
     *  number of step_sizes() by a few steps. */
    double
    expected_steps() const;

    /** @name Rejection of parameters that the method does not support;
     *  @throws InputError */
    /** @{ */
    void
    check_implicit() const;
    void
    check_explicit() const;
    /** @} */

    const std::string name;
    double            duration           = 1.;
    unsigned int      output_every       = 0;
    bool              reset_displacement = false;

    /** Strength reduction factor, the divisor of c and tan(phi), at the end of
     *  the stage; 0: unchanged. It varies linearly in time from its previous
     *  value. */
    double strength_factor = 0.;

    /** Whether the run terminates as intended at the first step that does not
     *  converge, i.e. at failure. */
    bool until_failure = false;

    /** Whether time steps of implicit runs require static equilibrium, as in
     *  strength reduction until failure. */
    bool
    seeks_equilibrium() const
    {
      return strength_factor > 0. && until_failure;
    }

    /** Reason why a time step is not in static equilibrium, see
     *  accelerating_share(); empty: in equilibrium. */
    std::string
    no_equilibrium(const double accelerating_share) const;

    /** @name Load stepping: loads (names of tractions, "weight") multiplied by
     *  an unknown load factor, and their prescribed work-conjugate mean
     *  velocity (m/s) */
    /** @{ */
    std::vector<std::string> scaled_loads;
    double                   control_velocity = 0.;
    bool
    scales_loads() const
    {
      return !scaled_loads.empty();
    }
    bool
    scales(const std::string &load) const;
    /** @} */

    /** Piezometric line (x, y) at the end of the stage; empty: unchanged. Pore
     *  pressures vary linearly in time during the stage. */
    std::vector<dealii::Point<2>> water_table;

    /** Levels of open water at the end of the stage, by name of the seepage
     *  boundary (m), and number of time steps of transient flow; 0: steady
     *  flow. */
    std::map<std::string, double> water_levels;
    unsigned int                  flow_steps = 0;

    /** @name Changes of the body at the beginning of the stage */
    /** @{ */

    /** Excavated polygon or box, restricted to the region where a formula is
     *  positive, and duration (s) over which the forces of the excavated soil
     *  are ramped down. */
    std::vector<dealii::Point<dim>> removed_polygon;
    double                          removal_duration = 0.;

    /** Added materials, and duration (s) over which their weight is ramped
     *  up. */
    std::vector<std::string> added_materials;
    double                   addition_duration = 0.;

    /** Replaced materials and their replacements, by name. */
    std::map<std::string, std::string> changed_materials;

    /** Whether the stage excavates material: anywhere, or at x. */
    bool
    removes() const
    {
      return !removed_polygon.empty() || removed_where;
    }
    bool
    removes(const dealii::Point<dim> &x) const;

    /** Whether the stage removes, adds or replaces material. */
    bool
    changes_body() const
    {
      return removes() || !added_materials.empty() ||
             !changed_materials.empty();
    }

    /** Message on the number of excavated cells or points. @param what name of
     *  the counted entities, e.g. "points"
     *  @throws StepFailure if the stage removes nothing or everything */
    std::string
    removal_text(const unsigned long n_removed,
                 const unsigned long n_all,
                 const std::string  &what) const;
    /** @} */

    /** @name For explicit MPM only */
    /** @{ */

    /** Local damping coefficient (-): fraction of the unbalanced force that
     *  acts against the velocity. */
    double damping = 0.;

    /** Whether velocities are set to zero at each peak of the kinetic energy. */
    bool kinetic_damping = false;

    /** Equilibrium tolerances at the end of the stage: unbalanced force over
     *  weight, and kinetic energy over stress work; 0: not tested. */
    double largest_unbalanced_force = 0.;
    double largest_kinetic_energy   = 0.;

    /** Resets at the beginning of the stage: velocities to zero; history
     *  variables to initial values for the current stress. */
    bool reset_velocity = false;
    bool reset_history  = false;
    /** @} */

  private:
    /** Checks the excavated and added regions, and parses the formula.
     *  @throws InputError */
    void
    prepare_changes();

    double step_size       = 0.01;
    double first_step_size = 0.;
    double growth          = 1.;

    std::string               removed_where_text;
    std::optional<Expression> removed_where;
  };

  /** The loading programme: consecutive stages of "Loading/Stages", from t =
   *  0. */
  class LoadingProgramme : public NamedList<Stage>
  {
  public:
    explicit LoadingProgramme(const ParameterFile &file);

    /** Checks all stages. @param materials,tractions names of all materials and
     *  tractions */
    void
    prepare(const std::vector<std::string> &materials,
            const std::vector<std::string> &tractions);

    /** Stage at time t. */
    const Stage &
    stage_at(const double t) const;

    /** Whether any stage uses load stepping. */
    bool
    scales_loads() const;

    /** Whether any stage reduces the strength. */
    bool
    reduces_strength() const;

    /** Whether any stage removes, adds or replaces material. */
    bool
    changes_body() const;

    /** Index of the stage that adds a material, from 0; -1: initially
     *  present. */
    int
    stage_that_adds(const std::string &material) const;

    /** Whether a material is absent until a stage adds it. */
    bool
    adds(const std::string &material) const
    {
      return stage_that_adds(material) >= 0;
    }

    /** Whether any stage replaces another material by this material. */
    bool
    makes(const std::string &material) const;

    /** Strength reduction factor at time t, the divisor of c and tan(phi). */
    double
    strength_factor(const double t) const;

    /** Strength reduction factor at the beginning of a stage. */
    double
    factor_before(const std::string &stage) const;

    /** Total duration of all stages (s). */
    double
    duration() const;
  };

  /** Gravitational acceleration g(t): constant, or ramped up linearly over a
   *  duration. */
  class Gravity : public dealii::ParameterAcceptor
  {
  public:
    Gravity();

    void
    prepare();

    dealii::Tensor<1, dim>
    at(const double t) const;

    bool
    acts() const
    {
      return acceleration.norm() > 0.;
    }

    bool
    is_ramped() const
    {
      return ramp_duration > 0. && acts();
    }

  private:
    dealii::Tensor<1, dim> acceleration;
    double                 ramp_duration = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
