// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/units.h>
#include <geocone/materials/retention.h>
#include <geocone/scene/water.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  Water::Water(const ParameterFile &parameters)
    : dealii::ParameterAcceptor("/Water")
    , seepage(parameters)
    , folder(parameters.folder())
  {
    add_parameter(
      "Table",
      table,
      "Piezometric line x, y; x, y; ... [m] from left to right, extended "
      "horizontally; one point: horizontal everywhere. Pore pressures are "
      "hydrostatic below it, and stresses are effective; above the ground and "
      "in holes it is the level of open water. Densities are those of "
      "saturated soil. In "
      "three dimensions it is constant along z. Empty: no water.");
    add_parameter(
      "File",
      file,
      ".csv file of pore pressures instead of a table, e.g. of a seepage "
      "analysis, with the columns x, y (m) and u (Pa), a row for each point of "
      "a rectangular grid around the body. At the ground surface it is the "
      "pressure of the open water.");
    add_parameter(
      "Pore pressure ratio",
      pressure_ratio,
      "Pore pressure ratio r_u [-] instead of a table (Bishop and Morgenstern "
      "1960), >= 0 and < 1: the pore pressure is r_u times the total vertical "
      "stress at the start, the weight of the soil column up to the ground "
      "surface. 0: none.");
    add_parameter("Unit weight", unit_weight, "Unit weight of water [N/m^3].");
  }

  void
  Water::prepare_pressures(const Geometry &geometry)
  {
    if (!file.empty() && !table.empty())
      throw InputError("Water/File",
                       file,
                       "empty beside 'Water/Table'",
                       "give the pressures, or the line");
    seepage.prepare(geometry);
    check_ratio();
    if (seepage.acts() && !(file.empty() && table.empty()))
      throw InputError(file.empty() ? "Water/Table" : "Water/File",
                       file.empty() ? dealii::Patterns::Tools::to_string(table)
                                    : file,
                       "empty beside 'Seepage/Names'",
                       "the flow gives the pressures: take one of them out");
    if (!file.empty())
      {
        grid.emplace(
          (std::filesystem::path(folder) / file).string(), file, "Water/File");
        if (!geometry.outline.empty())
          if (const auto [lower, upper] = geometry.bounding_box();
              !grid->covers(lower, upper))
            throw InputError(
              "Water/File",
              file,
              "pressures all around the body, from (" + text_of_place(lower) +
                ") to (" + text_of_place(upper) + ")",
              "they are given from " + grid->extent() + ": add rows");
      }
    if (!acts())
      return;
    check(table, "Water/Table");
    if (!(unit_weight > 0. && std::isfinite(unit_weight)))
      throw InputError("Water/Unit weight",
                       unit_weight,
                       "> 0 N/m^3, finite",
                       format("%g is usual", 9810. / mass_unit()));
  }

  void
  Water::check_ratio() const
  {
    if (!(pressure_ratio >= 0. && pressure_ratio < 1.))
      throw InputError("Water/Pore pressure ratio",
                       pressure_ratio,
                       ">= 0, < 1",
                       "0.5 is the ratio of water up to the ground, of half of "
                       "the unit weight of the soil");
    for (const auto &[is_given, name] :
         {std::pair<bool, const char *>(!file.empty(), "Water/File"),
          {!table.empty(), "Water/Table"},
          {seepage.acts(), "Seepage/Names"}})
      if (scales_with_weight() && is_given)
        throw InputError("Water/Pore pressure ratio",
                         pressure_ratio,
                         std::string("0 beside '") + name + "'",
                         "both give the pore pressures: take one of them out");
  }

  void
  Water::prepare(const Gravity   &gravity,
                 const Geometry  &geometry,
                 const Regions   &regions,
                 const Materials &materials)
  {
    prepare_pressures(geometry);
    if (!acts())
      return;
    const Tensor<1, dim> g = gravity.at(1e300);
    if (!(g[1] < 0.))
      throw InputError(
        "Gravity/Acceleration",
        dealii::Patterns::Tools::to_string(g),
        "g_y < 0 where there is water",
        std::string(dim == 2 ? "e.g. 0, -9.81" : "e.g. 0, -9.81, 0") +
          "; or leave the water out");
    columns.reset();
    if (!scales_with_weight())
      return;
    std::vector<double> weights;
    for (unsigned int m = 0; m < materials.size(); ++m)
      weights.push_back(-g[1] * materials.law(m).density());
    columns.emplace(geometry,
                    regions,
                    weights,
                    "Water/Pore pressure ratio",
                    pressure_ratio,
                    "give the pressures by 'Water/File'");
  }

  void
  Water::check(const Table &table, const std::string &parameter)
  {
    for (std::size_t i = 0; i < table.size(); ++i)
      if (!std::isfinite(table[i].square()) ||
          (i > 0 && !(table[i][0] > table[i - 1][0])))
        throw InputError(parameter,
                         dealii::Patterns::Tools::to_string(table),
                         "points x, y; x, y; ... with finite and growing x",
                         "give the line from left to right; where it is "
                         "upright, over a small distance");
  }

  void
  Water::prepare_stages(const LoadingProgramme &loading)
  {
    later.clear();
    double          begin  = 0.;
    Seepage::Levels levels = seepage.levels();
    for (const auto &stage : loading.list)
      {
        if (scales_with_weight() && stage->changes_body())
          throw InputError("Water/Pore pressure ratio",
                           pressure_ratio,
                           "0 where a stage changes the body, as '" +
                             stage->name + "' does",
                           "the pressures are those of the soil at the start: "
                           "give them by 'Water/Table', which stages can move");
        const double end  = begin + stage->duration;
        double       from = begin;
        for (const Seepage::Step &flow : seepage.steps(*stage, begin, levels))
          {
            later.push_back({from, flow.time, {}, flow});
            from   = flow.time;
            levels = flow.levels;
          }
        if (!stage->water_table.empty())
          {
            const std::string parameter =
              "Loading/" + stage->name + "/Water table";
            if (table.empty())
              throw InputError(
                parameter,
                dealii::Patterns::Tools::to_string(stage->water_table),
                "empty where there is no 'Water/Table'",
                "give the line of the start there; one below the "
                "body leaves it dry");
            check(stage->water_table, parameter);
            later.push_back({begin, end, stage->water_table, {}});
          }
        begin = end;
      }
  }

  bool
  Water::flows_in_time() const
  {
    return std::any_of(later.begin(), later.end(), [](const Later &one) {
      return one.flow.duration > 0.;
    });
  }

  std::vector<Seepage::Step>
  Water::flow_steps() const
  {
    std::vector<Seepage::Step> all = {{seepage.levels()}};
    for (const Later &of_stage : later)
      all.push_back(of_stage.flow);
    return all;
  }

  std::vector<double>
  Water::interpolation_weights(const double t) const
  {
    // Only the last of those that are complete counts, and what has begun since.
    std::size_t first = later.size();
    while (first > 0 && t < later[first - 1].end)
      --first;
    std::vector<double> all(1 + later.size(), 0.);
    all[first] = 1.;
    for (std::size_t i = first; i < later.size() && t > later[i].begin; ++i)
      {
        const double s =
          std::min((t - later[i].begin) / (later[i].end - later[i].begin), 1.);
        for (std::size_t k = first; k <= i; ++k)
          all[k] *= 1. - s;
        all[i + 1] = s;
      }
    return all;
  }

  std::array<double, 2>
  Water::level(const Table &table, const double x)
  {
    if (x <= table.front()[0])
      return {{table.front()[1], 0.}};
    if (x >= table.back()[0])
      return {{table.back()[1], 0.}};
    const auto next = std::upper_bound(
      table.begin(), table.end(), x, [](const double value, const Point<2> &p) {
        return value < p[0];
      });
    const Point<2> &a = *(next - 1), &b = *next;
    const double    slope = (b[1] - a[1]) / (b[0] - a[0]);
    return {{a[1] + slope * (x - a[0]), slope}};
  }

  bool
  Water::is_level() const
  {
    if (columns)
      return columns->are_level();
    return !varies_in_cells() &&
           std::all_of(table.begin(), table.end(), [&](const Point<2> &p) {
             return p[1] == table.front()[1];
           });
  }

  double
  Water::pressure(const Point<dim> &x) const
  {
    return mean_pressure(x, initial_weights);
  }

  double
  Water::pressure(const Point<dim> &x, const double t) const
  {
    return t == 0. ? pressure(x) : mean_pressure(x, interpolation_weights(t));
  }

  double
  Water::mean_pressure(const Point<dim>          &x,
                       const std::vector<double> &weights) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] != 0.)
        sum += weights[i] * pressure_of(x, i);
    return sum;
  }

  double
  Water::pressure_of(const Point<dim> &x, const std::size_t line) const
  {
    if (grid)
      return grid->value(x);
    if (!all_flows.empty())
      return std::max(all_flows[line].pressure.value(x), 0.);
    if (columns)
      return pressure_ratio * columns->stress(x);
    return table.empty()
             ? 0.
             : unit_weight *
                 std::max(
                   level(line == 0 ? table : later[line - 1].table, x[0])[0] -
                     x[1],
                   0.);
  }

  double
  Water::suction_stress(const Point<dim> &x,
                        const Retention  &soil,
                        const std::size_t line) const
  {
    if (!soil.adds_strength() || !has_suction())
      return 0.;
    return soil.suction_stress(all_flows[line].pressure.value(x), unit_weight);
  }

  double
  Water::initial_suction_stress(const Point<dim> &x,
                                const Retention  &soil) const
  {
    double sum = 0.;
    if (soil.adds_strength() && has_suction())
      for (std::size_t i = 0; i < all_flows.size(); ++i)
        if (initial_weights[i] != 0.)
          sum += initial_weights[i] * suction_stress(x, soil, i);
    return sum;
  }

  Tensor<1, dim>
  Water::force(const Point<dim> &x, const std::size_t line) const
  {
    Tensor<1, dim> f;
    if (grid)
      return -grid->gradient(x);
    if (!all_flows.empty())
      {
        const Flow &flow = all_flows[line];
        return flow.has_suction && !(flow.pressure.value(x) > 0.)
                 ? f
                 : -flow.pressure.gradient(x);
      }
    if (columns)
      return -pressure_ratio * columns->gradient(x);
    if (table.empty())
      return f;
    const auto [y, slope] =
      level(line == 0 ? table : later[line - 1].table, x[0]);
    if (x[1] < y)
      {
        f[0] = -unit_weight * slope;
        f[1] = unit_weight;
      }
    return f;
  }

  std::vector<std::array<Point<dim>, 2>>
  Water::lines(const Point<dim> &lower, const Point<dim> &upper) const
  {
    std::vector<std::array<Point<dim>, 2>> all;
    if (columns)
      return columns->lines();
    if (!table.empty())
      add_lines(table, lower, upper, all);
    for (const Later &of_stage : later)
      if (!of_stage.table.empty())
        add_lines(of_stage.table, lower, upper, all);
    return all;
  }

  void
  Water::add_lines(const Table                            &table,
                   const Point<dim>                       &lower,
                   const Point<dim>                       &upper,
                   std::vector<std::array<Point<dim>, 2>> &all) const
  {
    // Beyond the box on both sides.
    const double            beyond = 0.1 * (upper[0] - lower[0]);
    std::vector<Point<dim>> corners;
    const auto              in_plane = [](const double x, const double y) {
      Point<dim> p;
      p[0] = x;
      p[1] = y;
      return p;
    };
    if (lower[0] - beyond < table.front()[0])
      corners.push_back(in_plane(lower[0] - beyond, table.front()[1]));
    for (const Point<2> &corner : table)
      corners.push_back(in_plane(corner[0], corner[1]));
    if (upper[0] + beyond > table.back()[0])
      corners.push_back(in_plane(upper[0] + beyond, table.back()[1]));
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      all.push_back({{corners[i], corners[i + 1]}});
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      {
        const Point<dim>    &a      = corners[i];
        const Tensor<1, dim> before = a - corners[i - 1],
                             after  = corners[i + 1] - a;
        const double turn = before[0] * after[1] - before[1] * after[0];
        if (std::abs(turn) > 1e-12 * before.norm() * after.norm() &&
            a[1] > lower[1])
          all.push_back({{in_plane(a[0], lower[1] - beyond), a}});
      }
  }

  void
  Water::refuse(const std::string &what, const std::string &remedy) const
  {
    seepage.refuse(what, remedy);
    if (scales_with_weight())
      throw InputError(
        "Water/Pore pressure ratio", pressure_ratio, "0 with " + what, remedy);
    if (acts())
      throw InputError(grid ? "Water/File" : "Water/Table",
                       grid ? file : dealii::Patterns::Tools::to_string(table),
                       "empty with " + what,
                       remedy);
  }
} // namespace geocone::GEOCONE_DIM
