// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/limit_output.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  void
  BoundLevel::state(StateRow &row)
  {
    row(cells, unknowns_upper, unknowns_lower, lower, upper, gap);
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

  LimitOutput::LimitOutput(const MPI_Comm comm, Log &log)
    : OutputBase(comm, log)
  {}

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
    statistics.open(path + "/bounds.csv",
                    {"level (-)",
                     "triangles (-)",
                     "lower bound (" + unit + ")",
                     "upper bound (" + unit + ")",
                     "gap (-)",
                     "certified (-)",
                     "unknowns of the lower bound (-)",
                     "unknowns of the upper bound (-)",
                     "factorisations of the lower bound (-)",
                     "factorisations of the upper bound (-)",
                     "CPU time (s)",
                     "CPU time of the mesh (s)"},
                    resumes);
  }

  void
  LimitOutput::add_level(const unsigned int number, const BoundLevel &level)
  {
    // A bound that is not certified is none.
    const double none = std::numeric_limits<double>::quiet_NaN();
    statistics.add_line({static_cast<double>(number),
                         static_cast<double>(level.cells),
                         level.lower_certified ? level.lower : none,
                         level.upper_certified ? level.upper : none,
                         level.certified() ? level.gap : none,
                         static_cast<double>(level.certified()),
                         static_cast<double>(level.unknowns_lower),
                         static_cast<double>(level.unknowns_upper),
                         static_cast<double>(level.iterations_lower),
                         static_cast<double>(level.iterations_upper),
                         level.cpu_seconds,
                         level.mesh_seconds});
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
    const unsigned int n_cells = triangles.cells.size();
    FieldTable         table;
    table.cell      = FieldTable::Cell::triangle;
    table.n_nodes   = 3 * n_cells;
    const auto each = [&](const auto &value) {
      return [&triangles, value](std::vector<double> &to) {
        for (std::size_t p = 0; p < to.size(); ++p)
          to[p] = value(p, triangles.cells[p / 3][p % 3]);
      };
    };
    const auto vectors = [&](const auto &value) {
      return [&triangles, value](std::vector<double> &to) {
        for (std::size_t i = 0; i < to.size(); ++i)
          to[i] =
            value(i / dim, triangles.cells[i / dim / 3][i / dim % 3], i % dim);
      };
    };
    using Index     = unsigned int;
    table.positions = vectors([&](const Index, const Index v, const Index d) {
      return triangles.vertices[v][d];
    });
    table.columns.push_back(
      {"velocity", dim, vectors([&](const Index, const Index v, const Index d) {
         return upper.q.size() > 0 ? upper.q[dim * v + d] : 0.;
       })});
    // Of the lower bound's dual: the translation of each triangle.
    table.columns.push_back(
      {"velocity_lower", dim, [&](std::vector<double> &to) {
         for (std::size_t i = 0; i < to.size(); ++i)
           to[i] =
             lower.q.size() > 0 ? lower.q[dim * (i / (3 * dim)) + i % dim] : 0.;
       }});
    const auto stress = [&](const Index p, const Index i) {
      const Mandel s = from_cone_axes(Mandel(lower.s[p]));
      return units.stress * (i == 2 ? s[2] / sqrt2 : s[i]);
    };
    const char *const names[] = {"stress_xx", "stress_yy", "stress_xy"};
    for (Index i = 0; i < 3; ++i)
      table.columns.push_back(
        {names[i], 1, each([=](const Index p, const Index) {
           return stress(p, i);
         })});
    // The part of a triangle in the gap, over the mean.
    double total = 0.;
    for (const double part : gap)
      total += std::max(part, 0.);
    table.columns.push_back(
      {"part_of_gap", 1, each([&, total](const Index p, const Index) {
         return total > 0. ? gap[p / 3] / total * n_cells : 0.;
       })});
    table.columns.push_back(
      {"material", 1, each([&](const Index p, const Index) {
         return static_cast<double>(triangles.material[p / 3]);
       })});
    fields->write(table, path, number, comm);
  }

  void
  LimitOutput::write_summary(const std::string             &status,
                             const std::vector<BoundLevel> &levels,
                             const LoadBracket             &bracket,
                             const Json                    &others)
  {
    summary = {{"name", name}, {"status", status}};
    for (const auto &[topic, value] : others.items())
      summary[topic] = value;
    if (!levels.empty())
      {
        const BoundLevel &last       = levels.back();
        unsigned int      iterations = 0, most = 0;
        for (const BoundLevel &level : levels)
          {
            iterations += level.iterations_lower + level.iterations_upper;
            most =
              std::max({most, level.iterations_lower, level.iterations_upper});
          }
        const auto order              = order_of_gap(levels);
        Json       bounds             = bracket.bounds();
        bounds["order"]               = order ? Json(*order) : Json();
        bounds["iterations"]          = iterations;
        bounds["iterations_max"]      = most;
        bounds["levels"]              = levels.size();
        bounds["unknowns_lower"]      = last.unknowns_lower;
        bounds["unknowns_upper"]      = last.unknowns_upper;
        bounds["violation_lower"]     = last.violation_lower;
        bounds["violation_upper"]     = last.violation_upper;
        bounds["error_lower"]         = last.error_lower;
        bounds["error_upper"]         = last.error_upper;
        bounds["sum_of_cells_to_gap"] = last.gap_share;
        summary["bounds"]             = bounds;
      }
    write_summary_file();
  }

  void
  LimitOutput::report() const
  {
    if (report_for_tests == Report::none)
      return;
    std::string text;
    if (report_for_tests == Report::results)
      text = format("%.4g %.4g %d\n",
                    summary["bounds"]["lower"].get<double>(),
                    summary["bounds"]["upper"].get<double>(),
                    int(summary["bounds"]["certified"].get<bool>()));
    write_file("output", [&](std::ostream &out) { out << text; });
  }

  void
  LimitOutput::state_of_run(StateRow &row)
  {
    OutputBase::state_of_run(row);
    fields->state(row);
  }
} // namespace geocone::GEOCONE_DIM
