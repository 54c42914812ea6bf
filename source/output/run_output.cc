// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/run_output.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  void
  RunOutput::prepare(const RunOptions &options,
                     const Scene      &of_run,
                     const bool        points_move_,
                     const bool        points_leave_,
                     const bool        consolidates_)
  {
    points_move  = points_move_;
    points_leave = points_leave_;
    consolidates = consolidates_;
    begin(options, of_run);
    if (const auto &load = scene->observation.reference)
      reference_case.set_default("limit_load/value", *load);
    fields = std::make_unique<Fields>(fields_format);

    add_load_columns();
    add_solver_columns();
    add_balance_columns();
    if (scene->has_contact())
      add_contact_columns();
    table.add("energy identity error (-)",
              [](const Record &r) { return r.last.identity_error; });
    add_observed_columns();
    add_structure_columns();
    add_pressure_columns();
    open_table("statistics.csv");
    if (!writes)
      return;
    newton.open(path + "/newton.csv",
                {"step",
                 "time (s)",
                 "step size (s)",
                 "converged",
                 "iteration",
                 "relative residual (-)",
                 "step length (-)",
                 "elastic blend (-)",
                 "friction lag (-)",
                 "cone points",
                 "apex points",
                 "switched points"},
                resumes);
    if (!scene->structures.plates().empty())
      plates.open(path + "/plates.csv",
                  {"step",
                   "time (s)",
                   "plate",
                   "distance along it (m)",
                   "x (m)",
                   "y (m)",
                   "displacement x (m)",
                   "displacement y (m)",
                   unit("axial force (N/m)"),
                   unit("shear force (N/m)"),
                   unit("bending moment (N m/m)"),
                   "plastic rotation (-)"},
                  resumes);
  }

  void
  RunOutput::add_load_columns()
  {
    add_time_columns();
    add("displacement (m)", [](const Record &r) { return r.displacement; });
    add(load_is_number() ? "load (-)" : "load (N/m)",
        [](const Record &r) { return r.load; });
    const auto supports = scene->supports();
    for (const unsigned int c : scene->observation.conditions)
      for (unsigned int d = 0; d < dim; ++d)
        table.add(
          "reaction " + supports[c] + " " + coordinate[d] + unit(" (N/m)"),
          [c, d](const Record &r) { return r.last.reactions[c].force[d]; });
    if (scene->loading.reduces_strength())
      table.add("strength factor (-)", [this](const Record &r) {
        return scene->loading.strength_factor(r.time);
      });
    if (scene->loading.scales_loads())
      {
        table.add("load factor (-)",
                  [](const Record &r) { return r.last.load_factor; });
        table.add("displacement of scaled loads (m)",
                  [](const Record &r) { return r.scaled; });
      }
  }

  void
  RunOutput::add_solver_columns()
  {
    const auto add_quality = [&](const char *column, double Quality::*member) {
      table.add(column,
                [member](const Record &r) { return r.last.quality.*member; });
    };
    table.add("iterations (-)", [](const Record &r) { return r.iterations; });
    table.add("substeps (-)", [](const Record &r) { return r.substeps; });
    table.add("failed substeps (-)",
              [](const Record &r) { return r.failures; });
    table.add("residual (-)",
              [](const Record &r) { return r.last.newton.residual; });
    table.add("friction lag (-)",
              [](const Record &r) { return r.last.newton.friction_lag; });
    add_quality("cone excess (Pa)", &Quality::cone_excess);
    add_quality("excess work (-)", &Quality::excess_share);
    if (scene->materials.traits().can_yield)
      {
        add_quality("natural-map error (-)", &Quality::natural_map);
        add_quality("natural-map error of the exact law (-)",
                    &Quality::exact_natural_map);
        add_quality("cone violation (-)", &Quality::cone_violation);
        add_quality("dual-cone violation (-)", &Quality::dual_violation);
        add_quality("complementarity (-)", &Quality::complementarity);
      }
    table.add("plastic points (-)", [](const Record &r) {
      const NewtonIteration &end = r.last.newton.table.back();
      return end.n_cone + end.n_apex;
    });
    table.add("apex points (-)", [](const Record &r) {
      return r.last.newton.table.back().n_apex;
    });
    add_strain_columns();
    table.add("unknowns (-)", [](const Record &r) { return r.last.unknowns; });
    table.add("multipliers (-)",
              [](const Record &r) { return r.last.multipliers; });
    table.add("multiplier rows given (-)",
              [](const Record &r) { return r.last.rows; });
  }

  void
  RunOutput::add_balance_columns()
  {
    // Sums over the run, since a record only has those of its step.
    const auto add_work = [&](const std::string &column,
                              double Works::*member) {
      add(column,
          [this, member](const Record &) { return balance.works().*member; });
    };
    add_energy_columns(true);
    add_work("plastic dissipation (J/m)", &Works::dissipation);
    add_work("external work (J/m)", &Works::external);
    if (scene->has_contact())
      add_work("contact dissipation (J/m)", &Works::contact_dissipation);
    add("total energy (J/m)",
        [this](const Record &) { return balance.total(); });
    if (scene->loading.changes_body() || points_leave)
      add("removed energy (J/m)",
          [this](const Record &) { return balance.removed(); });
    add_loss_columns();
    if (scene->materials.traits().has_friction_memory())
      add_work("work of friction memory (J/m)", &Works::excess_work);
    if (points_move)
      add_work("work of ghost stiffness (J/m)", &Works::ghost_work);
  }

  void
  RunOutput::add_contact_columns()
  {
    table.add("contact penetration (m)",
              [](const Record &r) { return r.last.contact.penetration; });
    table.add("contact natural-map error (-)",
              [](const Record &r) { return r.last.contact.error; });
    table.add("sticking nodes (-)",
              [](const Record &r) { return r.last.contact.stick; });
    table.add("slipping nodes (-)",
              [](const Record &r) { return r.last.contact.slip; });
  }

  void
  RunOutput::add_structure_columns()
  {
    const auto names = scene->structures.names_of_bars();
    for (unsigned int bar = 0; bar < names.size(); ++bar)
      {
        const auto state = [bar](const Record &r) -> const BarState & {
          return r.last.bars[bar];
        };
        add("axial force " + names[bar] + " (N/m)",
            [state](const Record &r) { return state(r).force; });
        add("elongation " + names[bar] + " (m)",
            [state](const Record &r) { return state(r).elongation; });
        add("yields " + names[bar] + " (-)",
            [state](const Record &r) { return state(r).yields; });
      }
    const auto plates_of_scene = scene->structures.plates();
    for (unsigned int plate = 0; plate < plates_of_scene.size(); ++plate)
      {
        const std::string &name = plates_of_scene[plate]->name;
        add("largest bending moment " + name + " (N m/m)",
            [plate](const Record &r) {
              return r.last.plates[plate].largest(size_of_moment).moment;
            });
        add("largest displacement " + name + " (m)", [plate](const Record &r) {
          return r.last.plates[plate]
            .largest(size_of_displacement)
            .displacement.norm();
        });
        add("plastic hinges " + name + " (-)",
            [plate](const Record &r) { return r.last.plates[plate].n_hinges; });
      }
  }

  void
  RunOutput::add_plates(const Record &record)
  {
    for (unsigned int plate = 0; plate < record.last.plates.size(); ++plate)
      if (record.last.plates[plate].acts)
        for (const PlatePoint &point : record.last.plates[plate].points)
          plates.add_line({double(record.step),
                           record.time,
                           plate + 1.,
                           point.arc,
                           point.x[0],
                           point.x[1],
                           point.displacement[0],
                           point.displacement[1],
                           point.normal,
                           point.shear,
                           point.moment,
                           point.hinge});
  }

  void
  RunOutput::add_pressure_columns()
  {
    if (consolidates)
      {
        table.add(scene->geometry.is_axisymmetric()
                    ? "outflow of water (m^3/s)"
                    : "outflow of water (m^2/s)",
                  [](const Record &r) { return r.last.water.outflow; });
        table.add("error of the water balance (-)",
                  [](const Record &r) { return r.last.water.error; });
      }
    if (scene->materials.traits().undrained)
      add_observed_pressures();
  }

  void
  RunOutput::state_of_run(StateRow &row)
  {
    SceneOutput::state_of_run(row);
    row(newton, plates, *fields, n_load_jumps);
  }

  void
  RunOutput::add_newton_table(const unsigned int step,
                              const double       time,
                              const double       h,
                              const StepReport  &report)
  {
    if (verbosity >= 2)
      log.print(
        format("  step %u, t = %.6g s, h = %.3g s\n"
               "    it   residual   length    blend      lag     cone   apex  "
               "switched",
               step,
               time,
               h));
    for (std::size_t i = 0; i < report.newton.table.size(); ++i)
      {
        const NewtonIteration &line = report.newton.table[i];
        if (verbosity >= 2)
          log.print(format("    %2zu  %9.2e  %7.3f  %7.3f  %7.3f  %7u %6u  %8u",
                           i,
                           line.relative_residual,
                           line.step_length,
                           line.elastic_blend,
                           line.friction_lag,
                           line.n_cone,
                           line.n_apex,
                           line.n_switched));
        if (writes)
          newton.add_line({double(step),
                           time,
                           h,
                           double(report.converged),
                           double(i),
                           line.relative_residual,
                           line.step_length,
                           line.elastic_blend,
                           line.friction_lag,
                           double(line.n_cone),
                           double(line.n_apex),
                           double(line.n_switched)});
      }
  }

  void
  RunOutput::add_step(const ImplicitRecord &record)
  {
    balance.add_step(
      record.last.energies, record.last.of_lost, record.last.works);
    add_record(record);
    if (writes)
      add_plates(record);
    records.back().last.newton.table.clear(); // only the numbers are kept
    warn_of_jump();
    balance.warn_if_created(
      log, record.time, unit("J/m"), 0., "take smaller steps");
  }

  bool
  moves_on(const ImplicitRecord &a,
           const ImplicitRecord &b,
           const ImplicitRecord &c)
  {
    return !b.resets && !c.resets &&
           (b.displacement - a.displacement) *
               (c.displacement - b.displacement) >
             0.;
  }

  void
  RunOutput::warn_of_jump()
  {
    // The last but one load, if the support has moved in one direction and the loads
    // before and after it are about equal.
    const std::size_t n = records.size();
    if (n < 3 || !scene->observation.has_load())
      return;
    const ImplicitRecord &a = records[n - 3], &b = records[n - 2],
                         &c = records[n - 1];
    const double around     = (a.load + c.load) / 2.;
    if (!moves_on(a, b, c) ||
        std::abs(c.load - a.load) > 0.25 * std::abs(around) ||
        std::abs(b.load - around) <= 0.5 * std::abs(around))
      return;
    ++n_load_jumps;
    if (n_load_jumps == 1)
      log.warn(format("the load jumps from %.4g to %.4g %s and back to %.4g "
                      "%s around t = %.4g s (step %u), where its support moves "
                      "on: what it rests on may not be sound there; smaller "
                      "cells, more points or smaller steps show it",
                      a.load,
                      b.load,
                      unit("N/m").c_str(),
                      c.load,
                      unit("N/m").c_str(),
                      b.time,
                      b.step));
  }

  void
  RunOutput::write_fields(const double                    time,
                          const BackgroundMesh           &mesh,
                          const Space                    &space,
                          const MaterialPoints           &points,
                          const Kinematics               &kinematics,
                          const std::vector<RigidMotion> &moved_obstacles)
  {
    if (!with_fields)
      return;
    fields->write(
      path, time, mesh, space, points, scene->materials, kinematics);
    fields->write_obstacles(
      path, time, mesh, scene->obstacles, moved_obstacles);
  }
} // namespace geocone::GEOCONE_DIM
