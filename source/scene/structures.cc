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
      {"Structures/*", "Discretisation/Method", {"FEM", "MPM"}},
      {"Structures/*/Pre-stress",
       "Structures/*/Type",
       {"anchor", "strut", "geogrid"}},
      {"Structures/*/Bending stiffness", "Structures/*/Type", {"plate"}},
      {"Structures/*/Moment capacity", "Structures/*/Type", {"plate"}},
      {"Structures/*/Interaction", "Structures/*/Type", {"plate"}},
      {"Structures/*/Spacing", "Structures/*/Type", {"plate"}},
      {"Structures/*/Clamped ends", "Structures/*/Type", {"plate"}},
      {"Structures/*/Interface strength",
       "Analysis/Kind",
       {"limit load", "strength reduction"}}};

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
      "without strength in compression. A plate (wall, lining, raft) bends, "
      "too, and is tied to the body all along its polyline.");
    add_parameter(
      "Points",
      points,
      "Ends of the bars [m]: two points of an anchor or strut, two "
      "or more of a geogrid; or corners of a plate, which is closed "
      "if the last one is the first.");
    add_parameter(
      "Axial stiffness",
      stiffness,
      "Axial stiffness EA per metre of thickness [N/m], > 0 in steps; "
      "bounds need none.");
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
                  "[N/m], tension positive; of bars.");
    add_parameter("Bending stiffness",
                  bending,
                  "Bending stiffness EI of a plate per metre of thickness "
                  "[N m], > 0 in steps; of a wide plate E stands for "
                  "E/(1 - nu^2). Bounds need none.");
    add_parameter("Moment capacity",
                  capacity_text,
                  "Greatest bending moment of a plate per metre of thickness "
                  "[N], > 0, at which it forms plastic hinges, or unlimited.");
    interaction.declare(
      *this,
      "Interaction",
      ": of the axial force N and the moment M of a plate that yields. none: "
      "each has its own strength; parabolic: |M|/Mp + (N/Np)^2 <= 1 with "
      "associated flow, exact for a rectangular section, with the moment "
      "capacity Mp and equal tensile and compressive strengths Np.");
    add_parameter(
      "Spacing",
      spacing_text,
      "Largest distance between the points at which a plate is tied "
      "to the body [m], > 0; automatic: where it crosses the sides "
      "of cells, and between them by the degree of the element. "
      "Unstructured meshes have sides along plates.");
    clamped.declare(
      *this,
      "Clamped ends",
      ": ends of a plate whose rotation is prevented, as on an axis "
      "of symmetry or in a rigid support; otherwise ends carry no "
      "moment.");
    add_parameter(
      "Interface strength",
      interface_strength,
      "Strength of the interfaces between the soil and both sides of a plate "
      "or geogrid, as a part of the soil's c and tan(phi) [-], 0.01 to 1, "
      "where loads or the factor of safety are bounded. Strength reduction "
      "reduces it with the soil's, but not the strengths of structures.");
    stages.declare(*this,
                   "; it is installed at the beginning of the first one.");
  }

  void
  Structure::prepare(const std::vector<std::string> &all_stages,
                     const bool                      is_rigid)
  {
    const double infinite = std::numeric_limits<double>::infinity();
    const bool   grid     = type == Type::geogrid;
    const bool   chain    = is_chain();
    tensile =
      strength_of_bar(*this, "Tensile strength", tensile_text, infinite);
    compressive = strength_of_bar(
      *this, "Compressive strength", compressive_text, grid ? 0. : infinite);
    if (points.size() < 2 || (!chain && points.size() > 2))
      throw InputError(parameter("Points"),
                       std::to_string(points.size()) + " points",
                       chain ? "two or more points" : "two points",
                       is_plate() ? "give its ends and corners"
                                  : "give the ends of its bars");
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!(points[i].distance(points[i - 1]) > 0.))
        throw InputError(parameter("Points"),
                         "two equal points",
                         "neighbours that differ",
                         "leave one of them out");
    if (!is_rigid && !(stiffness > 0. && std::isfinite(stiffness)))
      throw InputError(
        parameter("Axial stiffness"),
        stiffness,
        "EA > 0 N/m",
        "give E times the cross-section, divided by the spacing");
    if (is_plate())
      prepare_plate(is_rigid);
    if (!(pre_stress >= -compressive && pre_stress <= tensile))
      throw InputError(parameter("Pre-stress"),
                       pre_stress,
                       "a force within the strengths",
                       "lower it, or raise the strength");
    if (!(interface_strength >= 0.01 && interface_strength <= 1.))
      throw InputError(parameter("Interface strength"),
                       interface_strength,
                       "0.01 to 1",
                       "give tan(delta)/tan(phi), e.g. 0.67; 1 is rough");
    stages.check(parameter(ActingStages::entry), all_stages);
  }

  void
  Structure::prepare_plate(const bool is_rigid)
  {
    const double infinite = std::numeric_limits<double>::infinity();
    const auto   positive = [&](const char        *entry,
                              const std::string &text,
                              const std::string &otherwise,
                              const std::string &remedy) {
      if (text == otherwise)
        return infinite;
      const std::optional<double> value = number_in(text);
      if (!value || !(*value > 0. && std::isfinite(*value)))
        throw InputError(
          parameter(entry), text, "a number > 0, or " + otherwise, remedy);
      return *value;
    };
    capacity = positive("Moment capacity",
                        capacity_text,
                        "unlimited",
                        "give the plastic moment per metre of thickness");
    spacing  = positive(
      "Spacing", spacing_text, "automatic", "give about the distance of nodes");
    if (!is_rigid && !(bending > 0. && std::isfinite(bending)))
      throw InputError(parameter("Bending stiffness"),
                       bending,
                       "EI > 0 N m",
                       "give E times the second moment of area per metre of "
                       "thickness; a geogrid does not bend");
    if (pre_stress != 0.)
      throw InputError(parameter("Pre-stress"),
                       pre_stress,
                       "0 for plates",
                       "pre-stress an anchor or a strut");
    if (!(tensile > 0. && compressive > 0.))
      throw InputError(
        parameter(tensile > 0. ? "Compressive strength" : "Tensile strength"),
        tensile > 0. ? compressive_text : tensile_text,
        "a strength > 0 N/m of a plate, or unlimited",
        "raise it, or take a geogrid");
    if (interacts() && !(std::isfinite(capacity) && std::isfinite(tensile) &&
                         tensile == compressive))
      throw InputError(parameter("Interaction"),
                       interaction.word(),
                       "none, unless 'Moment capacity', 'Tensile strength' and "
                       "'Compressive strength' are finite and both strengths "
                       "are equal",
                       "give all three of them");
    if (is_closed() && (points.size() < 4 || clamped != Ends::none))
      throw InputError(parameter(points.size() < 4 ? "Points" : "Clamped ends"),
                       points.size() < 4 ? "a plate there and back"
                                         : clamped.word(),
                       points.size() < 4 ? "three corners of a closed plate"
                                         : "none for a closed plate",
                       "leave the last point out, or check the corners");
  }

  std::vector<std::string>
  Structure::names_of_bars() const
  {
    if (is_plate())
      return {};
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
                "Names of anchors, struts, geogrids and plates, "
                "comma-separated; each has a subsection of its name.")
  {
    make();
  }

  void
  Structures::check(const Geometry                 &geometry,
                    const std::vector<std::string> &stages)
  {
    if (dim == 3)
      refuse("'Geometry/Dimension' = 3", "take a section in plane strain");
    if (!list.empty())
      geometry.refuse_axis("'Structures/Names'", "leave it out");
    std::vector<std::string> keys;
    for (const auto &structure : list)
      {
        structure->prepare(stages, is_rigid);
        for (const std::string &bar :
             structure->is_plate() ? std::vector<std::string>{structure->name}
                                   : structure->names_of_bars())
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

  void
  Structures::prepare(const Geometry                 &geometry,
                      const std::vector<std::string> &stages)
  {
    check(geometry, stages);
  }

  void
  Structures::prepare_rigid(const Geometry    &geometry,
                            const std::string &analysis)
  {
    is_rigid = true;
    for (const auto &structure : list)
      if (!structure->stages.are_all())
        throw InputError(structure->parameter(ActingStages::entry),
                         structure->stages.names().front(),
                         "empty with " + analysis,
                         "bounds have no stages: leave it out, or leave the "
                         "structure out of 'Structures/Names'");
    check(geometry, {});
  }

  std::vector<std::array<dealii::Point<dim>, 2>>
  Structures::lines() const
  {
    std::vector<std::array<dealii::Point<dim>, 2>> all;
    for (const auto &structure : list)
      if (structure->is_plate() || (is_rigid && structure->is_chain()))
        for (std::size_t i = 1; i < structure->points.size(); ++i)
          all.push_back({{structure->points[i - 1], structure->points[i]}});
    return all;
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

  std::vector<const Structure *>
  Structures::plates() const
  {
    std::vector<const Structure *> some;
    for (const auto &structure : list)
      if (structure->is_plate())
        some.push_back(structure.get());
    return some;
  }

  std::string
  Structures::key_of(std::string name)
  {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }
} // namespace geocone::GEOCONE_DIM
