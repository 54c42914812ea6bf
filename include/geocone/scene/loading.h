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
  /** One stage of the loading programme: its duration and time steps. */
  class Stage : public dealii::ParameterAcceptor
  {
  public:
    explicit Stage(const std::string &name);

    void
    prepare();

    /** Sizes of its steps in order (s); they sum up to the duration. */
    std::vector<double>
    step_sizes() const;

    /** Number of steps, in closed form; within a few of step_sizes(). */
    double
    expected_steps() const;

    /** @name @throws InputError for parameters of explicit MPM only, or of the
     *  other methods only */
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

    /** Divisor of c and tan(phi) at the end, linear in time from its previous
     *  value; 0: unchanged. */
    double strength_factor = 0.;

    /** Whether the first step that does not converge is the intended end of the
     *  run. */
    bool until_failure = false;

    /** Whether steps of implicit runs require static equilibrium, as in
     *  strength reduction until failure. */
    bool
    seeks_equilibrium() const
    {
      return strength_factor > 0. && until_failure;
    }

    /** Reason why a step is not in equilibrium, see accelerating_share();
     *  empty: it is. */
    std::string
    no_equilibrium(const double accelerating_share) const;

    /** @name Load stepping: tractions by their names, and "weight", multiplied
     *  by an unknown load factor, with a given mean velocity that is
     *  work-conjugate to them (m/s) */
    /** @{ */
    std::vector<std::string> raised_loads;
    double                   raising_velocity = 0.;
    bool
    raises_loads() const
    {
      return !raised_loads.empty();
    }
    bool
    raises(const std::string &load) const;
    /** @} */

    /** Piezometric line at the end (x, y); pressures change to it linearly in
     *  time; empty: unchanged. */
    std::vector<dealii::Point<2>> water_table;

    /** Levels of open water at the end, by name of the seepage boundary (m), and number
     *  of steps of the transient flow; 0: steady flow. */
    std::map<std::string, double> water_levels;
    unsigned int                  flow_steps = 0;

    /** @name Changes of the body at the beginning */
    /** @{ */

    /** Polygon or box that is excavated, restricted to where a formula is
     *  positive, and the time (s) over which its forces are ramped down. */
    std::vector<dealii::Point<dim>> removed_polygon;
    double                          removal_duration = 0.;

    /** Materials that are added, and the time (s) over which their weight is
     *  ramped up. */
    std::vector<std::string> added_materials;
    double                   addition_duration = 0.;

    /** Replaced materials and their replacements, by name. */
    std::map<std::string, std::string> changed_materials;

    /** Whether the stage removes material, and whether it does so at x. */
    bool
    removes() const
    {
      return !removed_polygon.empty() || removed_where;
    }
    bool
    removes(const dealii::Point<dim> &x) const;

    /** Whether material is removed, added or replaced. */
    bool
    changes_body() const
    {
      return removes() || !added_materials.empty() ||
             !changed_materials.empty();
    }

    /** Message about the amount removed. @param what e.g. "points"
     *  @throws StepFailure if it removes nothing or everything */
    std::string
    removal_text(const unsigned long n_removed,
                 const unsigned long n_all,
                 const std::string  &what) const;
    /** @} */

    /** @name For explicit MPM only */
    /** @{ */

    /** Local damping: the part of the unbalanced force that opposes motion. */
    double damping = 0.;

    /** Whether velocities are set to zero at each peak of the kinetic energy. */
    bool kinetic_damping = false;

    /** Limits of equilibrium at the end: largest unbalanced force over weight,
     *  and kinetic energy over stress work; 0: not tested. */
    double largest_unbalanced_force = 0.;
    double largest_kinetic_energy   = 0.;

    /** Resets at the beginning: zero velocity; history computed anew from the
     *  stress. */
    bool reset_velocity = false;
    bool reset_history  = false;
    /** @} */

  private:
    /** Checks removed and added parts, and reads the formula. @throws
     *  InputError */
    void
    prepare_changes();

    double step_size       = 0.01;
    double first_step_size = 0.;
    double growth          = 1.;

    std::string               removed_where_text;
    std::optional<Expression> removed_where;
  };

  /** The stages of "Loading/Stages", one after another from t = 0. */
  class LoadingProgramme : public NamedList<Stage>
  {
  public:
    explicit LoadingProgramme(const ParameterFile &file);

    /** @param materials,tractions their names */
    void
    prepare(const std::vector<std::string> &materials,
            const std::vector<std::string> &tractions);

    /** Stage at a time. */
    const Stage &
    stage_at(const double t) const;

    /** Whether a stage uses load stepping. */
    bool
    raises_loads() const;

    /** Whether a stage reduces the strength. */
    bool
    reduces_strength() const;

    /** Whether the body changes at the beginning of a stage. */
    bool
    changes_body() const;

    /** Stage that adds a material, counted from 0; -1 if it is present
     *  initially. */
    int
    stage_that_adds(const std::string &material) const;

    /** Whether a material is absent until a stage adds it. */
    bool
    adds(const std::string &material) const
    {
      return stage_that_adds(material) >= 0;
    }

    /** Whether another material becomes this one in a stage. */
    bool
    makes(const std::string &material) const;

    /** Divisor of c and tan(phi) at time t. */
    double
    strength_factor(const double t) const;

    /** strength_factor() at the beginning of a stage. */
    double
    factor_before(const std::string &stage) const;

    /** Duration of all stages (s). */
    double
    duration() const;
  };

  /** Gravity g(t), applied at once or ramped up linearly over a duration. */
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
