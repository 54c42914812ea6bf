// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/unused_parameters.h>

#include <algorithm>
#include <map>

namespace geocone
{
  namespace
  {
    /** Which parameters are used only where another one has certain values. A '*'
     *  stands for any name. */
    struct Rule
    {
      std::string              parameter;
      std::string              chooser;
      std::vector<std::string> values; ///< of the chooser; empty: any but none
      std::string              other = {}; ///< or where one of these is set
    };

    const char *const method = "Discretisation/Method";

    const std::vector<std::string> of_scenes = {"FEM", "MPM", "explicit MPM"};

    const std::vector<Rule> rules = {
      {"Analysis/Load factor of", "Analysis/Kind", {"limit load"}},
      {"Analysis/Gap tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Growth of meshes",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Maximum cells",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Maximum levels",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Solver tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Element/*", method, {"point"}},
      {"Path/*", method, {"point"}},
      {"Path/*/*", method, {"point"}},
      {"Geometry/*", method, of_scenes},
      {"Mesh/*", method, of_scenes},
      {"Discretisation/Element", method, of_scenes},
      {"Discretisation/B-bar", method, of_scenes},
      {"Discretisation/Basis", method, of_scenes},
      {"Gravity/*", method, of_scenes},
      {"Initial stress/*", method, of_scenes},
      {"Initial velocity/*", method, of_scenes},
      {"Boundary conditions/*", method, of_scenes},
      {"Boundary conditions/*/*", method, of_scenes},
      {"Tractions/*", method, of_scenes},
      {"Tractions/*/*", method, of_scenes},
      {"Loading/*", method, of_scenes},
      {"Loading/*/*", method, of_scenes},
      {"Observation/*", method, of_scenes},
      {"Geometry/Box", "Geometry/Shape", {"box"}},
      {"Geometry/Polygon", "Geometry/Shape", {"polygon"}},
      {"Geometry/Centres", "Geometry/Shape", {"discs"}},
      {"Geometry/Radii", "Geometry/Shape", {"discs"}},
      {"Geometry/File", "Geometry/Shape", {"file"}},
      {"Initial stress/Stress xx",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress yy",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress xy",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress zz",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/K0",
       "Initial stress/Type",
       {"geostatic"},
       "Initial stress/Of added materials"},
      {"Materials/*/K0",
       "Initial stress/Type",
       {"geostatic"},
       "Initial stress/Of added materials"},
      {"Initial stress/Surface level", "Initial stress/Type", {"geostatic"}},
      {"Initial stress/Surcharge", "Initial stress/Type", {"geostatic"}},
      {"Materials/*/Reduce strength",
       "Analysis/Kind",
       {"strength reduction"},
       "Loading/*/Strength factor"},
      {"Material point method/Consistent integration",
       "Discretisation/B-bar",
       {"true"}},
      {"Boundary conditions/*/Segments",
       "Boundary conditions/*/Imposed on",
       {"segments"}},
      {"Boundary conditions/*/Segment shortening",
       "Boundary conditions/*/Imposed on",
       {"segments"}},
      {"Loading/*/Until failure", method, {"FEM", "MPM"}},
      {"Loading/*/Strength factor", method, {"FEM", "MPM"}},
      {"Loading/*/Raising velocity", method, {"FEM", "MPM"}},
      {"Loading/*/Damping", method, {"explicit MPM"}},
      {"Loading/*/Kinetic damping", method, {"explicit MPM"}},
      {"Loading/*/Largest unbalanced force", method, {"explicit MPM"}},
      {"Observation/Component", method, {"FEM", "MPM"}},
      {"Observation/Factor", method, {"FEM", "MPM"}},
      {"Observation/Plateau tolerance", method, {"FEM", "MPM"}},
      {"Observation/Component", "Observation/Conditions", {}},
      {"Observation/Factor",
       "Observation/Conditions",
       {},
       "Loading/*/Raised loads"},
      {"Observation/Plateau tolerance",
       "Observation/Conditions",
       {},
       "Loading/*/Raised loads"},
      {"Observation/Reference", method, {"FEM", "MPM"}},
      {"Observation/Reference material", "Observation/Reference", {"Prandtl"}},
      {"Observation/Reference width", "Observation/Reference", {"Prandtl"}},
      {"Observation/Reference surcharge", "Observation/Reference", {"Prandtl"}},
      {"Mesh/Type", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Box", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Box", method, {"MPM", "explicit MPM"}},
      {"Mesh/Cells", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Diagonals", "Mesh/Type", {"uniform", "graded"}},
      {"Mesh/Diagonals", method, {"FEM"}},
      {"Mesh/Cell size", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Cell size",
       "Mesh/Type",
       {"uniform", "unstructured", "from the bounds"}},
      {"Mesh/Grading points",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Smallest size",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Largest size",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Growth factor", "Mesh/Type", {"graded"}},
      {"Mesh/Size ratio", "Mesh/Type", {"unstructured", "from the bounds"}},
      {"Mesh/Number of cells", "Mesh/Type", {"from the bounds"}},
      {"Mesh/Gmsh algorithm", "Mesh/Type", {"unstructured", "from the bounds"}},
      {"Linear solver/*", method, {"FEM", "MPM"}},
      {"Newton/*", method, {"FEM", "MPM"}},
      {"Time stepping/*", method, {"FEM", "MPM"}},
      {"Time stepping/Inertia", method, {"FEM"}},
      {"Exact solution/*", method, {"FEM", "MPM"}},
      {"Output/Freeze steps", method, {"FEM", "MPM"}},
      {"Output/Freeze failures", method, {"FEM", "MPM"}},
      {"Output/Fields format", "Output/Fields", {"true"}},
      {"Newton/First iterate sweeps",
       "Newton/First iterate",
       {"fixed point", "Gauss-Seidel"}},
      {"Particles/*", method, {"MPM", "explicit MPM"}},
      {"Particles/Points per direction",
       "Particles/Layout",
       {"Gauss", "sub-cells"}},
      {"Particles/Spacing", "Particles/Layout", {"lattice"}},
      {"Particles/Number", "Particles/Layout", {"random"}},
      {"Particles/Random seed", "Particles/Layout", {"random"}},
      {"Particles/File", "Particles/Layout", {"file"}},
      {"Material point method/Transfer", method, {"MPM", "explicit MPM"}},
      {"Material point method/FLIP part", method, {"MPM", "explicit MPM"}},
      {"Material point method/Largest imbalance",
       method,
       {"MPM", "explicit MPM"}},
      {"Material point method/Advection", method, {"MPM"}},
      {"Material point method/Consistent mass part", method, {"MPM"}},
      {"Material point method/Ghost stiffness", method, {"MPM"}},
      {"Material point method/Ghost stiffness of", method, {"MPM"}},
      {"Material point method/Ghost stiffness",
       "Material point method/Advection",
       {"grid velocity", "particle velocity"}},
      {"Material point method/Ghost stiffness of",
       "Material point method/Advection",
       {"grid velocity", "particle velocity"}},
      {"Material point method/Integration", method, {"MPM"}},
      {"Material point method/Theta",
       "Material point method/Integration",
       {"theta-scheme"}},
      {"Material point method/Newmark gamma",
       "Material point method/Integration",
       {"Newmark"}},
      {"Material point method/Newmark beta",
       "Material point method/Integration",
       {"Newmark"}},
      {"Time stepping/Theta", "Time stepping/Integration", {"theta-scheme"}},
      {"Time stepping/Newmark gamma",
       "Time stepping/Integration",
       {"Newmark"}},
      {"Time stepping/Newmark beta", "Time stepping/Integration", {"Newmark"}},
      {"Material point method/Start", method, {"MPM"}},
      {"Material point method/Largest move", method, {"MPM"}},
      {"Material point method/Grid follows", method, {"MPM"}},
      {"Material point method/FLIP part",
       "Material point method/Transfer",
       {"FLIP", "AFLIP"}},
      {"Explicit/*", method, {"explicit MPM"}}};

    std::vector<std::string>
    parts(const std::string &path)
    {
      return split_names(path, '/');
    }

    /** Whether a path is one of those of a rule; @p star is what a '*' stands
     *  for. */
    bool
    matches(const std::string &rule, const std::string &path, std::string &star)
    {
      const auto a = parts(rule), b = parts(path);
      if (a.size() != b.size())
        return false;
      for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] == "*")
          star = b[i];
        else if (a[i] != b[i])
          return false;
      return true;
    }
  } // namespace

  std::string
  unused_parameters(const std::vector<ParameterFile::Setting> &settings)
  {
    std::map<std::string, std::string> values; // of the choosers
    std::string                        list;
    const auto add = [&](const std::string &path, const std::string &chooser) {
      list += (list.empty() ? "" : ", ") + printable(path) + " (needs " +
              printable(chooser) + ")";
    };
    for (const ParameterFile::Setting &setting : settings)
      {
        if (!setting.of_other.empty())
          {
            add(setting.path, setting.of_other);
            continue;
          }
        // A file that holds all parameters, as used, says nothing by its
        // defaults.
        if (setting.value == setting.default_value)
          continue;
        for (const Rule &rule : rules)
          {
            std::string star;
            if (!matches(rule.parameter, setting.path, star))
              continue;
            std::string chooser = rule.chooser;
            if (const auto place = chooser.find('*');
                place != std::string::npos)
              chooser.replace(place, 1, star);
            const auto        known = values.find(chooser);
            const std::string value =
              known != values.end()
                ? known->second
                : (values[chooser] = ParameterFile::value(chooser));
            if (rule.values.empty()
                  ? !value.empty()
                  : std::count(rule.values.begin(), rule.values.end(), value) >
                      0)
              continue;
            if (!rule.other.empty() &&
                std::any_of(settings.begin(),
                            settings.end(),
                            [&](const ParameterFile::Setting &other) {
                              return matches(rule.other, other.path, star) &&
                                     !other.value.empty();
                            }))
              continue;
            std::string needed;
            for (const std::string &choice : rule.values)
              needed += (needed.empty() ? "" : " or ") + choice;
            add(setting.path, chooser + (needed.empty() ? "" : " = " + needed));
            break;
          }
      }
    return list.empty() ? "" : "set, but not used by this run: " + list;
  }
} // namespace geocone
