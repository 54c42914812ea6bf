// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/renamed_parameters.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/boundary/loading.h>
#include <geocone/functions/formula.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const RenamedParameter renamed_loads[] = {
      {"Loading/*", "Raised loads", "Scaled loads"},
      {"Loading/*", "Raising velocity", "Control velocity"}};

    const UsedWhere used_loading[] = {
      {"Gravity/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Loading/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Loading/*/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Loading/*/Until failure", "Discretisation/Method", {"FEM", "MPM"}},
      {"Loading/*/Strength factor", "Discretisation/Method", {"FEM", "MPM"}},
      {"Loading/*/Control velocity", "Discretisation/Method", {"FEM", "MPM"}},
      {"Loading/*/Damping", "Discretisation/Method", {"explicit MPM"}},
      {"Loading/*/Kinetic damping", "Discretisation/Method", {"explicit MPM"}},
      {"Loading/*/Largest unbalanced force",
       "Discretisation/Method",
       {"explicit MPM"}}};
  } // namespace

  namespace
  {
    constexpr double most_steps = 1e8; ///< of a stage

    /** Parameters of loading to failure: strength reduction and load
     *  stepping. */
    void
    declare_failure(Stage &stage)
    {
      stage.add_parameter(
        "Strength factor",
        stage.strength_factor,
        "FEM and MPM: strength reduction factor at the end of the stage [-], "
        "by which c and tan(phi) of all materials are divided, linear in time "
        "from its previous value; theta is limited to the reduced phi. 0: "
        "unchanged. With 'Until failure' = true the factor of safety is the "
        "factor at which no equilibrium is found.");
      stage.add_parameter(
        "Water table",
        stage.water_table,
        "FEM and MPM: piezometric line at the end of the stage [m], as "
        "'Water/Table'; pore pressures change linearly in time (drawdown, "
        "dewatering). Empty: unchanged.");
      stage.add_parameter(
        "Water levels",
        stage.water_levels,
        "FEM, MPM, seepage: NAME: LEVEL, ...: levels of open water [m] at the "
        "end of "
        "the stage, of boundaries of 'Seepage/Names'; pore pressures change "
        "linearly in time from those of the steady flow before to those of "
        "the steady flow after. Empty: unchanged.");
      stage.add_parameter(
        "Flow steps",
        stage.flow_steps,
        "FEM, MPM, seepage: number of equal time steps of a transient flow "
        "during the stage, in which 'Water levels' change linearly and the "
        "free surface follows with 'Drainable porosity'. 0: a steady flow if "
        "the stage changes levels, otherwise the flow is unchanged.");
      stage.add_parameter(
        "Until failure",
        stage.until_failure,
        "FEM and MPM: whether the stage and the run end as intended at the "
        "first step that does not converge even after subdivision: "
        "time-dependent loads are increased until failure. summary.json "
        "reports the time of failure (topic 'failure').");
      stage.add_parameter(
        "Scaled loads",
        stage.scaled_loads,
        "FEM and MPM: loads multiplied by a load factor: names in "
        "'Tractions/Names', or 'weight'. The factor is found in each step so "
        "that the body moves at the 'Control velocity', also past the peak "
        "load. Other loads are not scaled.");
      stage.add_parameter(
        "Control velocity",
        stage.control_velocity,
        "Mean velocity along the scaled loads [m/s], F.v/sum |F| with their "
        "nodal forces F; > 0 to load, < 0 to unload.");
    }

    /** Parameters of explicit MPM: relaxation to a state of rest, and
     *  resets. */
    void
    declare_explicit_only(Stage &stage)
    {
      stage.add_parameter("Damping",
                          stage.damping,
                          "Explicit MPM: local damping [-], 0 to 1: part of "
                          "the unbalanced force of each node that opposes its "
                          "velocity; 0.5 to 0.75 to reach equilibrium.");
      stage.add_parameter("Kinetic damping",
                          stage.kinetic_damping,
                          "Explicit MPM: whether all velocities are set to "
                          "zero at each peak of the kinetic energy.");
      stage.add_parameter("Largest unbalanced force",
                          stage.largest_unbalanced_force,
                          "Explicit MPM: convergence criterion of the stage: "
                          "largest unbalanced nodal force at its end, relative "
                          "to the weight of the body [-], e.g. 1e-3; 0: none.");
      stage.add_parameter(
        "Largest kinetic energy",
        stage.largest_kinetic_energy,
        "Explicit MPM: convergence criterion of the stage: kinetic energy at "
        "its end, relative to the stress work of the stage [-], e.g. 1e-6; 0: "
        "none. FEM and MPM with 'Strength factor' and 'Until failure' = true: "
        "criterion of failure, the part of the plastic work of a step that "
        "becomes kinetic energy (accelerating flow); 0: 3e-3.");
      stage.add_parameter("Reset velocity",
                          stage.reset_velocity,
                          "Explicit MPM: whether velocities are set to zero at "
                          "the beginning of this stage.");
      stage.add_parameter(
        "Reset history",
        stage.reset_history,
        "Explicit MPM: whether internal variables are initialised from the "
        "stresses at the beginning of this stage, as at the start of a run.");
    }

    /** Parameters of removed parts. */
    void
    declare_removal(Stage &stage, std::string &text_of_where)
    {
      stage.add_parameter(
        "Removed polygon",
        stage.removed_polygon,
        std::string(
          dim == 2
            ? "Vertices x, y; x, y; ... [m]"
            : "Lowest and highest corner x, y, z; x, y, z of a box [m]") +
          " of an excavation: points in it (FEM: cells, by their centres) are "
          "removed at the beginning of the stage" +
          (dim == 2 ? ". Unstructured meshes have edges along it." : "."));
      stage.add_parameter(
        "Removed where",
        text_of_where,
        std::string("Excavation: points (FEM: cells, by their centres) where "
                    "this formula in ") +
          coordinates +
          " (m) is > 0 are removed at the beginning of the stage, e.g. y - x "
          "above a slope of 45 degrees; if 'Removed polygon' is given too, "
          "only those in both.");
      stage.add_parameter(
        "Removal duration",
        stage.removal_duration,
        "Time [s] over which weight and stress of the removed points decrease "
        "to zero; with FEM and MPM, the forces that the removed soil exerted "
        "on the remaining soil. 0: immediately.");
    }

    /** Parameters of added and changed materials. */
    void
    declare_new_materials(Stage &stage)
    {
      stage.add_parameter(
        "Added materials",
        stage.added_materials,
        "FEM and MPM: names of materials added at the beginning of this stage "
        "(embankment, backfill); their regions are empty before. Their initial "
        "stress is 'Initial stress/Of added materials'; their elastic "
        "stiffness acts immediately.");
      stage.add_parameter(
        "Addition duration",
        stage.addition_duration,
        "FEM and MPM: time [s] over which the weight of the added materials "
        "increases from zero; 0: immediately.");
      stage.add_parameter(
        "Changed materials",
        stage.changed_materials,
        "FEM and MPM: OLD: NEW, ...: at the beginning of the stage the "
        "material OLD is replaced by NEW, with its strength, stiffness and "
        "density (ground improvement, weakening); stresses are kept. NEW needs "
        "no region.");
    }
  } // namespace

  Stage::Stage(const std::string &name)
    : dealii::ParameterAcceptor("/Loading/" + name)
    , name(name)
  {
    add_parameter("Duration", duration, "Duration of the stage [s], > 0.");
    add_parameter("Step size", steps.size, "Time step h [s], > 0.");
    add_parameter("First step size",
                  steps.first,
                  "Size of the first step [s]; later steps grow to the step "
                  "size by the growth factor. 0: the step size.");
    add_parameter("Growth factor",
                  steps.growth,
                  "Ratio of a step to the previous one [-], >= 1, until the "
                  "step size is reached.");
    add_parameter("Output every",
                  output_every,
                  "Number of steps between outputs of fields; 0: only at the "
                  "end of the stage.");
    add_parameter("Reset displacement",
                  reset_displacement,
                  "Whether displacements and plastic strains are reset to zero "
                  "at the beginning of this stage.");
    declare_failure(*this);
    declare_explicit_only(*this);
    declare_removal(*this, removed_where_text);
    declare_new_materials(*this);
  }

  void
  Stage::check_implicit() const
  {
    const std::string section = get_section_name().substr(1) + "/";
    const auto        refuse  = [&](const std::string &entry,
                            const std::string &value,
                            const std::string &unset) {
      throw InputError(section + entry,
                       value,
                       unset + " where Discretisation/Method is not explicit "
                                       "MPM",
                       "leave it out, or set Discretisation/Method = explicit "
                               "MPM");
    };
    // Damping and its limits belong to relaxation in explicit steps: unused
    // here (UsedWhere).
    for (const auto &[entry, value] :
         {std::pair<const char *, bool>("Reset velocity", reset_velocity),
          {"Reset history", reset_history}})
      if (value)
        refuse(entry, "true", "false");
  }

  void
  Stage::check_explicit() const
  {
    for (const auto &[entry, material] :
         {std::pair<std::string, std::string>(
            "Added materials",
            added_materials.empty() ? "" : added_materials.front()),
          {"Scaled loads", scales_loads() ? scaled_loads.front() : ""},
          {"Water table", water_table.empty() ? "" : "a line"},
          {"Water levels",
           water_levels.empty() ? "" : water_levels.begin()->first},
          {"Flow steps", flow_steps > 0 ? std::to_string(flow_steps) : ""},
          {"Changed materials",
           changed_materials.empty() ? "" : changed_materials.begin()->first}})
      if (!material.empty())
        throw InputError(get_section_name().substr(1) + "/" + entry,
                         material,
                         "nothing with explicit MPM",
                         "leave it out, or set Discretisation/Method = FEM or "
                         "MPM");
  }

  std::string
  Stage::removal_text(const unsigned long n_removed,
                      const unsigned long n_all,
                      const std::string  &what) const
  {
    if (n_removed == 0 || n_removed == n_all)
      throw StepFailure(
        "'Loading/" + name + "/" +
        (removed_polygon.empty() ? "Removed where" : "Removed polygon") +
        "' holds " + (n_removed == 0 ? "no" : "all") + " " + what +
        " of the body\n  allowed: a part of it\n"
        "  remedy:  compare it with where they are now");
    return format("removed %lu of %lu ", n_removed, n_all) + what +
           (removal_duration == 0. ? ""
                                   : format(" within %g s", removal_duration));
  }

  void
  Stage::prepare_changes()
  {
    const std::string section = get_section_name().substr(1) + "/";
    if (!removed_polygon.empty())
      check_polygon(removed_polygon, section + "Removed polygon");
    if (!removed_where_text.empty())
      {
        check_formula(removed_where_text,
                      section + "Removed where",
                      FormulaVariables::place);
        removed_where.emplace().prepare(removed_where_text,
                                        section + "Removed where");
      }
    if (!removes() && removal_duration > 0.)
      throw InputError(section + "Removal duration",
                       removal_duration,
                       "0 where nothing is removed",
                       "give 'Removed polygon' or 'Removed where', too");
    if (added_materials.empty() && addition_duration > 0.)
      throw InputError(section + "Addition duration",
                       addition_duration,
                       "0 where nothing is added",
                       "give 'Added materials', too");
    for (const auto &[entry, value] :
         {std::pair<const char *, double>("Removal duration", removal_duration),
          {"Addition duration", addition_duration}})
      if (value > duration)
        throw InputError(section + entry,
                         value,
                         "at most the duration of the stage",
                         "make the stage longer");
  }

  void
  Stage::prepare()
  {
    const std::string section = get_section_name().substr(1) + "/";
    if (!(duration > 0.))
      throw InputError(section + "Duration", duration, "> 0 s", "give seconds");
    if (!(steps.size > 0.))
      throw InputError(section + "Step size",
                       steps.size,
                       "> 0 s",
                       "the footing's examples take 0.01 s");
    if (!(steps.first >= 0.))
      throw InputError(section + "First step size",
                       steps.first,
                       ">= 0 s",
                       "0 stands for the step size");
    if (!(steps.growth >= 1.))
      throw InputError(section + "Growth factor",
                       steps.growth,
                       ">= 1",
                       "1 keeps the step size");
    if (steps.first > 0. && steps.first < steps.size && steps.growth == 1.)
      throw InputError(section + "Growth factor",
                       steps.growth,
                       "> 1 where the first step is smaller than the others",
                       "2 or 3 are usual");
    if (!(expected_steps() <= most_steps))
      throw InputError(section + "Step size",
                       steps.size,
                       "at most a hundred million steps in a stage",
                       "take larger steps, or a shorter 'Duration'");
    if (!(strength_factor == 0. ||
          (strength_factor >= 0.01 && strength_factor <= 1000.)))
      throw InputError(section + "Strength factor",
                       strength_factor,
                       "0, or 0.01 to 1000",
                       "3 with 'Until failure' = true is usual");
    if (scales_loads()
          ? !(control_velocity != 0. && std::isfinite(control_velocity))
          : control_velocity != 0.)
      throw InputError(section + "Control velocity",
                       control_velocity,
                       "a number other than zero where loads are scaled, and 0 "
                       "elsewhere",
                       "give 'Scaled loads' and the velocity, both or none");
    if (!(damping >= 0. && damping < 1.))
      throw InputError(section + "Damping",
                       damping,
                       "0 <= damping < 1",
                       "0 is none; 0.5 to 0.75 finds a state of rest");
    for (const auto &[entry, value] :
         {std::pair<const char *, double>("Largest unbalanced force",
                                          largest_unbalanced_force),
          {"Largest kinetic energy", largest_kinetic_energy},
          {"Removal duration", removal_duration},
          {"Addition duration", addition_duration}})
      if (!(value >= 0.))
        throw InputError(section + entry, value, ">= 0", "0 is none");
    prepare_changes();
  }

  bool
  Stage::removes(const dealii::Point<dim> &x) const
  {
    return removes() &&
           (removed_polygon.empty() || contains(removed_polygon, x)) &&
           (!removed_where || removed_where->value(x, 0.) > 0.);
  }

  bool
  Stage::scales(const std::string &load) const
  {
    return std::find(scaled_loads.begin(), scaled_loads.end(), load) !=
           scaled_loads.end();
  }

  double
  Stage::expected_steps() const
  {
    if (steps.first == 0. || steps.first >= steps.size)
      return std::max(1., std::ceil(duration / steps.size));
    // Steps h g^i < step size, with the sum h (g^n - 1)/(g - 1), then equal
    // ones.
    const double n =
      std::ceil(std::log(steps.size / steps.first) / std::log(steps.growth));
    const double sum =
      steps.first * (std::pow(steps.growth, n) - 1.) / (steps.growth - 1.);
    return n + std::max(0., std::ceil((duration - sum) / steps.size));
  }

  std::vector<double>
  Stage::step_sizes() const
  {
    std::vector<double> sizes;
    double              t = 0.;
    double              h =
      steps.first > 0. ? std::min(steps.first, steps.size) : steps.size;
    while (duration - t > 1e-9 * duration)
      {
        const double left = duration - t;
        // The last step is the remainder, stretched by up to 1e-6 of its size
        // to avoid a tiny step.
        sizes.push_back(left <= h * (1. + 1e-6) ? left : h);
        t += sizes.back();
        h = std::min(steps.size, h * steps.growth);
      }
    return sizes;
  }

  LoadingProgramme::LoadingProgramme(const ParameterFile &file)
    : NamedList(file,
                "Loading",
                "Names of the stages in order, comma-separated; each has a "
                "subsection of its name.",
                "push",
                "Stages")
  {
    make();
  }

  std::string
  Stage::no_equilibrium(const double accelerating_share) const
  {
    const double most =
      largest_kinetic_energy > 0. ? largest_kinetic_energy : 3e-3;
    return accelerating_share <= most
             ? ""
             : format(
                 "this is no equilibrium: %.3g of the plastic work becomes "
                 "kinetic energy, more than %.3g ('Loading/%s/Largest "
                 "kinetic energy')",
                 accelerating_share,
                 most,
                 name.c_str());
  }

  bool
  LoadingProgramme::reduces_strength() const
  {
    return std::any_of(list.begin(), list.end(), [](const auto &stage) {
      return stage->strength_factor > 0.;
    });
  }

  double
  LoadingProgramme::strength_factor(const double t) const
  {
    double begin = 0., factor = 1.;
    for (const auto &stage : list)
      {
        const double end = begin + stage->duration;
        if (stage->strength_factor > 0.)
          {
            if (t < end)
              return factor + (stage->strength_factor - factor) *
                                std::max(t - begin, 0.) / stage->duration;
            factor = stage->strength_factor;
          }
        else if (t < end)
          return factor;
        begin = end;
      }
    return factor;
  }

  double
  LoadingProgramme::factor_before(const std::string &stage) const
  {
    double factor = 1.;
    for (const auto &one : list)
      {
        if (one->name == stage)
          break;
        if (one->strength_factor > 0.)
          factor = one->strength_factor;
      }
    return factor;
  }

  double
  LoadingProgramme::duration() const
  {
    double sum = 0.;
    for (const auto &stage : list)
      sum += stage->duration;
    return sum;
  }

  const Stage &
  LoadingProgramme::stage_at(const double t) const
  {
    double end = 0.;
    for (const auto &stage : list)
      if (end += stage->duration; t < end)
        return *stage;
    return *list.back();
  }

  bool
  LoadingProgramme::scales_loads() const
  {
    return std::any_of(list.begin(), list.end(), [](const auto &stage) {
      return stage->scales_loads();
    });
  }

  bool
  LoadingProgramme::changes_body() const
  {
    return std::any_of(list.begin(), list.end(), [](const auto &stage) {
      return stage->changes_body();
    });
  }

  int
  LoadingProgramme::stage_that_adds(const std::string &material) const
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      if (const auto &added = list[i]->added_materials;
          std::find(added.begin(), added.end(), material) != added.end())
        return i;
    return -1;
  }

  bool
  LoadingProgramme::replaces_by(const std::string &material) const
  {
    for (const auto &stage : list)
      for (const auto &[from, to] : stage->changed_materials)
        if (to == material)
          return true;
    return false;
  }

  void
  LoadingProgramme::prepare(const std::vector<std::string> &materials,
                            const std::vector<std::string> &tractions)
  {
    require_one("push");
    const auto check_name = [&](const std::string &parameter,
                                const std::string &material) {
      if (std::find(materials.begin(), materials.end(), material) ==
          materials.end())
        throw InputError(parameter,
                         material,
                         "names in 'Materials/Names'",
                         "check the spelling");
    };
    std::vector<std::string> added;
    for (const auto &stage : list)
      {
        stage->prepare();
        for (const std::string &load : stage->scaled_loads)
          if (std::count(tractions.begin(), tractions.end(), load) +
                (load == "weight") !=
              1)
            throw InputError(
              "Loading/" + stage->name + "/Scaled loads",
              load,
              "'weight' and names in 'Tractions/Names', of which "
              "none may be 'weight'",
              "check the spelling");
        for (const auto &[from, to] : stage->changed_materials)
          for (const std::string &material : {from, to})
            check_name("Loading/" + stage->name + "/Changed materials",
                       material);
        for (const std::string &material : stage->added_materials)
          {
            const std::string parameter =
              "Loading/" + stage->name + "/Added materials";
            check_name(parameter, material);
            if (std::find(added.begin(), added.end(), material) != added.end())
              throw InputError(parameter,
                               material,
                               "each material once",
                               "a material cannot be added twice: leave it out "
                               "here, or give the second part a material of "
                               "its own");
            added.push_back(material);
            if (added.size() == materials.size())
              throw InputError(parameter,
                               material,
                               "not all of 'Materials/Names'",
                               "leave the material out that is there from the "
                               "start");
          }
      }
  }

  Gravity::Gravity()
    : dealii::ParameterAcceptor("/Gravity")
  {
    add_parameter("Acceleration",
                  acceleration,
                  "Acceleration of gravity g_x, g_y [m/s^2], e.g. 0, -9.81; 0, "
                  "0: no gravity.");
    add_parameter("Ramp duration",
                  ramp_duration,
                  "Time [s] over which gravity grows linearly from zero; 0: "
                  "full gravity from the first step.");
  }

  void
  Gravity::prepare()
  {
    if (!(ramp_duration >= 0.))
      throw InputError("Gravity/Ramp duration",
                       ramp_duration,
                       ">= 0 s",
                       "0 switches gravity on at once");
  }

  dealii::Tensor<1, dim>
  Gravity::at(const double t) const
  {
    return ramp_duration > 0. ? std::min(1., t / ramp_duration) * acceleration
                              : acceleration;
  }
} // namespace geocone::GEOCONE_DIM
