// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/element/element_test.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_element_test[] = {
      {"Element/*", "Discretisation/Method", {"point"}}};
  } // namespace

  ElementTest::ElementTest(const MPI_Comm       comm,
                           const ParameterFile &file,
                           Log                 &log)
    : Simulation(comm, log)
    , dealii::ParameterAcceptor("/Element")
    , materials(file)
    , path(file)
    , element_output(comm, log)
  {
    components.declare(
      *this,
      "Components",
      ". Components of stress and strain. Automatic: 3D if the law supports "
      "it. Plane strain: xx, yy, xy, as in plane scenes. Axisymmetric: xx, yy, "
      "zz, xy, as in axisymmetric scenes, for laws that support them.");
    add_parameter("Initial stress",
                  initial_stress,
                  "Initial stress xx, yy, zz, xy, yz, zx [Pa], tension "
                  "positive. Plane-strain laws carry zz along.");
    add_parameter(
      "Initial specific volume",
      initial_volume,
      "Initial specific volume v = 1 + e [-], > 1, for the column ln v.");
  }

  std::vector<std::string>
  ElementTest::prepare(const RunOptions &options)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError("Discretisation/Method",
                       "point",
                       "FEM | MPM | explicit MPM on several ranks",
                       "call it without mpirun: there is one point only");
    materials.prepare();
    if (const double tau = materials.traits().friction_memory;
        std::isfinite(tau))
      throw InputError("Materials/" + materials.name(0) + "/Friction memory",
                       tau,
                       "0 | automatic with the method 'point'",
                       "its path has increments and no time to remember");
    materials.refuse_undrained("the method 'point'",
                               "hold the volume of the point by its path "
                               "instead: its stresses are effective ones");
    mixed_control.prepare();
    if (initial_stress.size() != 6)
      throw InputError("Element/Initial stress",
                       dealii::Patterns::Tools::to_string(initial_stress),
                       "six numbers xx, yy, zz, xy, yz, zx",
                       "e.g. -60e3, -100e3, -60e3, 0, 0, 0");
    if (!(initial_volume > 1.))
      throw InputError("Element/Initial specific volume",
                       initial_volume,
                       "> 1",
                       "1 + e with the void ratio e");
    Tensor6 stress;
    std::copy(initial_stress.begin(), initial_stress.end(), stress.begin());
    if (components == StressComponents::axisymmetric)
      materials.set_axisymmetric();
    point = make_element_point(materials.law(0), components, stress, changed);
    element_output.add_columns(*point, initial_volume);
    path.prepare(*point, element_output.columns());
    if (options.dry_run)
      log.print(headline(options.name));
    if (changed.empty())
      return {};
    return {changed};
  }

  std::vector<unsigned int>
  ElementTest::programme() const
  {
    std::vector<unsigned int> n;
    for (const auto &stage : path.list)
      n.push_back(stage->positions().size());
    return n;
  }

  void
  ElementTest::prepare_output(const RunOptions &options)
  {
    element_output.prepare(options);
  }

  std::string
  ElementTest::headline(const std::string &name) const
  {
    std::size_t n = 0;
    for (const auto &stage : path.list)
      n += stage->positions().size();
    return format("%s: one point of '%s', %s, %zu stages, %zu increments",
                  name.c_str(),
                  materials.name(0).c_str(),
                  components_of_point(),
                  path.list.size(),
                  n);
  }

  const char *
  ElementTest::components_of_point() const
  {
    return point->has(4)   ? "3D"
           : point->has(2) ? "axisymmetric"
                           : "plane strain";
  }

  void
  ElementTest::add_line(const unsigned int stage)
  {
    element_output.add_line({n_increments,
                             stage,
                             strain,
                             point->stress(),
                             strain_path,
                             point->values(),
                             point->counts.substeps - before.substeps,
                             point->counts.forced - before.forced});
    largest_p = std::max(largest_p, element_output.value_of("p (Pa)"));
  }

  bool
  ElementTest::stops(const ElementStage &stage) const
  {
    return std::any_of(
      stage.stop.begin(), stage.stop.end(), [&](const StopCondition &s) {
        const double value = element_output.last_line()[s.column];
        return s.at_most ? value <= s.bound : value >= s.bound;
      });
  }

  void
  ElementTest::record_start()
  {
    add_line(0);
  }

  void
  ElementTest::begin(const Place &place)
  {
    control      = path.list[place.stage]->control(*point);
    start_stress = point->stress();
    guess        = {};
    at           = 0.;
  }

  Simulation::Ended
  ElementTest::advance(Place &place)
  {
    const ElementStage &stage = *path.list[place.stage];
    if (place.in_stage == 0 || positions.empty()) // of this stage, or resumed
      positions = stage.positions();
    follow(stage, positions[place.in_stage]);
    add_line(place.stage + 1);
    return stops(stage) ? Ended::stage : Ended::well;
  }

  void
  ElementTest::follow(const ElementStage &stage, const double to)
  {
    before             = point->counts;
    const double whole = to - at;
    const double smallest =
      std::abs(whole) * std::pow(0.5, mixed_control.max_halvings);
    double size = whole;
    while (at != to)
      {
        const bool   last = std::abs(to - at) <= std::abs(size) * (1. + 1e-6);
        const double f    = last ? to : at + size;
        Tensor6      target{}, increment{};
        for (unsigned int i = 0; i < 6; ++i)
          {
            target[i] =
              start_stress[i] + f * (control.stress[i] - start_stress[i]);
            increment[i] =
              (f - at) * (control.by_stress[i] ? guess[i] : control.strain[i]);
          }
        const ControlReport report =
          mixed_control.solve(*point, control.by_stress, target, increment);
        n_iterations += report.iterations;
        if (!report.converged)
          {
            ++n_cuts;
            size = (f - at) / 2.;
            // The guess may be the cause.
            guess = {};
            if (std::abs(size) < smallest * (1. - 1e-6))
              throw StepFailure(
                format("the stage '%s' cannot be followed beyond f = %.6g of "
                       "its path, also with increments cut to %.3g of it "
                       "('Element/Maximum halvings' = %u):\n  ",
                       stage.name.c_str(),
                       at,
                       std::abs(2. * size),
                       mixed_control.max_halvings) +
                report.reason +
                "\n  remedy:  check whether the material can carry these "
                "stresses; control the strain of a component where it yields, "
                "or end the stage with 'Stop when'");
            continue;
          }
        point->accept();
        worst_residual = std::max(worst_residual, report.residual);
        for (unsigned int i = 0; i < 6; ++i)
          {
            guess[i] = increment[i] / (f - at);
            strain[i] += increment[i];
            least_strain[i] = std::min(least_strain[i], strain[i]);
            most_strain[i]  = std::max(most_strain[i], strain[i]);
          }
        strain_path += norm(increment);
        at = f;
      }
    ++n_increments;
  }

  unsigned int
  ElementTest::main_component() const
  {
    unsigned int main = 1;
    for (unsigned int i = 0; i < 6; ++i)
      // gamma = 2 eps_xy is compared with the normal strains.
      if ((i < 3 ? 1. : 2.) * (most_strain[i] - least_strain[i]) >
          (main < 3 ? 1. : 2.) * (most_strain[main] - least_strain[main]) *
            (1. + 1e-9))
        main = i;
    return main;
  }

  void
  ElementTest::write_surfaces()
  {
    // The initial state is computed again, now that the axis is known.
    const unsigned int axis = main_component();
    Tensor6            stress;
    std::copy(initial_stress.begin(), initial_stress.end(), stress.begin());
    std::string ignored;
    const auto  start =
      make_element_point(materials.law(0), components, stress, ignored);
    element_output.add_yield_curves(
      0, start->yield_curves({start->stress(), axis, 1.1 * largest_p}));
    element_output.add_yield_curves(
      1, point->yield_curves({point->stress(), axis, 1.1 * largest_p}));
  }

  void
  ElementTest::record(const Place &)
  {
    if (element_output.verbosity >= 2)
      log.print(format("  f = %.4g, p = %.6g Pa, q = %.6g Pa",
                       at,
                       element_output.value_of("p (Pa)"),
                       element_output.value_of("q (Pa)")));
  }

  std::string
  ElementTest::progress(const Place &place) const
  {
    // Increments take microseconds.
    return place.step % 100000 == 0 ? path.list[place.stage]->name : "";
  }

  void
  ElementTest::end(const Place &place)
  {
    const ElementStage &stage = *path.list[place.stage];
    element_output.end_stage(stage.name);
    if (element_output.verbosity >= 1)
      log.print(format("%s%s: p = %.6g Pa, q = %.6g Pa, eps_v = %.4g %%",
                       stage.name.c_str(),
                       at == positions.back() ? "" : " (stopped)",
                       element_output.value_of("p (Pa)"),
                       element_output.value_of("q (Pa)"),
                       100. * (strain[0] + strain[1] + strain[2])));
  }

  Json
  ElementTest::topics()
  {
    Json json = {{"size", {{"method", "point"}, {"points", 1}}},
                 {"material", materials.name(0)},
                 {"changed_at_start", changed},
                 {"components", components_of_point()},
                 {"axis", component_names[main_component()]},
                 {"counts",
                  {{"increments", n_increments},
                   {"halved_increments", n_cuts},
                   {"newton_iterations", n_iterations},
                   {"worst_residual", worst_residual},
                   {"substeps", point->counts.substeps},
                   {"most_substeps", point->counts.most},
                   {"forced_substeps", point->counts.forced},
                   {"limited_stresses", point->counts.limited}}},
                 {"cost", {{"total_s", total.wall_time()}}}};
    element_output.add_states(json);
    return json;
  }

  void
  ElementTest::finish(const double)
  {
    write_surfaces();
    if (point->counts.forced > 0)
      log.warn(format("%llu substeps were forced: their error is above the "
                      "tolerance; lower 'Smallest substep' or take more "
                      "increments",
                      point->counts.forced));
    if (point->counts.limited > 0)
      log.warn(format("%llu stresses were kept at 'Lowest pressure'",
                      point->counts.limited));
    log.print(format("%u increments, %u halved, %llu substeps, %llu forced, "
                     "%llu limited",
                     n_increments,
                     n_cuts,
                     point->counts.substeps,
                     point->counts.forced,
                     point->counts.limited));
  }

  void
  ElementTest::state(StateRow &row)
  {
    point->state(row);
    row(strain, least_strain, most_strain, control, start_stress, at, guess);
    row(strain_path, largest_p);
    row(n_increments, n_iterations, n_cuts, worst_residual);
  }
} // namespace geocone::GEOCONE_DIM
