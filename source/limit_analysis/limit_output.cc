// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/limit_output.h>
#include <geocone/output/triangle_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  void
  BoundLevel::state(StateRow &row)
  {
    row(number, cells, unknowns_upper, unknowns_lower, lower, upper, gap);
    row(lower_certified, upper_certified, iterations_lower, iterations_upper);
    row(violation_lower, violation_upper, error_lower, error_upper);
    row(gap_share, cpu_seconds, mesh_seconds);
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

  void
  LimitOutput::prepare(const RunOptions           &options,
                       const std::string          &unit,
                       const std::optional<double> reference)
  {
    if (reference)
      reference_case.set_default("bounds/middle", *reference);
    make_folder(options);
    fields =
      std::make_unique<FieldFiles>("bounds", FieldsFormat(fields_format));
    const auto add = [&](const std::string &column, const auto member) {
      table.add(column, [member](const BoundLevel &l) { return l.*member; });
    };
    // Bounds that are not certified are not written.
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    add("level (-)", &BoundLevel::number);
    add("triangles (-)", &BoundLevel::cells);
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
    table.add("certified (-)",
              [](const BoundLevel &l) { return l.certified(); });
    add("unknowns of the lower bound (-)", &BoundLevel::unknowns_lower);
    add("unknowns of the upper bound (-)", &BoundLevel::unknowns_upper);
    add("factorisations of the lower bound (-)", &BoundLevel::iterations_lower);
    add("factorisations of the upper bound (-)", &BoundLevel::iterations_upper);
    add("CPU time (s)", &BoundLevel::cpu_seconds);
    add("CPU time of the mesh (s)", &BoundLevel::mesh_seconds);
    open_table("bounds.csv");
  }

  void
  LimitOutput::write_fields(const double               number,
                            const Triangles           &triangles,
                            const BoundUnits          &units,
                            const Bound               &upper,
                            const Bound               &lower,
                            const std::vector<double> &gap)
  {
    if (!with_fields)
      return;
    TriangleTable table(triangles);
    using Index = unsigned int;
    table.add("velocity", dim, [&](const Index, const Index v, const Index d) {
      return upper.q.size() > 0 ? upper.q[dim * v + d] : 0.;
    });
    // Translation of each triangle, from the dual of the lower bound.
    table.add(
      "velocity_lower", dim, [&](const Index p, const Index, const Index d) {
        return lower.q.size() > 0 ? lower.q[dim * (p / 3) + d] : 0.;
      });
    const char *const names[] = {"stress_xx", "stress_yy", "stress_xy"};
    for (Index i = 0; i < 3; ++i)
      table.add(names[i], 1, [&, i](const Index p, const Index, const Index) {
        const Mandel s = from_cone_axes(Mandel(lower.s[p]));
        return units.stress * (i == 2 ? s[2] / sqrt2 : s[i]);
      });
    // Contribution of a triangle to the gap, over the mean.
    double total = 0.;
    for (const double part : gap)
      total += std::max(part, 0.);
    table.add(
      "part_of_gap", 1, [&, total](const Index p, const Index, const Index) {
        return total > 0. ? gap[p / 3] / total * triangles.cells.size() : 0.;
      });
    table.add("material", 1, [&](const Index p, const Index, const Index) {
      return static_cast<double>(triangles.material[p / 3]);
    });
    fields->write(table, path, number, comm);
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
    Json       json             = bracket.bounds();
    json["order"]               = order ? Json(*order) : Json();
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

  void
  LimitOutput::state_of_run(StateRow &row)
  {
    TableOutput::state_of_run(row);
    row(*fields);
  }
} // namespace geocone::GEOCONE_DIM
