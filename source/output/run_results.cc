// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Results of a run: its summary and printed results.
#include <geocone/base/units.h>
#include <geocone/output/run_output.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Smallest growth of displacements that indicates failure. */
    constexpr double least_growth = 3.;
  } // namespace

  std::optional<double>
  RunOutput::growth_of_displacement() const
  {
    double first = 0., last = 0.;
    for (std::size_t i = 1; i < records.size(); ++i)
      {
        const ImplicitRecord &now = records[i], &before = records[i - 1];
        const double reduction = scene->loading.strength_factor(now.time) -
                                 scene->loading.strength_factor(before.time);
        if (!(reduction > 0.))
          continue;
        double most = 0.;
        for (std::size_t k = 0; k < now.displacements.size(); ++k)
          most = std::max(most,
                          (now.resets
                             ? now.displacements[k]
                             : now.displacements[k] - before.displacements[k])
                            .norm());
        last = most / reduction;
        if (first == 0.)
          first = last;
      }
    return first > 0. ? std::optional(last / first) : std::nullopt;
  }

  std::optional<Failure>
  RunOutput::onset_of_motion() const
  {
    bool reduces = false;
    for (std::size_t i = 1; i < records.size(); ++i)
      {
        const ImplicitRecord &now = records[i], &before = records[i - 1];
        const Stage          &stage =
          scene->loading.stage_at((before.time + now.time) / 2.);
        reduces = reduces || stage.strength_factor > 0.;
        if (!reduces || stage.requires_equilibrium())
          continue;
        const Energies   &energies = now.last.energies;
        const std::string reason   = stage.no_equilibrium(
          share_of_plastic_work(energies.kinetic - before.last.energies.kinetic,
                                now.last.works.dissipation,
                                energies.kinetic,
                                energies.elastic));
        if (!reason.empty())
          return Failure{stage.name, before.time, now.time, reason};
      }
    return std::nullopt;
  }

  Json
  RunOutput::safety() const
  {
    const LoadingProgramme &loading = scene->loading;
    const double            end = records.empty() ? 0. : records.back().time;
    if (!failure)
      {
        const auto   motion = onset_of_motion();
        const bool   whole  = end >= (1. - 1e-9) * loading.duration();
        const double sustained =
          loading.strength_factor(motion ? motion->carried_until : end);
        const bool is_known =
          motion ? sustained > loading.factor_before(motion->stage)
                 : whole || sustained != 1.;
        return {
          {"factor", Json()},
          {"displacement_growth", Json()},
          {"lower", is_known ? Json(sustained) : Json()},
          {"upper", Json()},
          {"criterion",
           motion
             ? format("the body accelerates by the strength factor %.4f, at t "
                      "= %.6g s: ",
                      loading.strength_factor(motion->not_until),
                      motion->not_until) +
                 motion->reason
           : whole ? "equilibrium is found for all factors of the stages"
                   : "the stages have not come to their end"}};
      }
    // If even the first reduction fails, the body may have failed before.
    const double lower = loading.strength_factor(failure->carried_until),
                 upper = loading.strength_factor(failure->not_until);
    const bool found   = lower > loading.factor_before(failure->stage);
    const auto growth  = growth_of_displacement();
    return {{"factor", found ? Json((lower + upper) / 2.) : Json()},
            {"displacement_growth", growth ? Json(*growth) : Json()},
            {"lower", found ? Json(lower) : Json()},
            {"upper", Json(upper)},
            {"criterion",
             found ? "no equilibrium is found at the upper factor"
                   : "no equilibrium is found at the first reduction: the "
                     "factor is where the stage begins, or less"}};
  }

  Json
  RunOutput::contact() const
  {
    ContactReport worst;
    for (const ImplicitRecord &record : records)
      worst.take_worse(record.last.contact);
    const ContactReport last =
      records.empty() ? ContactReport() : records.back().last.contact;
    const bool in_plane = scene->geometry.unit("N/m") == "N/m";
    const auto touched  = [&](const double size) {
      return points_move ? Json() : Json(size);
    };
    return {
      {"penetration_max", worst.penetration},
      {"natural_map_error_max", worst.error},
      {"open", last.open},
      {"stick", last.stick},
      {"slip", last.slip},
      {in_plane ? "width_m" : "area_m2", touched(last.width)},
      {in_plane ? "stick_width_m" : "stick_area_m2", touched(last.stick_width)},
      {"pressure_max_Pa", touched(last.pressure)},
      {"shear_max_Pa", touched(last.shear)},
      {unit("dissipation_J_per_m"), balance.works().contact_dissipation}};
  }

  Json
  RunOutput::structures() const
  {
    Json       json;
    const auto names = scene->structures.names_of_bars();
    for (unsigned int bar = 0; bar < names.size(); ++bar)
      {
        const BarState &last = records.back().last.bars[bar];
        double          most = last.force, least = last.force;
        for (const ImplicitRecord &record : records)
          {
            most  = std::max(most, record.last.bars[bar].force);
            least = std::min(least, record.last.bars[bar].force);
          }
        const std::string key            = Structures::key_of(names[bar]) + "_";
        json[key + "force_N_per_m"]      = last.force;
        json[key + "force_most_N_per_m"] = most;
        json[key + "force_least_N_per_m"]  = least;
        json[key + "elongation_m"]         = last.elongation;
        json[key + "plastic_elongation_m"] = last.plastic;
        json[key + "yields"]               = last.yields;
      }
    for (unsigned int i = 0; i < scene->structures.plates().size(); ++i)
      add_plate(json, i);
    return json;
  }

  void
  RunOutput::add_plate(Json &json, const unsigned int plate) const
  {
    const auto plate_of =
      [plate](const ImplicitRecord &record) -> const PlateState & {
      return record.last.plates[plate];
    };
    const auto axial = [](const PlatePoint &point) { return point.normal; };
    const auto compression = [](const PlatePoint &point) {
      return -point.normal;
    };
    const auto shear = [](const PlatePoint &point) {
      return std::abs(point.shear);
    };
    double moment_of_all = 0.;
    for (const ImplicitRecord &record : records)
      moment_of_all =
        std::max(moment_of_all,
                 size_of_moment(plate_of(record).largest(size_of_moment)));
    const PlateState &last = plate_of(records.back());
    const PlatePoint &most = last.largest(size_of_moment);
    const std::string key =
      Structures::key_of(scene->structures.plates()[plate]->name) + "_";
    json[key + "moment_N"]                  = most.moment;
    json[key + "moment_at_m"]               = most.arc;
    json[key + "moment_of_all_steps_N"]     = moment_of_all;
    json[key + "shear_force_N_per_m"]       = last.largest(shear).shear;
    json[key + "axial_force_most_N_per_m"]  = last.largest(axial).normal;
    json[key + "axial_force_least_N_per_m"] = last.largest(compression).normal;
    json[key + "displacement_m"] =
      last.largest(size_of_displacement).displacement.norm();
    json[key + "plastic_hinges"] = last.n_hinges;
  }

  Json
  RunOutput::friction_memory() const
  {
    // The load reflects the strength at an earlier time, by tau dF/dt.
    Json         delay;
    const auto   n           = records.size();
    const double tau         = scene->materials.traits().friction_memory;
    const double work        = balance.works().excess_work;
    const double dissipation = balance.works().dissipation;
    if (n > 1 && scene->observation.has_load())
      {
        const ImplicitRecord &a = records[n - 2], &b = records[n - 1];
        if (b.time > a.time && b.load != 0.)
          delay = tau * (b.load - a.load) / (b.time - a.time) / b.load;
      }
    return {
      {"tau_s", tau},
      {unit("work_J_per_m"), work},
      {"work_relative", dissipation > 0. ? Json(work / dissipation) : Json()},
      {"load_delay_relative", delay}};
  }

  Json
  RunOutput::motion() const
  {
    Motion worst;
    for (const ImplicitRecord &record : records)
      worst.take_worse(record.last.motion);
    const Works             &works = balance.works();
    const dealii::Point<dim> front =
      records.empty() ? worst.front : records.back().last.motion.front;
    // While the support moves in one direction: steps whose load is more than 5 % below
    // those before and after, and the largest fall from one step to the next.
    unsigned int n_drops      = 0;
    double       largest_fall = 0.;
    for (std::size_t i = 1; i + 1 < records.size(); ++i)
      {
        const ImplicitRecord &a = records[i - 1], &b = records[i],
                             &c = records[i + 1];
        if (!moves_on(a, b, c))
          continue;
        n_drops += std::abs(b.load) <
                   0.95 * std::min(std::abs(a.load), std::abs(c.load));
        if (std::abs(b.load) > 0.)
          largest_fall =
            std::max(largest_fall, 1. - std::abs(c.load) / std::abs(b.load));
      }
    return {
      {"load_drops", n_drops},
      {"largest_fall_relative", largest_fall},
      {"points_behind", worst.points_behind},
      {"points_put_back_max", worst.points_returned},
      {"put_back_max_m", worst.returned_by},
      {"empty_functions", worst.light_functions},
      {"light_share_max", worst.low_mass_share},
      {"front_x_m", front[0]},
      {"front_y_m", front[1]},
      {unit("ghost_work_J_per_m"), works.ghost_work},
      {"ghost_work_relative",
       works.external > 0. ? Json(works.ghost_work / works.external) : Json()}};
  }

  void
  RunOutput::warn_of_memory() const
  {
    const Json  &memory    = summary["friction_memory"];
    const double work_part = memory["work_relative"].is_null()
                               ? 0.
                               : memory["work_relative"].get<double>();
    const double delay     = memory["load_delay_relative"].is_null()
                               ? 0.
                               : memory["load_delay_relative"].get<double>();
    if (!(work_part > 0.))
      return;
    std::string felt =
      format("strength differs from the exact law's by %.2g %% "
             "of the plastic work",
             100. * work_part);
    if (std::abs(delay) > 0.005)
      felt +=
        format(", and the last load still changes by %.2g %% in this time",
               100. * std::abs(delay));
    log.warn(
      format("friction has a memory of %.3g s: ",
             memory["tau_s"].get<double>()) +
      felt +
      (work_part > 0.005 || std::abs(delay) > 0.005
         ? "; compare with half of it ('Materials/NAME/Friction memory') "
           "or a longer run"
         : ""));
  }

  Json
  RunOutput::limit_load() const
  {
    std::vector<LoadPoint> curve;
    double                 offset = 0.;
    for (const ImplicitRecord &record : records)
      {
        // A reset of the displacement is not a step of the curve.
        if (record.resets && !curve.empty())
          offset = curve.back().displacement;
        curve.push_back({offset + record.displacement, record.load});
      }
    const LimitLoad limit =
      find_limit_load(curve, scene->observation.plateau_tolerance);
    const auto &reference = scene->observation.reference;
    const Json  nothing;
    return {
      {"value", limit.found ? Json(limit.value) : nothing},
      {"unit", load_is_number() ? "-" : unit("N/m")},
      {"reference", reference ? Json(*reference) : nothing},
      {"reference_name",
       reference ? Json(scene->observation.reference_name) : nothing},
      {"relative_error",
       limit.found && reference ? Json(limit.value / *reference - 1.)
                                : nothing},
      {"band_low", limit.found ? Json(limit.band_low) : nothing},
      {"band_high", limit.found ? Json(limit.band_high) : nothing},
      {"plateau_begins_at", limit.found ? Json(limit.begins_at) : nothing},
      {"reason", limit.found ? nothing : Json(limit.reason)},
      {"drift", limit.drift},
      {"peak", limit.peak},
      {"last", curve.empty() ? nothing : Json(curve.back().load)},
      {"load_jumps", n_load_jumps}};
  }

  Json
  RunOutput::newton_statistics() const
  {
    unsigned int iterations = 0, most = 0, substeps = 0, failures = 0,
                 regularised = 0, lagging = 0, at_floor = 0;
    double residual = 0., lag = 0.;
    for (const ImplicitRecord &record : records)
      {
        regularised += record.regularised;
        iterations += record.iterations;
        most = std::max(most, record.iterations);
        substeps += record.substeps;
        failures += record.failures;
        residual = std::max(residual, record.last.newton.residual);
        lag      = std::max(lag, record.last.newton.friction_lag);
        lagging += record.last.newton.friction_lag > 0.;
        at_floor += record.last.newton.at_rounding_floor;
      }
    return {{"steps", records.size()},
            {"substeps", substeps},
            {"iterations_mean",
             records.empty() ? 0. : double(iterations) / records.size()},
            {"iterations_per_substep",
             substeps == 0 ? 0. : double(iterations) / substeps},
            {"iterations_max", most},
            {"failures", failures},
            {"regularised", regularised},
            {"residual_max", residual},
            {"steps_at_rounding_floor", at_floor},
            {"steps_with_friction_lag", lagging},
            {"friction_lag_max", lag}};
  }

  Json
  RunOutput::results() const
  {
    Quality quality;
    double  identity = 0.;
    for (const ImplicitRecord &record : records)
      {
        quality.take_worse(record.last.quality);
        identity = std::max(identity, record.last.identity_error);
      }

    Json json;
    if (scene->observation.has_load())
      json["limit_load"] = limit_load();
    if (!records.empty())
      {
        add_pressures(json);
        add_points(json);
      }
    json["newton"] = newton_statistics();
    if (scene->materials.traits().has_friction_memory())
      json["friction_memory"] = friction_memory();
    if (scene->has_contact())
      json["contact"] = contact();
    if (!scene->structures.list.empty() && !records.empty())
      json["structures"] = structures();
    if (points_move)
      json["motion"] = motion();
    Json        &of_state    = json["quality"];
    const double dissipation = balance.works().dissipation;
    of_state                 = {
                      {"cone_excess_max_Pa", quality.cone_excess},
                      {"excess_work_step_max", quality.excess_share},
                      {"excess_work_relative",
       dissipation > 0. ? balance.works().excess_work / dissipation : 0.}};
    if (scene->materials.traits().can_yield)
      of_state.update(
        Json{{"natural_map_error_max", quality.natural_map},
             {"complementarity_max", quality.complementarity},
             {"cone_violation_max", quality.cone_violation},
             {"dual_cone_violation_max", quality.dual_violation},
             {"exact_natural_map_error_max", quality.exact_natural_map}});
    if (!records.empty())
      {
        const StepReport &last = records.back().last;
        json["state"]          = {
                   {"largest_plastic_strain", last.largest_plastic_strain}};
        Json &topic                        = json["energy"];
        topic                              = energy(scene->gravity.is_ramped());
        topic[unit("elastic_J_per_m")]     = last.energies.elastic;
        topic[unit("dissipation_J_per_m")] = dissipation;
        topic["identity_error_max"]        = identity;
      }
    add_outcome(json);
    return json;
  }

  void
  RunOutput::add_outcome(Json &json) const
  {
    if (scene->loading.reduces_strength())
      json["safety"] = safety();
    if (bracket)
      {
        json["bounds"] = bracket->bounds();
        if (!bracket->is_associated)
          {
            Json      &topic     = json["non_associated"];
            const auto load      = bracketed_load(json);
            topic                = bracket->non_associated();
            topic["incremental"] = load ? Json(*load) : Json();
          }
      }
    if (field_errors) // relative errors need a non-zero exact field
      json["field_errors"] = {
        {"displacement", finite_or_null(field_errors->displacement)},
        {"stress", finite_or_null(field_errors->stress)}};
    if (failure)
      json["failure"] = {{"stage", failure->stage},
                         {"carried_until_s", failure->carried_until},
                         {"not_until_s", failure->not_until},
                         {"reason", failure->reason}};
  }

  std::optional<double>
  RunOutput::bracketed_load(const Json &of_run) const
  {
    if (!bracket || bracket->unit != unit("N/m") ||
        !of_run.contains("limit_load") ||
        of_run["limit_load"]["value"].is_null())
      return std::nullopt;
    return of_run["limit_load"]["value"].get<double>();
  }

  void
  RunOutput::set_failure(const Failure &what)
  {
    failure = what;
    log.print(format("failure: the loads of the stage '%s' are carried until t "
                     "= %.6g s, and not until %.6g s",
                     what.stage.c_str(),
                     what.carried_until,
                     what.not_until));
  }

  void
  RunOutput::print_result() const
  {
    if (!writes)
      return;
    const Json &newton_part = summary["newton"];
    log.print(format("%zu steps, %.1f iterations per step (at most %u), %u "
                     "failed substeps",
                     records.size(),
                     newton_part["iterations_mean"].get<double>(),
                     newton_part["iterations_max"].get<unsigned int>(),
                     newton_part["failures"].get<unsigned int>()));
    if (points_move)
      warn_of_untouched();
    if (scene->materials.traits().can_yield)
      log.print(
        format("natural-map error <= %.1e, complementarity <= %.1e, cone "
               "violation <= %.1e",
               summary["quality"]["natural_map_error_max"].get<double>(),
               summary["quality"]["complementarity_max"].get<double>(),
               summary["quality"]["cone_violation_max"].get<double>()));
    if (const auto n = newton_part["steps_at_rounding_floor"].get<unsigned>())
      log.print(format("%u of %zu steps are solved up to rounding, which is "
                       "above 'Newton/Tolerance' (residual <= %.1e)",
                       n,
                       records.size(),
                       newton_part["residual_max"].get<double>()));
    if (const auto n = newton_part["steps_with_friction_lag"].get<unsigned>())
      log.warn(format(
        "friction lags in %u of %zu steps (by at most %.2g of a "
        "step): the exact strength is exceeded by up to %.3g Pa, "
        "and strength differs from it by %.2g %% of the plastic "
        "work (of a step by up to %.2g %%); compare with smaller "
        "steps, with 'Materials/NAME/Friction memory', or with "
        "another 'Discretisation/Element'",
        n,
        records.size(),
        newton_part["friction_lag_max"].get<double>(),
        summary["quality"][key_in_units("cone_excess_max_Pa")].get<double>(),
        100. * summary["quality"]["excess_work_relative"].get<double>(),
        100. * summary["quality"]["excess_work_step_max"].get<double>()));
    if (scene->materials.traits().has_friction_memory())
      warn_of_memory();
    if (summary.contains("safety"))
      print_safety();
    if (summary.contains("limit_load"))
      print_limit_load();
    if (bracket)
      {
        log.print(bracket->text());
        if (const auto load = bracketed_load(summary))
          log.print(bracket->beside(*load));
      }
    if (field_errors)
      log.print(format("relative L2 errors: displacement %.3e, stress %.3e",
                       field_errors->displacement,
                       field_errors->stress));
    const Json &cost  = summary["cost"];
    const Json &ratio = cost["ratio_to_factorise_and_solve"];
    log.print(format(
      "%.1f s in all; step loop %.2f s = %.2f x its factorisations and solves; "
      "%.0f MB at most",
      cost["total_s"].get<double>(),
      cost["step_loop_s"].get<double>(),
      ratio.is_null() ? 0. : ratio.get<double>(),
      cost["peak_memory_MB"].get<double>()));
  }

  bool
  RunOutput::load_is_number() const
  {
    return scene->observation.of_scaled_loads &&
           std::abs(scene->observation.factor) == 1.;
  }

  void
  RunOutput::print_safety() const
  {
    const Json &safety = summary["safety"];
    if (safety["factor"].is_number())
      log.print(
        format("factor of safety %.4f (equilibrium is found at %.4f, and "
               "not at %.4f)",
               safety["factor"].get<double>(),
               safety["lower"].get<double>(),
               safety["upper"].get<double>()));
    else if (failure)
      log.warn(format("no factor of safety: no equilibrium is found at the "
                      "first reduction, by %.4f; the body may fail without "
                      "any: let the stages begin with a 'Strength factor' "
                      "below 1, e.g. 0.5, and rise from there",
                      safety["upper"].get<double>()));
    else if (onset_of_motion())
      log.warn(safety["criterion"].get<std::string>() +
               "; 'Until failure = true' finds a factor of safety");
    else if (const auto &stages = scene->loading.list;
             std::any_of(stages.begin(), stages.end(), [](const auto &stage) {
               return stage->requires_equilibrium();
             }))
      log.warn(format(
        "no factor of safety: equilibrium is found for all "
        "factors, up to %.4g: raise 'Strength factor'",
        safety["lower"].is_number() ? safety["lower"].get<double>() : 1.));
    else if (safety["lower"].is_number())
      log.print(format("equilibrium is found with strength divided by %.4g",
                       safety["lower"].get<double>()));
    if (!safety["displacement_growth"].is_number())
      return;
    const double growth = safety["displacement_growth"].get<double>();
    log.print(format("by the last reduction the observed points move %.3g "
                     "times as fast per factor as by the first one",
                     growth));
    if (growth < least_growth)
      log.warn("a slope that fails moves ever faster, and this one does "
               "not: a step may have failed for another reason (log.txt), "
               "or the observed points are not on what slides");
  }

  void
  RunOutput::print_limit_load() const
  {
    const Json       &limit     = summary["limit_load"];
    const bool        is_number = load_is_number();
    const std::string of_load   = is_number ? "" : " " + unit("N/m");
    const auto        text      = [&](const char *name) {
      return format(is_number ? "%.4f" : "%.2f", limit[name].get<double>());
    };
    if (limit["value"].is_null())
      log.print("limit load: none, " + limit["reason"].get<std::string>());
    else
      {
        std::string line = (is_number ? "limit load factor " : "limit load ") +
                           text("value") + of_load;
        if (limit["band_high"] != limit["band_low"])
          line +=
            " (band " + text("band_low") + " to " + text("band_high") + ")";
        if (!limit["reference"].is_null())
          line += ", " + limit["reference_name"].get<std::string>() + " " +
                  text("reference") + of_load +
                  format(", error %+.3f %%",
                         100. * limit["relative_error"].get<double>());
        log.print(line);
      }
  }

  void
  RunOutput::report_results(std::ostream &out) const
  {
    out << "time [s]  displacement [mm]  load [" << unit("N/m") << "]\n";
    for (const ImplicitRecord &record : records)
      out << format("%.6g %.6g %.8g\n",
                    record.time,
                    1e3 * record.displacement,
                    record.load);
    if (summary.contains("limit_load"))
      {
        const Json &limit = summary["limit_load"];
        if (limit["value"].is_null())
          out << "no limit load\n";
        else
          out << format("limit load %.8g\n", limit["value"].get<double>());
        if (limit["relative_error"].is_number())
          out << format("error %.5g %%\n",
                        100. * limit["relative_error"].get<double>());
      }
    // Bodies without external work only have their initial energy.
    const Works &works = balance.works();
    const double turnover =
      std::abs(works.external) + std::abs(works.dissipation);
    const double scale =
      turnover > 0. ? turnover : std::max(balance.initial().sum(), 1e-300);
    const Energies &e = records.back().last.energies;
    out << format("elastic %.6g %% dissipated %.6g %% kinetic %.4g %% of "
                  "the work\n",
                  100. * e.elastic / scale,
                  100. * works.dissipation / scale,
                  100. * e.kinetic / scale);
    if (field_errors)
      out << format("field errors: displacement %.4g %%, stress %.4g %%\n",
                    100. * field_errors->displacement,
                    100. * field_errors->stress);
    out << "unknowns " << summary["size"]["dofs"] << " points "
        << summary["size"]["points"] << "\n";
  }
} // namespace geocone::GEOCONE_DIM
