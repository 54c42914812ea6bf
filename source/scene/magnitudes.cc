// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/number_in.h>
#include <geocone/base/units.h>
#include <geocone/scene/magnitudes.h>

#include <algorithm>
#include <limits>
#include <map>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** gamma H of a material (Pa), with its density and the full height of the
     *  body. */
    double
    weight_of_column(const Scene                    &scene,
                     const unsigned int              material,
                     const dealii::BoundingBox<dim> &body)
    {
      return scene.materials.law(material).density() *
             scene.gravity.at(std::numeric_limits<double>::max()).norm() *
             body.side_length(1);
    }
  } // namespace

  std::string
  text_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body)
  {
    std::string text = "body";
    for (unsigned int d = 0; d < dim; ++d)
      text += format(d == 0 ? " %g" : " x %g", body.side_length(d));
    text += " m";
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      if (const auto strength = scene.materials.law(m).plane_strain_strength())
        {
          // Laws of such strengths are in closed form.
          const bool varies = !scene.materials[m].strength_formula().empty();
          text += "; " + scene.materials.name(m) +
                  (varies ? std::string(": c varies")
                          : format(": c = %g Pa", strength->c)) +
                  format(", phi = %g", strength->phi);
          for (const auto &[ratio, symbol] :
               {std::pair<const char *, const char *>("Passive", "s_uP/c"),
                {"Simple shear", "s_uD/c"}})
            if (const std::string value =
                  ParameterFile::value("Materials/" + scene.materials.name(m) +
                                       "/" + ratio + " strength ratio");
                !value.empty() && value != "1")
              text += format(", %s = ", symbol) + value;
          if (const double weight = weight_of_column(scene, m, body);
              weight > 0. && !varies)
            text += format(", c/(gamma H) = %.3g", strength->c / weight);
        }
    return text;
  }

  namespace
  {
    /** Warnings of gravity and water that are probably in other units, or act
     *  upwards. */
    std::vector<std::string>
    warn_of_gravity(const Scene &scene)
    {
      constexpr double largest_g      = 3000.; // m/s^2, in a centrifuge
      const double     lightest_water = 500. / mass_unit(), // kg/m^3
        heaviest_water                = 4. * lightest_water;
      std::vector<std::string>     warnings;
      const dealii::Tensor<1, dim> gravity =
        scene.gravity.at(std::numeric_limits<double>::max());
      const double g = gravity.norm();
      if (g > largest_g)
        warnings.push_back(
          format("gravity is %g m/s^2: accelerations are in m/s^2", g));
      if (gravity[1] > 0.5 * g)
        warnings.push_back(
          format("gravity acts upwards, with %g m/s^2 in y: usually it is "
                 "negative, e.g. 0, -9.81",
                 gravity[1]));
      if (const double weight = scene.water.weight();
          scene.water.acts() && !scene.water.scales_with_weight() && g > 0. &&
          (weight < lightest_water * g || weight > heaviest_water * g))
        warnings.push_back(
          format("water weighs %g N/m^3 ('Water/Unit weight'), where its "
                 "weight in this gravity is about %g N/m^3",
                 weight,
                 2. * lightest_water * g));
      return warnings;
    }

    /** Warnings of holes that water at rest fills, and on whose sides no condition acts. */
    std::vector<std::string>
    warn_of_holes(const Scene &scene)
    {
      std::vector<std::string> warnings;
      const Water             &water = scene.water;
      if (!water.acts() || water.seepage.acts() || water.scales_with_weight())
        return warnings;
      for (std::size_t i = 0; i < scene.geometry.holes.size(); ++i)
        {
          double most = 0.;
          for (const dealii::Point<dim> &x : scene.geometry.holes[i])
            most = std::max(most, water.pressure(x));
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

    /** Warnings of water that presses on sides and on bodies that touch them. */
    std::vector<std::string>
    warn_of_thrusts(const Scene &scene)
    {
      const Water             &water = scene.water;
      std::vector<std::string> warnings;
      if (!water.acts() || water.scales_with_weight() ||
          scene.geometry.is_axisymmetric() ||
          scene.geometry.is_part_by_formula())
        return warnings;
      const std::vector<WetPoint> wet = wet_points(scene);
      for (const auto &more :
           {water.seepage.acts() ? warn_of_closed_sides(scene, wet)
                                 : std::vector<std::string>(),
            warn_of_wet_obstacles(scene, wet),
            warn_of_wet_plates(scene, wet)})
        warnings.insert(warnings.end(), more.begin(), more.end());
      return warnings;
    }
  } // namespace

  std::vector<std::string>
  warn_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body)
  {
    constexpr double largest_body = 1e3, smallest_body = 1e-3; // m
    const double     lightest = 100. / mass_unit(), heaviest = 100. * lightest;
    const double     in_kilopascals = 500. / mass_unit(); // rather kPa than Pa
    constexpr double least_strength = 1e-5; // over gamma H, frictionless
    constexpr double least_angle    = 1.5;  // degrees; half of a right angle in
                                            // radians is less
    std::vector<std::string> warnings = warn_of_gravity(scene);
    for (const auto &more : {warn_of_holes(scene), warn_of_thrusts(scene)})
      warnings.insert(warnings.end(), more.begin(), more.end());
    double size = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      size = std::max(size, body.side_length(d));
    if (scene.gravity.acts() &&
        !(size >= smallest_body && size <= largest_body))
      warnings.push_back(
        format("the body is %g m large: is it meant in other units? Lengths "
               "are in m",
               size));
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const std::string name    = scene.materials.name(m);
        const double      density = scene.materials.law(m).density();
        if (scene.gravity.acts() && density > 0. &&
            !(density >= lightest && density <= heaviest))
          warnings.push_back(
            format("the density of '%s' is %g kg/m^3", name.c_str(), density));
        if (scene.materials.law(m).saturated_density() > density &&
            (!scene.water.acts() || scene.water.scales_with_weight()))
          warnings.push_back("the saturated unit weight of '" + name +
                             "' is not used: there is no water table");
        const auto number = [&](const char *parameter) {
          return number_in(
            ParameterFile::value("Materials/" + name + "/" + parameter));
        };
        if (number("Anisotropy angle").value_or(0.) != 0. &&
            number("Passive strength ratio") == 1. &&
            number("Simple shear strength ratio") == 1.)
          warnings.push_back("the anisotropy angle of '" + name +
                             "' is not used: both strength ratios are 1");
        const auto strength = scene.materials.law(m).plane_strain_strength();
        if (!strength)
          continue;
        const bool varies = strength->gradient != 0. ||
                            !scene.materials[m].strength_formula().empty();
        if (strength->phi > 0. && strength->phi < least_angle)
          warnings.push_back(
            format("the friction angle of '%s' is %g degrees: angles are in "
                   "degrees, not in radians",
                   name.c_str(),
                   strength->phi));
        const double weight = weight_of_column(scene, m, body);
        if (strength->phi == 0. && !varies &&
            strength->c < least_strength * weight)
          warnings.push_back(
            format("the cohesion of '%s' is %g Pa, where a column of it as "
                   "high as the body weighs %.3g Pa: strengths are in Pa",
                   name.c_str(),
                   strength->c,
                   weight));
        else if (size >= 1. && weight > 0. && !varies && strength->c > 0. &&
                 strength->c < in_kilopascals)
          warnings.push_back(
            format("the cohesion of '%s' is %g Pa: is it meant in "
                   "larger units? Strengths are in Pa",
                   name.c_str(),
                   strength->c));
        if (const double E = number("Young modulus").value_or(0.);
            E > 0. && E < strength->c)
          warnings.push_back(
            format("Young's modulus of '%s', %g Pa, is smaller "
                   "than its cohesion, %g Pa",
                   name.c_str(),
                   E,
                   strength->c));
      }
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
