// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/number_in.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/scene/seepage.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_seepage[] = {
      {"Seepage/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Seepage/*/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Seepage/Time", "Analysis/Kind", {"limit load", "strength reduction"}}};
  } // namespace

  SeepageBoundary::SeepageBoundary(const std::string &name,
                                   const std::string &folder)
    : BoundaryPart(name, "Seepage")
    , folder(folder)
  {
    add_parameter(
      "Level",
      level_text,
      "Height y of the level of open water at the sides [m]: the pressure is "
      "hydrostatic below it, and water can leave above it (seepage face). A "
      "number, a formula in t or 'record FILE.csv', a time history. none: no "
      "open water; water can leave everywhere.");
    add_parameter(
      "Rain",
      rain_text,
      "Rain on the sides per horizontal area [m/s], a number, a formula in t "
      "or 'record FILE.csv', a time history; the part that cannot infiltrate "
      "runs off. The mean of 64 values acts in a time step of the flow.");
    add_parameter(
      "Drain",
      drain,
      std::string(dim == 2 ? "Line x, y; x, y; ... [m]"
                           : "Line x, y, z; x, y, z; ... [m], along edges of "
                             "the mesh,") +
        " of a drain, filter or slotted pipe in the body, instead of sides. "
        "Without a level it is open to the air: it drains the water that "
        "reaches it. Empty: none.");
  }

  void
  SeepageBoundary::prepare()
  {
    rain_in_time.prepare(rain_text, parameter("Rain"), &folder);
    if (drain.empty())
      BoundaryPart::prepare();
    else
      {
        if (!sides.empty())
          throw InputError(parameter("Sides"),
                           dealii::Patterns::Tools::to_string(sides),
                           "empty where there is a drain",
                           "give a boundary of its own for the sides");
        if (is_restricted())
          throw InputError(parameter("Box"),
                           part(),
                           "no box and no formula where there is a drain",
                           "end the line where the drain ends");
        if (drain.size() < 2 ||
            !std::all_of(drain.begin(), drain.end(), [](const auto &x) {
              return std::isfinite(x.square());
            }))
          throw InputError(parameter("Drain"),
                           dealii::Patterns::Tools::to_string(drain),
                           "at least two points with finite coordinates",
                           "give the ends of the line, x, y; x, y");
        if (has_rain())
          throw InputError(parameter("Rain"),
                           rain_text,
                           "0 for a drain",
                           "rain falls on sides");
      }
    level.reset();
    level_in_time.reset();
    if (level_text != "none")
      {
        level = number_in(level_text);
        if (!level)
          {
            level_in_time.emplace();
            level_in_time->prepare(level_text, parameter("Level"), &folder);
            level = prescribed_level(0.);
          }
        if (!(std::abs(*level) <= largest_coordinate))
          throw InputError(parameter("Level"),
                           level_text,
                           "a height y in m, or none",
                           "none is a side in the air");
      }
    rain(0.);
  }

  std::optional<double>
  SeepageBoundary::prescribed_level(const double t) const
  {
    if (!level_in_time)
      return std::nullopt;
    return level_in_time->value({}, t);
  }

  double
  SeepageBoundary::rain(const double t) const
  {
    const double rate = rain_in_time.value({}, t);
    if (!(rate >= 0. && std::isfinite(rate)))
      throw InputError(
        parameter("Rain"),
        rain_text,
        format(">= 0 m/s, finite; at t = %g s it is %g", t, rate),
        "1e-7 m/s is 8.6 mm per day; 0: no rain");
    return rate;
  }

  bool
  SeepageBoundary::is_on_drain(const dealii::Point<dim> &x) const
  {
    for (std::size_t i = 1; i < drain.size(); ++i)
      if (distance_to_segment(x, drain[i - 1], drain[i]) <=
          1e-7 * drain[i - 1].distance(drain[i]))
        return true;
    return false;
  }

  Seepage::Seepage(const ParameterFile &file)
    : NamedList(
        file,
        "Seepage",
        "Names of the boundaries with open water, air or rain, "
        "comma-separated; each has a subsection of its name. Where they "
        "overlap, later ones override earlier ones; where they meet, the "
        "head is that of the more permeable soil. All other boundaries "
        "are impervious. The pore pressures of the flow between them act in "
        "FEM, MPM and bounds. Empty: water does not flow.")
  {
    add_parameter(
      "Cells",
      n_cells,
      dim == 2 ? "Approximate number of triangles of the finest mesh of the "
                 "flow, which is refined at the free surface and where the "
                 "velocity changes; of transient flows all have one size."
               : "Number of tetrahedra of the finest mesh of the flow. That "
                 "of 'Mesh', whose hexahedra are divided, is bisected at "
                 "the free surface and where the velocity changes until it "
                 "has as many; that of transient flows is not.");
    add_parameter(
      "Degree",
      degree,
      "Polynomial degree of the pressure heads in a cell, 1 to 3: 2 "
      "and 3 are more accurate in steady flow without a free "
      "surface, and refused elsewhere.");
    add_parameter("Initial water table",
                  initial_text,
                  "Beginning of a transient flow of unsaturated soil: steady, "
                  "the steady flow with the levels and the rain at t = 0, or "
                  "the height y [m] of a water table with hydrostatic "
                  "pressures below it and suctions above.");
    add_parameter("Time tolerance",
                  tolerance,
                  "Transient flow of unsaturated soil: largest error of the "
                  "effective saturation in a time step [-], estimated from the "
                  "change of its rate. The 'Flow steps' of a stage are divided "
                  "to meet it.");
    add_parameter("Time",
                  time,
                  "Bounds: time [s] in the stages of 'Loading' whose pore "
                  "pressures act, e.g. after a drawdown.");
    make(file.folder());
  }

  void
  Seepage::prepare(const Geometry &geometry)
  {
    if (!acts())
      return;
    NamedList::prepare();
    for (const auto &boundary : list)
      boundary->replace_groups(geometry.sides_of_hole);
    const std::string names = dealii::Patterns::Tools::to_string(this->names());
    if (geometry.shape == Geometry::Shape::discs)
      throw InputError(parameter(),
                       names,
                       "empty with discs",
                       "set Geometry/Type = box, polygon or file");
    geometry.refuse_where("'Seepage/Names'",
                          "give the body as a polygon, or its pressures by "
                          "'Water/File'");
    if (n_cells < 20 || n_cells > 1000000)
      throw InputError("Seepage/Cells",
                       n_cells,
                       "20 to 1000000",
                       "5000 give the flow to about 0.2 %");
    if (degree < 1 || degree > 3)
      throw InputError(
        "Seepage/Degree", degree, "1 | 2 | 3", "1 is right for all flows");
    if (std::none_of(
          list.begin(),
          list.end(),
          [](const auto &boundary) { return boundary->level.has_value(); }) &&
        std::none_of(list.begin(), list.end(), [](const auto &boundary) {
          return boundary->has_rain();
        }))
      throw InputError(parameter(),
                       names,
                       "at least one boundary with a level or rain",
                       "there is no water: set 'Seepage/" + list[0]->name +
                         "/Level'");
    initial_table.reset();
    if (initial_text != "steady")
      {
        initial_table = number_in(initial_text);
        if (!initial_table || !(std::abs(*initial_table) <= largest_coordinate))
          throw InputError("Seepage/Initial water table",
                           initial_text,
                           "steady, or a height y in m",
                           "steady is the flow with the levels and the rain at "
                           "t = 0");
      }
    if (!(tolerance > 0. && tolerance <= 1.))
      throw InputError(
        "Seepage/Time tolerance", tolerance, "> 0, at most 1", "0.01 is usual");
  }

  Seepage::Levels
  Seepage::levels() const
  {
    Levels all;
    for (const auto &boundary : list)
      all.push_back(boundary->level);
    return all;
  }

  Seepage::Levels
  Seepage::levels_after(const Stage &stage, Levels levels) const
  {
    for (const auto &[name, level] : stage.water_levels)
      {
        const auto found =
          std::find(this->names().begin(), this->names().end(), name);
        if (found == this->names().end())
          throw InputError("Loading/" + stage.name + "/Water levels",
                           name,
                           acts() ? "names of 'Seepage/Names'"
                                  : "empty where no water flows",
                           "give NAME: LEVEL, e.g. " +
                             (acts() ? list[0]->name : "upstream") + ": 5");
        const std::size_t b = found - this->names().begin();
        if (list[b]->prescribed_level(0.))
          throw InputError("Loading/" + stage.name + "/Water levels",
                           name,
                           "no boundary whose level is a function of time",
                           "give 'Seepage/" + name + "/Level' as a number");
        levels[b] = level;
      }
    return levels;
  }

  std::vector<Seepage::Step>
  Seepage::steps(const Stage  &stage,
                 const double  begin,
                 const Levels &before) const
  {
    Levels     after     = levels_after(stage, before);
    const auto prescribe = [&](Levels &levels, const double t) {
      for (unsigned int b = 0; b < levels.size(); ++b)
        if (const auto level = list[b]->prescribed_level(t))
          levels[b] = level;
    };
    prescribe(after, begin + stage.duration);
    constexpr unsigned int most_steps = 10000;
    if (stage.flow_steps > most_steps)
      throw InputError("Loading/" + stage.name + "/Flow steps",
                       stage.flow_steps,
                       "0 to " + std::to_string(most_steps),
                       "20 to 100 are usual");
    if (stage.flow_steps > 0 && !acts())
      throw InputError("Loading/" + stage.name + "/Flow steps",
                       stage.flow_steps,
                       "0 where no water flows",
                       "name the boundaries of the flow in 'Seepage/Names'");
    // Rain is checked at the ends and in the middle of all steps.
    const unsigned int n_parts    = 2 * std::max(stage.flow_steps, 1U);
    bool               is_changed = false;
    for (const auto &boundary : list)
      for (unsigned int k = 0; k <= n_parts; ++k)
        {
          const double t = begin + stage.duration * k / n_parts;
          if (boundary->rain(t) != boundary->rain(begin) ||
              boundary->prescribed_level(t) !=
                boundary->prescribed_level(begin))
            is_changed = true;
        }
    if (stage.flow_steps == 0 && is_changed)
      throw InputError("Loading/" + stage.name + "/Flow steps",
                       0,
                       "> 0 where 'Level' or 'Rain' of 'Seepage' changes in "
                       "the stage",
                       "20 to 100 are usual");
    if (stage.flow_steps == 0)
      return stage.water_levels.empty()
               ? std::vector<Step>()
               : std::vector<Step>{{after, 0., begin + stage.duration}};
    std::vector<Step> all;
    for (unsigned int k = 1; k <= stage.flow_steps; ++k)
      {
        const double part = double(k) / stage.flow_steps;
        Step         step = {after,
                             stage.duration / stage.flow_steps,
                             begin + part * stage.duration};
        for (unsigned int b = 0; b < after.size(); ++b)
          if (before[b] && after[b])
            step.levels[b] = (1. - part) * *before[b] + part * *after[b];
        prescribe(step.levels, step.time);
        all.push_back(step);
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
