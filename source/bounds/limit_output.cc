// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/unused_parameters.h>
#include <geocone/bounds/limit_output.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_certificates[] = {
      {"Output/Certificates",
       "Analysis/Kind",
       {"limit load", "strength reduction"}}};
  } // namespace

  void
  BoundLevel::state(StateRow &row)
  {
    row(number, cells, unknowns_upper, unknowns_lower, lower, upper, gap);
    row(lower_certified, upper_certified, iterations_lower, iterations_upper);
    row(violation_lower, violation_upper, error_lower, error_upper);
    row(gap_share, cpu_seconds, mesh_seconds, memory);
  }

  LoadBracket
  best_of(const std::vector<BoundLevel> &levels)
  {
    LoadBracket best;
    for (const BoundLevel &level : levels)
      {
        best.take(
          level.lower_certified ? std::optional(level.lower) : std::nullopt,
          level.upper_certified ? std::optional(level.upper) : std::nullopt);
        best.cells = level.cells;
        best.seconds += level.cpu_seconds + level.mesh_seconds;
      }
    return best;
  }

  std::optional<double>
  order_of_gap(const std::vector<BoundLevel> &levels)
  {
    constexpr unsigned int most = 3;
    double                 n = 0., x = 0., y = 0., xx = 0., xy = 0.;
    for (auto level = levels.rbegin(); level != levels.rend() && n < most;
         ++level)
      {
        if (!level->certified() || !(level->gap > 0.))
          continue;
        const double cells = std::log(level->cells), gap = std::log(level->gap);
        ++n;
        x += cells;
        y += gap;
        xx += cells * cells;
        xy += cells * gap;
      }
    const double spread = n * xx - x * x;
    if (n < 2. || !(spread > 1e-6))
      return std::nullopt;
    return -(n * xy - x * y) / spread;
  }

  std::optional<double>
  middle_without_gap(const std::vector<BoundLevel> &levels)
  {
    const auto is_complete = [](const BoundLevel &level) {
      return level.certified();
    };
    const auto last = std::find_if(levels.rbegin(), levels.rend(), is_complete);
    if (last == levels.rend())
      return std::nullopt;
    const auto before = std::find_if(last + 1, levels.rend(), is_complete);
    if (before == levels.rend() || !(before->gap > last->gap))
      return std::nullopt;
    const double middle = (last->lower + last->upper) / 2.,
                 change = middle - (before->lower + before->upper) / 2.,
                 estimate =
                   middle + change * last->gap / (before->gap - last->gap);
    const LoadBracket best = best_of(levels);
    if (!(estimate >= *best.lower && estimate <= *best.upper))
      return std::nullopt;
    return estimate;
  }

  void
  LimitOutput::declare_certificates()
  {
    add_parameter(
      "Certificates",
      with_certificates,
      "Whether certificate_lower.json and certificate_upper.json are "
      "written, with the fields that prove the best bounds so far, for "
      "scripts/check_certificate.");
  }

  void
  LimitOutput::prepare(const RunOptions           &options,
                       const std::string          &unit,
                       const std::optional<double> reference)
  {
    if (reference)
      reference_case.set_default("bounds/middle", *reference);
    begin(options, "bounds");
    // Bounds that are not certified are not written.
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    table.add("level (-)", &BoundLevel::number);
    table.add(dim == 2 ? "triangles (-)" : "tetrahedra (-)",
              &BoundLevel::cells);
    table.add(
      "lower bound (" + unit + ")",
      [](const BoundLevel &l) { return l.lower_certified ? l.lower : none; },
      Finite::may_be);
    table.add(
      "upper bound (" + unit + ")",
      [](const BoundLevel &l) { return l.upper_certified ? l.upper : none; },
      Finite::may_be);
    table.add(
      "gap (-)",
      [](const BoundLevel &l) { return l.certified() ? l.gap : none; },
      Finite::may_be);
    table.add("certified (-)", &BoundLevel::certified);
    table.add("unknowns of the lower bound (-)", &BoundLevel::unknowns_lower);
    table.add("unknowns of the upper bound (-)", &BoundLevel::unknowns_upper);
    table.add("factorisations of the lower bound (-)",
              &BoundLevel::iterations_lower);
    table.add("factorisations of the upper bound (-)",
              &BoundLevel::iterations_upper);
    table.add("CPU time (s)", &BoundLevel::cpu_seconds);
    table.add("CPU time of the mesh (s)", &BoundLevel::mesh_seconds);
    table.add("peak memory (MB)", &BoundLevel::memory);
    open_table("bounds.csv");
  }

  Json
  LimitOutput::bounds(const LoadBracket &bracket) const
  {
    const BoundLevel &last       = records.back();
    unsigned int      iterations = 0, most = 0;
    for (const BoundLevel &level : records)
      {
        iterations += level.iterations_lower + level.iterations_upper;
        most = std::max({most, level.iterations_lower, level.iterations_upper});
      }
    const auto order            = order_of_gap(records);
    const auto middle           = middle_without_gap(records);
    Json       json             = bracket.bounds();
    json["order"]               = order ? Json(*order) : Json();
    json["middle_without_gap"]  = middle ? Json(*middle) : Json();
    json["iterations"]          = iterations;
    json["iterations_max"]      = most;
    json["levels"]              = records.size();
    json["unknowns_lower"]      = last.unknowns_lower;
    json["unknowns_upper"]      = last.unknowns_upper;
    json["violation_lower"]     = last.violation_lower;
    json["violation_upper"]     = last.violation_upper;
    json["error_lower"]         = last.error_lower;
    json["error_upper"]         = last.error_upper;
    json["sum_of_cells_to_gap"] = last.gap_share;
    return json;
  }

  void
  LimitOutput::report_results(std::ostream &out) const
  {
    const Json &bounds = summary["bounds"];
    out << format("%.4g %.4g %d\n",
                  bounds["lower"].get<double>(),
                  bounds["upper"].get<double>(),
                  int(bounds["certified"].get<bool>()));
  }
} // namespace geocone::GEOCONE_DIM
