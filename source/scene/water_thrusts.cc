// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/scene/water_thrusts.h>

#include <algorithm>
#include <map>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Warnings of holes that water at rest fills, and on whose sides no condition acts. */
    std::vector<std::string>
    warn_of_holes(const Scene &scene)
    {
      std::vector<std::string> warnings;
      for (std::size_t i = 0; i < scene.geometry.holes.size(); ++i)
        {
          double most = 0.;
          for (const dealii::Point<dim> &x : scene.geometry.holes[i])
            most = std::max(most, scene.water.pressure(x));
          const std::string &name    = scene.geometry.hole_names[i];
          const auto        &sides   = scene.geometry.sides_of_hole.at(name);
          const auto         acts_on = [&](const BoundaryConditions &all) {
            return std::any_of(
              all.list.begin(), all.list.end(), [&](const auto &condition) {
                return std::any_of(
                  sides.begin(), sides.end(), [&](const std::string &side) {
                    return condition->is_on_side(side);
                  });
              });
          };
          if (most > 0. && !acts_on(scene.dirichlet) &&
              !acts_on(scene.tractions))
            warnings.push_back(
              format("'%s' is filled with water, with up to %.4g Pa on its "
                     "sides: if it is empty, let water flow to it by "
                     "'Seepage', or give its sides 'Traction normal = pore "
                     "pressure'",
                     name.c_str(),
                     most));
        }
      return warnings;
    }

    /** Point of the boundary of the body, with the thrust u n dl (N/m) of its pore
     *  water. */
    struct WetPoint
    {
      std::string            side;
      dealii::Point<dim>     x;
      dealii::Tensor<1, dim> n; ///< outward unit normal
      dealii::Tensor<1, dim> thrust;
    };

    /** Points of the sides, between straight ends, where the pore pressure is
     *  positive at the start. */
    std::vector<WetPoint>
    wet_points(const Scene &scene)
    {
      std::vector<WetPoint> points;
      if constexpr (dim == 2)
        for (const auto &[name, id] : scene.geometry.sides)
          {
            constexpr unsigned int n    = 200;
            const auto [a, b]           = scene.geometry.side_ends(id);
            const auto             edge = (b - a) / n;
            dealii::Tensor<1, dim> normal;
            normal[0] = edge[1];
            normal[1] = -edge[0];
            for (unsigned int i = 0; i < n; ++i)
              {
                const auto   x = a + (i + 0.5) * edge;
                const double u = scene.water.pressure(x);
                if (u > 0.)
                  points.push_back(
                    {name, x, normal / normal.norm(), u * normal});
              }
          }
      return points;
    }

    /** Warnings of sides at which water stays in the soil and nothing is
     *  outside: the pressure holds them as free water does. */
    std::vector<std::string>
    warn_of_closed_sides(const Scene &scene, const std::vector<WetPoint> &wet)
    {
      if (scene.has_contact() ||
          !ParameterFile::value("Discretisation/Tied sides").empty())
        return {};
      std::map<std::string, std::pair<double, double>> of_side;
      for (const WetPoint &point : wet)
        {
          const auto holds = [&](const auto &part) {
            return part->is_on_side(point.side) && part->holds_at(point.x);
          };
          const auto is_held = [&](const auto &condition) {
            double held = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              if (condition->components[d])
                held += point.n[d] * point.n[d];
            return holds(condition) && (condition->normal || held > 0.5);
          };
          const auto &flow  = scene.water.seepage.list;
          const auto &held  = scene.dirichlet.list,
                     &loads = scene.tractions.list;
          if (std::any_of(flow.begin(), flow.end(), holds) ||
              std::any_of(held.begin(), held.end(), is_held) ||
              std::any_of(loads.begin(), loads.end(), holds))
            continue;
          auto &[most, sum] = of_side[point.side];
          most              = std::max(most, scene.water.pressure(point.x));
          sum += point.thrust.norm();
        }
      std::vector<std::string> warnings;
      for (const auto &[side, thrust] : of_side)
        warnings.push_back(
          format("the side '%s' is not in 'Seepage', and water presses on it "
                 "with up to %.4g Pa, %.4g N/m in all: it is held as by free "
                 "water outside; name it with 'Level = none' if water leaves "
                 "there, or give it 'Traction normal = pore pressure' if it is "
                 "closed and dry outside",
                 side.c_str(),
                 thrust.first,
                 thrust.second));
      return warnings;
    }

    /** Warnings of free obstacles that pore water presses. */
    std::vector<std::string>
    warn_of_wet_obstacles(const Scene &scene, const std::vector<WetPoint> &wet)
    {
      std::vector<std::string> warnings;
      for (const auto &obstacle : scene.obstacles.list)
        {
          dealii::Tensor<1, dim> force;
          double                 moment = 0., most = 0.;
          for (const WetPoint &point : wet)
            if (obstacle->is_free() &&
                obstacle->nearest(point.x, {}, {}).distance <
                  1e3 * scene.geometry.rounding())
              {
                const auto r = point.x - obstacle->centre();
                force += point.thrust;
                moment += r[0] * point.thrust[1] - r[1] * point.thrust[0];
                most = std::max(most, scene.water.pressure(point.x));
              }
          if (most > 0.)
            warnings.push_back(
              format("obstacles feel effective stresses alone, and water "
                     "presses where '%s' touches the soil at the start: add "
                     "'Force x' = %.4g, 'Force y' = %.4g and 'Moment' = %.4g",
                     obstacle->name.c_str(),
                     force[0],
                     force[1],
                     moment));
        }
      return warnings;
    }

    /** Warnings of plates that pore water presses from one side. */
    std::vector<std::string>
    warn_of_wet_plates(const Scene &scene, const std::vector<WetPoint> &wet)
    {
      std::vector<std::string> warnings;
      for (const Structure *const plate : scene.structures.plates())
        {
          dealii::Tensor<1, dim> force;
          for (const WetPoint &point : wet)
            for (std::size_t i = 1; i < plate->points.size(); ++i)
              if (distance_to_segment(
                    point.x, plate->points[i - 1], plate->points[i]) <
                  1e-6 * plate->points[i - 1].distance(plate->points[i]))
                force += point.thrust;
          if (force.norm() > 0.)
            warnings.push_back(format(
              "the plate '%s' is on a side of the body, and water is taken to "
              "stand on both sides of it: if it is dry outside, its thrust of "
              "%.4g, %.4g N/m is missing: give this side 'Traction normal = "
              "pore pressure'",
              plate->name.c_str(),
              force[0],
              force[1]));
          else if (scene.water.seepage.acts())
            warnings.push_back(
              "water flows through the plate '" + plate->name +
              "': a wall that holds water is a strip of soil with a small "
              "'Permeability' along it");
        }
      return warnings;
    }
  } // namespace

  std::vector<std::string>
  warn_of_water_thrusts(const Scene &scene)
  {
    const Water             &water = scene.water;
    std::vector<std::string> warnings;
    if (!water.acts() || water.scales_with_weight())
      return warnings;
    const auto take = [&](const std::vector<std::string> &more) {
      warnings.insert(warnings.end(), more.begin(), more.end());
    };
    if (!water.seepage.acts())
      take(warn_of_holes(scene));
    if (scene.geometry.is_axisymmetric() || scene.geometry.is_part_by_formula())
      return warnings;
    const std::vector<WetPoint> wet = wet_points(scene);
    if (water.seepage.acts())
      take(warn_of_closed_sides(scene, wet));
    take(warn_of_wet_obstacles(scene, wet));
    take(warn_of_wet_plates(scene, wet));
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
