// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/element/driven_point.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  DrivenPoint::DrivenPoint(const ParameterFile &file)
    : dealii::ParameterAcceptor("/Element")
    , materials(file)
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
                  "positive. For plane-strain laws zz is a history variable.");
    add_parameter(
      "Initial specific volume",
      initial_volume,
      "Initial specific volume v = 1 + e [-], > 1, for the column ln v.");
  }

  std::string
  DrivenPoint::prepare()
  {
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
    if (const std::string entry = materials.law(0).formula_of_place();
        !entry.empty())
      throw InputError("Materials/" + materials.name(0) + "/" + entry,
                       "a formula",
                       "empty with the method 'point'",
                       "a single point has no position: give its value");
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
    if (components == StressComponents::axisymmetric)
      materials.set_axisymmetric();
    std::string changed;
    point = initial_point(changed);
    return changed;
  }

  std::unique_ptr<ElementPoint>
  DrivenPoint::initial_point(std::string &changed) const
  {
    Tensor6 stress;
    std::copy(initial_stress.begin(), initial_stress.end(), stress.begin());
    return make_element_point(materials.law(0), components, stress, changed);
  }

  void
  DrivenPoint::restart()
  {
    std::string ignored;
    point = initial_point(ignored);
    path  = {};
  }

  void
  DrivenPoint::begin(const ElementControl &control, const bool goes_on)
  {
    path.control      = control;
    path.start_stress = point->stress();
    path.at           = 0.;
    if (!goes_on)
      path.guess = {};
  }

  void
  DrivenPoint::follow(const double to, const std::string &stage)
  {
    const ElementControl &control = path.control;
    path.before                   = point->counts;
    const double whole            = to - path.at;
    const double smallest =
      std::abs(whole) * std::pow(0.5, mixed_control.max_halvings);
    double size = whole;
    while (path.at != to)
      {
        const bool last =
          std::abs(to - path.at) <= std::abs(size) * (1. + 1e-6);
        const double f = last ? to : path.at + size;
        Tensor6      target{}, increment{};
        for (unsigned int i = 0; i < 6; ++i)
          {
            target[i] = path.start_stress[i] +
                        f * (control.stress[i] - path.start_stress[i]);
            increment[i] =
              (f - path.at) *
              (control.by_stress[i] ? path.guess[i] : control.strain[i]);
          }
        const ControlReport report =
          mixed_control.solve(*point, control.by_stress, target, increment);
        path.n_iterations += report.iterations;
        if (!report.converged)
          {
            ++path.n_cuts;
            size = (f - path.at) / 2.;
            // The guess may be the cause.
            path.guess = {};
            if (std::abs(size) < smallest * (1. - 1e-6))
              throw StepFailure(
                format("the stage '%s' cannot be followed beyond f = %.6g of "
                       "its path, also with increments cut to %.3g of it "
                       "('Element/Maximum halvings' = %u):\n  ",
                       stage.c_str(),
                       path.at,
                       std::abs(2. * size),
                       mixed_control.max_halvings) +
                report.reason +
                "\n  remedy:  check whether the material can carry these "
                "stresses; control the strain of a component where it yields, "
                "or end the stage with 'Stop when'");
            continue;
          }
        point->accept();
        path.worst_residual = std::max(path.worst_residual, report.residual);
        for (unsigned int i = 0; i < 6; ++i)
          {
            path.guess[i] = increment[i] / (f - path.at);
            path.strain[i] += increment[i];
            path.least_strain[i] =
              std::min(path.least_strain[i], path.strain[i]);
            path.most_strain[i] = std::max(path.most_strain[i], path.strain[i]);
          }
        path.strain_path += norm(increment);
        path.at = f;
      }
    ++path.n_increments;
  }

  ElementRecord
  DrivenPoint::record(const unsigned int stage) const
  {
    return {path.n_increments,
            stage,
            path.strain,
            point->stress(),
            path.strain_path,
            point->values(),
            point->counts.substeps - path.before.substeps,
            point->counts.forced - path.before.forced};
  }

  unsigned int
  DrivenPoint::main_component() const
  {
    unsigned int main  = 1;
    const auto   range = [&](const unsigned int i) {
      return path.most_strain[i] - path.least_strain[i];
    };
    for (unsigned int i = 0; i < 6; ++i)
      // gamma = 2 eps_xy is compared with the normal strains.
      if ((i < 3 ? 1. : 2.) * range(i) >
          (main < 3 ? 1. : 2.) * range(main) * (1. + 1e-9))
        main = i;
    return main;
  }

  void
  DrivenPoint::state(StateRow &row)
  {
    point->state(row);
    row(path.strain, path.least_strain, path.most_strain, path.control);
    row(path.start_stress, path.at, path.guess, path.strain_path);
    row(path.n_increments, path.n_iterations, path.n_cuts, path.worst_residual);
  }
} // namespace geocone::GEOCONE_DIM
