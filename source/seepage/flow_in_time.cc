// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Time steps of transient seepage.
#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/seepage/flow_on_mesh.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  void
  FlowOnMesh::begin_at_rest(const double table)
  {
    solution = {};
    for (const Point<dim> &x : mesh.vertices)
      solution.head.push_back(table - x[1]);
    solution.s = solution.head;
    solution.inflow.assign(mesh.vertices.size(), 0.);
  }

  void
  FlowOnMesh::advance(const Seepage::Step &step)
  {
    const double   before = stored();
    FlowConditions next =
      boundaries->conditions(step.levels, step.time, step.duration);
    next.storage           = drainable;
    next.saturation_before = saturation();
    for (double &volume : next.storage)
      volume /= step.duration;
    discharge_before.reset();
    solve_on_mesh(next, solution.s);
    rate_of_storage = (stored() - before) / step.duration;
  }

  Seepage::Levels
  FlowOnMesh::levels_within(const Seepage::Step   &step,
                            const Seepage::Levels &from,
                            const double           left) const
  {
    const double    part   = std::min(1. - left / step.duration, 1.);
    Seepage::Levels levels = step.levels;
    for (unsigned int b = 0; b < levels.size(); ++b)
      if (const auto prescribed =
            scene.water.seepage.list[b]->prescribed_level(step.time - left))
        levels[b] = prescribed;
      else if (from[b] && levels[b])
        *levels[b] = (1. - part) * *from[b] + part * *levels[b];
    return levels;
  }

  void
  FlowOnMesh::accept(const UnsaturatedFlow &flow,
                     FlowSolution           next,
                     const double           h)
  {
    const std::vector<double> before = flow.water(solution.head),
                              after  = flow.water(next.head);
    double gain = 0., moved = 0.;
    for (unsigned int v = 0; v < after.size(); ++v)
      {
        gain += after[v] - before[v];
        moved += std::abs(after[v] - before[v]);
      }
    rate_of_storage = gain / h;
    next.iterations += steps_taken > 0 ? solution.iterations : 0;
    solution   = std::move(next);
    double sum = -rate_of_storage;
    for (const double inflow : solution.inflow)
      sum += inflow;
    const double size = std::max(discharge(), moved / h);
    if (flows() || moved > 0.)
      largest_error = std::max(largest_error, std::abs(sum) / size);
  }

  void
  FlowOnMesh::advance_unsaturated(const Seepage::Step &step)
  {
    constexpr double least_part = 1e-9, largest_growth = 2., largest_cut = 0.3,
                     safety = 0.9;
    const UnsaturatedFlow flow(mesh, permeability, measure, curves);
    const double          tolerance = scene.water.seepage.tolerance;
    const Seepage::Levels from      = levels_now;
    const double          least     = least_part * step.duration;
    double                left      = step.duration;
    steps_taken                     = 0;
    largest_error                   = 0.;
    if (step_size == 0.)
      step_size = step.duration / 10.;
    while (left > least)
      {
        stop_if_asked(comm);
        double h = std::min(step_size, left);
        if (left > h && left < 2. * h)
          h = left / 2.;
        auto [next, converged] = flow.step(
          boundaries->conditions(
            levels_within(step, from, left - h), step.time - left + h, h),
          h,
          solution.head,
          solution.s);
        std::vector<double> change = last_change;
        for (double &one : change)
          one *= last_step > 0. ? h / last_step : 0.;
        const double error =
          converged ? flow.change(solution.head, next.head, change) / 2. : 0.;
        const double factor =
          error > 0. ? safety * std::sqrt(tolerance / error) : largest_growth;
        if ((!converged || error > tolerance) && h > least)
          {
            step_size = h * (converged ? std::clamp(factor, largest_cut, 0.9)
                                       : largest_cut);
            continue;
          }
        if (!converged)
          throw RunError(
            format("the flow in unsaturated soil was not found at t = %g s, "
                   "with time steps down to %.2g s\n  remedy:  check the "
                   "retention curves, or change 'Seepage/Cells'",
                   step.time - left,
                   h));
        accept(flow, std::move(next), h);
        last_change = std::move(change);
        last_step   = h;
        left -= h;
        ++steps_taken;
        // The last step of a flow is shortened, but the next one need not be.
        step_size = std::max(step_size, h) == step_size && left <= least
                      ? std::max(step_size * std::min(factor, 1.),
                                 h * std::min(factor, largest_growth))
                      : h * std::clamp(factor, largest_cut, largest_growth);
      }
    levels_now = step.levels;
    discharge_before.reset();
  }

  std::vector<double>
  FlowOnMesh::saturation() const
  {
    std::vector<double> chi = solution.s;
    for (double &value : chi)
      value = 1. + std::min(value, 0.);
    return chi;
  }

  double
  FlowOnMesh::stored() const
  {
    double sum = 0.;
    if (!is_solved()) // the summary of a run that begins
      return sum;
    if (is_unsaturated())
      {
        for (const double volume :
             UnsaturatedFlow(mesh, permeability, measure, curves)
               .water(solution.head))
          sum += volume;
        return sum;
      }
    const std::vector<double> chi = saturation();
    for (unsigned int v = 0; v < chi.size(); ++v)
      sum += drainable[v] * chi[v];
    return sum;
  }
} // namespace geocone::GEOCONE_DIM
