// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/number_in.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/scene/structures.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_structures[] = {
      {"Structures/*", "Discretisation/Method", {"FEM"}}};

    /** Strength of a bar from its text. @throws InputError */
    double
    strength_of_bar(const Structure   &bar,
                    const char        *entry,
                    const std::string &text,
                    const double       if_automatic)
    {
      if (text == "unlimited")
        return std::numeric_limits<double>::infinity();
      if (text == "automatic")
        return if_automatic;
      const std::optional<double> value = number_in(text);
      if (!value || !(*value >= 0.))
        throw InputError(bar.parameter(entry),
                         text,
                         "a force per metre >= 0 N/m, unlimited or automatic",
                         "give the strength of one element divided by their "
                         "spacing");
      return *value;
    }
  } // namespace

  Structure::Structure(const std::string &name)
    : dealii::ParameterAcceptor("/Structures/" + name)
    , name(name)
  {
    type.declare(
      *this,
      "Type",
      ". Anchors and struts are bars between two points, one of which may lie "
      "outside of the body, where it is fixed. A geogrid is a chain of bars "
      "without strength in compression.");
    add_parameter("Points",
                  points,
                  "Ends of the bars [m]: two points of an anchor or strut, two "
                  "or more of a geogrid.");
    add_parameter("Axial stiffness",
                  stiffness,
                  "Axial stiffness EA per metre of thickness [N/m], > 0.");
    add_parameter("Tensile strength",
                  tensile_text,
                  "Greatest tensile force per metre of thickness [N/m], >= 0, "
                  "or unlimited; automatic: unlimited.");
    add_parameter("Compressive strength",
                  compressive_text,
                  "Greatest compressive force per metre of thickness [N/m], "
                  ">= 0, or unlimited; automatic: 0 for geogrids, otherwise "
                  "unlimited.");
    add_parameter("Pre-stress",
                  pre_stress,
                  "Axial force when it is installed, per metre of thickness "
                  "[N/m], tension positive.");
    add_parameter(
      "Acts in",
      stages,
      "Stages in which it acts, comma-separated; it is installed at "
      "the beginning of the first one. Empty: all.");
  }

  void
  Structure::prepare(const std::vector<std::string> &all_stages)
  {
    const double infinite = std::numeric_limits<double>::infinity();
    const bool   grid     = type == Type::geogrid;
    tensile =
      strength_of_bar(*this, "Tensile strength", tensile_text, infinite);
    compressive = strength_of_bar(
      *this, "Compressive strength", compressive_text, grid ? 0. : infinite);
    if (points.size() < 2 || (!grid && points.size() > 2))
      throw InputError(parameter("Points"),
                       std::to_string(points.size()) + " points",
                       grid ? "two or more points" : "two points",
                       "give the ends of its bars");
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!(points[i].distance(points[i - 1]) > 0.))
        throw InputError(parameter("Points"),
                         "two equal points",
                         "neighbours that differ",
                         "leave one of them out");
    if (!(stiffness > 0. && std::isfinite(stiffness)))
      throw InputError(
        parameter("Axial stiffness"),
        stiffness,
        "EA > 0 N/m",
        "give E times the cross-section, divided by the spacing");
    if (!(pre_stress >= -compressive && pre_stress <= tensile))
      throw InputError(parameter("Pre-stress"),
                       pre_stress,
                       "a force within the strengths",
                       "lower it, or raise the strength");
    for (const std::string &stage : stages)
      if (std::count(all_stages.begin(), all_stages.end(), stage) == 0)
        throw InputError(parameter("Acts in"),
                         stage,
                         "names in 'Loading/Stages'",
                         "check the spelling");
  }

  std::vector<std::string>
  Structure::names_of_bars() const
  {
    if (points.size() == 2)
      return {name};
    std::vector<std::string> names;
    for (std::size_t i = 1; i < points.size(); ++i)
      names.push_back(name + " " + std::to_string(i));
    return names;
  }

  Structures::Structures(const ParameterFile &file)
    : NamedList(file,
                "Structures",
                "Names of anchors, struts and geogrids, comma-separated; each "
                "has a subsection of its name.")
  {
    make();
  }

  void
  Structures::prepare(const Geometry                 &geometry,
                      const std::vector<std::string> &stages)
  {
    if (dim == 3)
      refuse("'Geometry/Dimension' = 3", "take a section in plane strain");
    if (!list.empty())
      geometry.refuse_axis("'Structures/Names'", "leave it out");
    std::vector<std::string> keys;
    for (const auto &structure : list)
      {
        structure->prepare(stages);
        for (const std::string &bar : structure->names_of_bars())
          {
            if (std::count(keys.begin(), keys.end(), key_of(bar)) > 0)
              throw InputError(parameter(),
                               structure->name,
                               "names that differ in results, where bars of a "
                               "geogrid are numbered and blanks are "
                               "underscores",
                               "rename it");
            keys.push_back(key_of(bar));
          }
      }
  }

  std::vector<std::string>
  Structures::names_of_bars() const
  {
    std::vector<std::string> all;
    for (const auto &structure : list)
      for (const std::string &name : structure->names_of_bars())
        all.push_back(name);
    return all;
  }

  std::string
  Structures::key_of(std::string name)
  {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }
} // namespace geocone::GEOCONE_DIM
