// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/number_in.h>
#include <geocone/base/units.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/scene/water_thrusts.h>

#include <algorithm>
#include <limits>

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
    std::vector<std::string>       warnings = warn_of_gravity(scene);
    const std::vector<std::string> thrusts  = warn_of_water_thrusts(scene);
    warnings.insert(warnings.end(), thrusts.begin(), thrusts.end());
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
