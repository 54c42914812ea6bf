// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/explicit/explicit_parameters.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_explicit_mpm[] = {
      {"Explicit/*", "Discretisation/Method", {"explicit MPM"}}};
  } // namespace

  ExplicitParameters::ExplicitParameters()
    : ParameterAcceptor("/Explicit")
  {
    order.declare(
      *this,
      "Order",
      ". MUSL: velocities of points are updated first, and stresses follow "
      "from the velocities mapped back to the grid; tolerates small nodal "
      "masses. USL: stresses are updated last, in a single pass over the "
      "points; fastest, for B-splines. USF: stresses are updated first.");
    add_parameter(
      "Courant number",
      courant,
      "Courant number C [-] of the time step C h/(c + v), with the cell size "
      "h, the fastest elastic wave speed c and the largest speed v of a point; "
      "0 < C <= 1. For Element = Q1 use 0.1 to 0.3.");
    add_parameter("Time step",
                  fixed_step,
                  "Constant time step [s]; 0: from the Courant number, updated "
                  "in each step.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Allow unstable step",
                  allow_unstable,
                  "Whether a given time step may exceed h/(c + v).");
    add_parameter("Largest strain increment",
                  largest_strain,
                  "Limits the time step so that no displacement gradient "
                  "changes by more than about this value [-], estimated from "
                  "its rate in the previous step; 0: no limit.",
                  prm,
                  Patterns::Double(0.));
    add_parameter(
      "Fast path",
      fast_path,
      "Whether the faster algorithm for uniform grids is used. false: the "
      "algorithm for general meshes, for comparison; results are the same, "
      "except for Q1 and for points exactly on cell edges.");
    add_parameter("Sort every",
                  sort_every,
                  "Number of steps after which points are sorted by cell and "
                  "redistributed among the ranks (20 to 100 is fastest).",
                  prm,
                  Patterns::Integer(1));
  }

  void
  ExplicitParameters::check() const
  {
    if (!(courant > 0. && courant <= 1.))
      throw InputError(
        "Explicit/Courant number", courant, "0 < C <= 1", "0.3 is usual");
  }

  void
  ExplicitParameters::check_steps(const LoadingProgramme &loading,
                                  const double            stability_limit) const
  {
    const bool is_fixed = fixed_step > 0.;
    if (fixed_step > stability_limit && !allow_unstable)
      throw InputError("Explicit/Time step",
                       fixed_step,
                       "at most " + format("%.3g", stability_limit) +
                         " s, which an elastic wave takes through a cell",
                       "take a smaller step, or 0 for the largest stable one; "
                       "'Explicit/Allow unstable step' = true forces it");
    constexpr double most = 1e9;
    const double     step = is_fixed ? fixed_step : courant * stability_limit;
    for (const auto &stage : loading.list)
      if (!(stage->duration <= most * step))
        throw InputError(
          is_fixed ? "Explicit/Time step" : "Explicit/Courant number",
          is_fixed ? fixed_step : courant,
          format("steps of at least %.3g s, of which the stage '%s' has at "
                 "most %g",
                 stage->duration / most,
                 stage->name.c_str(),
                 most),
          is_fixed
            ? std::string("take a larger step, or 0 for the largest stable one")
            : format(
                "its steps are %.3g s: take a larger number, larger cells, a "
                "softer body or a shorter 'Loading/%s/Duration'",
                step,
                stage->name.c_str()));
  }

  double
  ExplicitParameters::step_size(const double    t,
                                const double    stability_limit,
                                const PassSums &last,
                                const double    last_step) const
  {
    double dt = courant * stability_limit;
    if (largest_strain > 0. && last.strain > 0.)
      dt = std::min(dt, last_step * largest_strain / last.strain);
    if (last.speed2 > 1e6 * last.wave_speed2 || !(t + dt > t))
      throw StepFailure(
        format("points move at %.3g m/s, more than a thousand times as fast as "
               "elastic waves, at t = %g s: the run is unstable",
               std::sqrt(last.speed2),
               t) +
        "\n  remedy:  take a smaller 'Explicit/Courant number', splines, or "
        "the order MUSL");
    if (fixed_step == 0.)
      return dt;
    if (fixed_step > stability_limit && !allow_unstable)
      throw StepFailure(
        format("the step of %.6g s is longer than the %.6g s in which an "
               "elastic wave now crosses a cell, at t = %g s",
               fixed_step,
               stability_limit,
               t) +
        "\n  remedy:  take a smaller 'Explicit/Time step', or 0 for the "
        "largest stable one");
    return fixed_step;
  }
} // namespace geocone::GEOCONE_DIM
