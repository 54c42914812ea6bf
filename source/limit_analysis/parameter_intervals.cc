// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/number_in.h>
#include <geocone/base/parameter_file.h>
#include <geocone/laws/mohr_coulomb.h>
#include <geocone/limit_analysis/parameter_intervals.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Kind = ParameterInterval::Kind;

    double
    limit_in(const std::string &text, const std::string &item)
    {
      const auto value = number_in(dealii::Utilities::trim(text));
      if (!value || !std::isfinite(*value))
        throw InputError(interval_parameter,
                         item,
                         "NAME/PARAMETER: LEAST .. LARGEST; ...",
                         "e.g. clay/Cohesion: 18e3 .. 22e3");
      return *value;
    }

    ParameterInterval
    read_interval(const std::string &item, const Scene &scene)
    {
      static const std::pair<const char *, Kind> kinds[] = {
        {"Cohesion", Kind::cohesion},
        {"Friction angle", Kind::friction_angle},
        {"Tensile strength", Kind::tensile_strength},
        {"Unit weight", Kind::unit_weight},
        {"Density", Kind::unit_weight},
        {"Traction factor", Kind::traction}};
      const std::size_t colon = item.rfind(':'),
                        slash = item.substr(0, colon).find('/'),
                        dots  = item.find("..", colon);
      const auto refuse       = [&](const std::string &allowed,
                              const std::string &remedy) {
        throw InputError(interval_parameter, item, allowed, remedy);
      };
      if (colon == std::string::npos || slash == std::string::npos ||
          dots == std::string::npos)
        refuse("NAME/PARAMETER: LEAST .. LARGEST; ...",
               "e.g. clay/Cohesion: 18e3 .. 22e3");
      ParameterInterval one;
      one.name                = dealii::Utilities::trim(item.substr(0, colon));
      const std::string owner = dealii::Utilities::trim(item.substr(0, slash)),
                        name  = dealii::Utilities::trim(
                          item.substr(slash + 1, colon - slash - 1));
      const auto kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const auto &k) {
          return name == k.first;
        });
      if (kind == std::end(kinds))
        refuse("Cohesion | Friction angle | Tensile strength | Unit weight | "
               "Density of a material, or Traction factor of a traction",
               "nothing is proven for intervals of other parameters");
      one.kind  = kind->second;
      one.range = {{limit_in(item.substr(colon + 1, dots - colon - 1), item),
                    limit_in(item.substr(dots + 2), item)}};
      const bool  is_traction = one.kind == Kind::traction;
      const auto &names =
        is_traction ? scene.tractions.names() : scene.materials.names();
      const auto found = std::find(names.begin(), names.end(), owner);
      if (found == names.end())
        refuse(is_traction
                 ? "a name of 'Tractions/Names' before /Traction factor"
                 : "a name of 'Materials/Names' before /" + name,
               names.empty() ? "there is none" : "e.g. " + names.front());
      one.index = found - names.begin();
      if (one.kind == Kind::unit_weight)
        {
          const double g =
            scene.gravity.at(std::numeric_limits<double>::max()).norm();
          one.unit = scene.materials.law(one.index).density() *
                     (name == "Density" ? 1. : g);
          if (!(one.unit > 0. && g > 0.))
            refuse("a material with weight",
                   "give 'Gravity/Acceleration' and its weight");
          for (double &limit : one.range)
            limit /= one.unit;
        }
      return one;
    }

    void
    check_interval(const ParameterInterval &one,
                   const std::string       &item,
                   const Scene             &scene)
    {
      const auto require_that = [&](const bool         holds,
                                    const std::string &allowed,
                                    const std::string &remedy) {
        require(holds, interval_parameter, item, allowed, remedy);
      };
      require_that(
        one.range[0] <= one.range[1], "LEAST <= LARGEST", "exchange them");
      require_that(one.range[0] >= 0.,
                   "limits >= 0",
                   "strengths and weights are not negative");
      if (one.kind == Kind::traction)
        return;
      const std::string section =
        "Materials/" + scene.materials.name(one.index);
      const auto &law  = scene.materials.law(one.index);
      const auto  cone = *scene.materials[one.index].initial_cone();
      if (one.kind == Kind::unit_weight)
        {
          require_that(
            !scene.water.scales_with_weight(),
            "no unit weights beside a 'Water/Pore pressure ratio'",
            "pore pressures would change with them: compute each weight");
          return require_that(
            !(scene.water.acts() && law.saturated_density() > law.density()),
            "a material of one unit weight, above and below the water",
            "leave out '" + section +
              "/Saturated unit weight', or compute each weight");
        }
      const auto        declared = ParameterFile::declared_in(section);
      const std::string name     = one.name.substr(one.name.find('/') + 1);
      require_that(std::find(declared.begin(), declared.end(), name) !=
                     declared.end(),
                   "parameters of the material's 'Type'",
                   "take Mohr-Coulomb, which has it");
      if (one.kind == Kind::cohesion)
        require_that(scene.materials[one.index].strength_formula().empty(),
                     "none where the cohesion is a formula",
                     "give the least and the largest formula in a run each");
      if (one.kind == Kind::tensile_strength)
        require_that(cone.is_cut() && one.range[0] > 0.,
                     "limits > 0 Pa, and a '" + section + "/Tensile strength'",
                     "give both");
      if (one.kind == Kind::friction_angle)
        {
          require_that(
            one.range[1] < 90., "limits < 90 degrees", "give degrees");
          const auto *const plane =
            dynamic_cast<const MohrCoulomb *>(&scene.materials[one.index]);
          require_that(one.range[1] == 0. || plane == nullptr ||
                         !plane->undrained_anisotropy().acts(),
                       "0 .. 0 where the strength depends on the direction",
                       "strengths by direction are undrained ones: leave the "
                       "ratios of strength of '" +
                         section + "' or the interval out");
          require_that(
            one.range[0] > 0. || one.range[1] == 0. || cone.is_cut(),
            "LEAST > 0 degrees without 'Tensile strength': soil with phi = 0 "
            "carries any tension, so no cone contains all strengths",
            "take e.g. 1 degree, or give '" + section + "/Tensile strength'");
        }
    }
  } // namespace

  std::vector<ParameterInterval>
  parameter_intervals(const std::string &text, const Scene &scene)
  {
    std::set<std::pair<Kind, unsigned int>> all;
    std::vector<ParameterInterval>          intervals;
    for (const std::string &item :
         dealii::Utilities::split_string_list(text, ';'))
      {
        intervals.push_back(read_interval(item, scene));
        const ParameterInterval &one = intervals.back();
        check_interval(one, item, scene);
        require(all.emplace(one.kind, one.index).second,
                interval_parameter,
                item,
                "one interval of each parameter",
                "leave one out");
      }
    return intervals;
  }
} // namespace geocone::GEOCONE_DIM
