// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_loading_h
#define geocone_boundary_loading_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/functions/expression.h>
#include <geocone/geometry/geometry.h>

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
  /** One stage of the loading programme, with a duration, time steps, and
   *  changes of the body and the loads. */
  class Stage : public dealii::ParameterAcceptor
  {
  public:
    explicit Stage(const std::string &name);

    void
    prepare();

    /** Returns the sizes of the time steps in order (s). Their sum is the
     *  duration of the stage. */
    std::vector<double>
    step_sizes() const;

    /** Estimates the number of time steps without simulating the stage. The
     *  number of step_sizes() differs by a few steps. */
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

    /** Strength reduction factor at the end of the stage, by which c and
     *  tan(phi) are divided. It varies linearly in time from its previous
     *  value. If 0, the factor does not change. */
    double strength_factor = 0.;

    /** If true, the run terminates normally at the first step that does not
     *  converge, i.e. at failure. */
    bool until_failure = false;

    /** Returns true if each step of an implicit run must reach static
     *  equilibrium, as in strength reduction until failure. */
    bool
    requires_equilibrium() const
    {
      return strength_factor > 0. && until_failure;
    }

    /** Returns the reason why a time step is not in static equilibrium, or an
     *  empty string in equilibrium.
     *  @param accelerating_share see accelerating_share() */
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

    /** Vertices (x, y) of the piezometric line at the end of the stage. Pore
     *  pressures vary linearly in time during the stage. If empty, the line
     *  does not change. */
    std::vector<dealii::Point<2>> water_table;

    /** Water levels (m) at the end of the stage, by name of the seepage
     *  boundary. The number flow_steps is the number of time steps of transient
     *  flow; 0: steady flow. */
    std::map<std::string, double> water_levels;
    unsigned int                  flow_steps = 0;

    /** @name Changes of the body at the beginning of the stage */
    /** @{ */

    /** Vertices (m) of the excavated polygon, or corners of the excavated box.
     *  A formula can restrict the region. During removal_duration (s) the
     *  forces of the excavated soil are ramped down. */
    std::vector<dealii::Point<dim>> removed_polygon;
    double                          removal_duration = 0.;

    /** Names of the materials that the stage adds. Their weight is ramped up
     *  during addition_duration (s). */
    std::vector<std::string> added_materials;
    double                   addition_duration = 0.;

    /** Names of the replaced materials, each with the name of the
     *  replacement. */
    std::map<std::string, std::string> changed_materials;

    /** Returns true if the stage excavates material: anywhere, or at the point
     *  x. */
    bool
    removes() const
    {
      return !removed_polygon.empty() || removed_where;
    }
    bool
    removes(const dealii::Point<dim> &x) const;

    /** Returns true if the stage removes, adds or replaces material. */
    bool
    changes_body() const
    {
      return removes() || !added_materials.empty() ||
             !changed_materials.empty();
    }

    /** Returns a message that states the number of excavated cells or points.
     *  @param what name of the counted entities, e.g. "points"
     *  @throws StepFailure if the stage removes nothing or everything */
    std::string
    removal_text(const unsigned long n_removed,
                 const unsigned long n_all,
                 const std::string  &what) const;
    /** @} */

    /** @name For explicit MPM only */
    /** @{ */

    /** Local damping coefficient: ratio of damping force to unbalanced force
     *  (-). The damping force is opposite to the velocity. */
    double damping = 0.;

    /** If true, velocities are set to zero at each peak of the kinetic
     *  energy. */
    bool kinetic_damping = false;

    /** Tolerances for equilibrium at the end of the stage. They limit the ratio
     *  of unbalanced force to weight, and of kinetic energy to stress work. If
     *  0, the ratio is not checked. */
    double largest_unbalanced_force = 0.;
    double largest_kinetic_energy   = 0.;

    /** Flags that select the state variables to be reset at the beginning of
     *  the stage. Velocities are set to zero; history variables are initialised
     *  for the current stress. */
    bool reset_velocity = false;
    bool reset_history  = false;
    /** @} */

  private:
    /** Checks the regions of excavated and added material, and parses the
     *  formula of the excavated region.
     *  @throws InputError */
    void
    prepare_changes();

    /** Size of the time steps (s), which grows from that of the first one by a
     *  factor per step. */
    struct
    {
      double size = 0.01, first = 0., growth = 1.;
    } steps;

    std::string               removed_where_text;
    std::optional<Expression> removed_where;
  };

  /** Loading programme: sequence of the stages of "Loading/Stages", from t =
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

    /** Returns the stage that is active at time t. */
    const Stage &
    stage_at(const double t) const;

    /** Returns true if any stage uses load stepping. */
    bool
    scales_loads() const;

    /** Returns true if any stage reduces the strength. */
    bool
    reduces_strength() const;

    /** Returns true if any stage removes, adds or replaces material. */
    bool
    changes_body() const;

    /** Returns the index of the stage that adds a material, counted from 0; -1
     *  if the material is initially present. */
    int
    stage_that_adds(const std::string &material) const;

    /** Returns true if a material is initially absent and added in a later
     *  stage. */
    bool
    adds(const std::string &material) const
    {
      return stage_that_adds(material) >= 0;
    }

    /** Returns true if any stage replaces another material by the given
     *  material. */
    bool
    replaces_by(const std::string &material) const;

    /** Returns the strength reduction factor at time t, by which c and tan(phi)
     *  are divided. */
    double
    strength_factor(const double t) const;

    /** Returns the strength reduction factor at the beginning of a stage. */
    double
    factor_before(const std::string &stage) const;

    /** Returns the total duration of all stages (s). */
    double
    duration() const;
  };

  /** Gravitational acceleration g(t), either constant or ramped up linearly
   *  over a given duration. */
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
