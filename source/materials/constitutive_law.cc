// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/base/exceptions.h>
#include <geocone/materials/constitutive_law.h>
#include <geocone/materials/retention.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  ConstitutiveLaw::ConstitutiveLaw(const std::string &section)
    : dealii::ParameterAcceptor("/" + section)
    , unsaturated(std::make_shared<Retention>())
  {
    add_parameter(
      "Density",
      rho,
      "Mass density rho [kg/m^3], > 0; below water, of the saturated soil.");
    add_parameter("Unit weight",
                  unit_weight,
                  "Unit weight gamma [N/m^3], > 0, instead of the density: rho "
                  "= gamma/|g|. 0: from 'Density'.");
    add_parameter(
      "Saturated unit weight",
      saturated_unit_weight,
      "Saturated unit weight [N/m^3], not less than that above the water, "
      "below the initial water table of 'Water'. 0: same as above the water.");
    add_parameter(
      "K0",
      k0,
      "Ratio of horizontal to vertical effective stress of this material [-] "
      "in a geostatic initial stress. 0: as 'Initial stress/K0'.");
    add_parameter(
      "Pore fluid bulk modulus",
      pore_fluid,
      "Bulk modulus of the pore fluid over porosity, K_w/n [Pa], of undrained "
      "soil. c, phi, E and nu are effective parameters; the excess pore "
      "pressure grows by dp = -K_w/n tr(de). 100 to 1000 times the bulk "
      "modulus of the soil (Skempton's B = 0.99 to 0.999) is practically "
      "incompressible. 0: drained.");
    add_parameter("Permeability",
                  conductivities,
                  std::string("Hydraulic conductivity [m/s] of soil in which "
                              "water flows ('Seepage'): one value, or ") +
                    (dim == 2 ? "two along two directions at a right angle."
                              : "three along x, y and z."));
    add_parameter("Permeability angle",
                  conductivity_angle,
                  std::string("Angle [degrees] from x, counterclockwise, of "
                              "the direction of the first of ") +
                    (dim == 2 ? "two" : "three") + " values of 'Permeability'" +
                    (dim == 2 ? "." : "; that of the third one is z."));
    add_parameter("Drainable porosity",
                  drainable,
                  "Volume of water per volume of soil [-] that drains as the "
                  "free surface of a transient flow falls (specific yield).");
    unsaturated->declare(*this);
  }

  std::string
  ConstitutiveLaw::parameter(const std::string &name) const
  {
    const std::string section = get_section_name().substr(1);
    return name.empty() ? section : section + "/" + name;
  }

  void
  ConstitutiveLaw::prepare()
  {
    if (!(rho > 0.))
      throw InputError(
        parameter("Density"),
        rho,
        "rho > 0 kg/m^3",
        "without inertia and gravity any positive value will do");
    rho_saturated = rho;
    require(unit_weight >= 0. && std::isfinite(unit_weight),
            "Unit weight",
            unit_weight,
            ">= 0 N/m^3, finite",
            "soils have 16000 to 22000 N/m^3; 0 leaves it to 'Density'");
    require(saturated_unit_weight >= 0. && std::isfinite(saturated_unit_weight),
            "Saturated unit weight",
            saturated_unit_weight,
            ">= 0 N/m^3, finite",
            "soils have 18000 to 22000 N/m^3; 0 is the same above and below "
            "the water");
    require(k0 >= 0. && std::isfinite(k0),
            "K0",
            k0,
            ">= 0, finite",
            "0.5 is usual; 0 leaves it to 'Initial stress/K0'");
    require(pore_fluid >= 0. && std::isfinite(pore_fluid),
            "Pore fluid bulk modulus",
            pore_fluid,
            ">= 0 Pa, finite",
            "water has 2.2 GPa; 0 is drained soil");
    unsaturated->prepare(parameter());
  }

  dealii::SymmetricTensor<2, dim>
  ConstitutiveLaw::permeability() const
  {
    const bool is_valid =
      (conductivities.size() == 1 || conductivities.size() == dim) &&
      std::all_of(conductivities.begin(),
                  conductivities.end(),
                  [](const double k) { return k > 0. && std::isfinite(k); });
    if (!is_valid)
      throw InputError(parameter("Permeability"),
                       dealii::Patterns::Tools::to_string(conductivities),
                       std::string("one or ") + (dim == 2 ? "two" : "three") +
                         " values > 0 m/s where water flows",
                       "sand has 1e-3 to 1e-5 m/s, silt 1e-7, clay 1e-9");
    require(std::isfinite(conductivity_angle),
            "Permeability angle",
            conductivity_angle,
            "finite",
            "the angle of the first value with x in degrees");
    const double k1 = conductivities.front(),
                 k2 = conductivities[conductivities.size() > 1 ? 1 : 0],
                 c  = std::cos(radians(conductivity_angle)),
                 s  = std::sin(radians(conductivity_angle));
    dealii::SymmetricTensor<2, dim> k;
    k[0][0] = k1 * c * c + k2 * s * s;
    k[1][1] = k1 * s * s + k2 * c * c;
    k[0][1] = (k1 - k2) * c * s;
    if constexpr (dim == 3)
      k[2][2] = conductivities.back();
    return k;
  }

  double
  ConstitutiveLaw::drainable_porosity() const
  {
    require(drainable > 0. && drainable < 1.,
            "Drainable porosity",
            drainable,
            "> 0, < 1 where the flow is transient",
            "sand has 0.2 to 0.3, silt 0.1, clay 0.03");
    return drainable;
  }

  void
  ConstitutiveLaw::set_gravity(const double g)
  {
    for (const auto &[name, value] :
         {std::pair("Unit weight", unit_weight),
          std::pair("Saturated unit weight", saturated_unit_weight)})
      require(value == 0. || g > 0.,
              name,
              value,
              "0 without gravity",
              "set 'Gravity/Acceleration', or give a 'Density'");
    if (unit_weight > 0.)
      rho = unit_weight / g;
    rho_saturated =
      saturated_unit_weight > 0. ? saturated_unit_weight / g : rho;
    require(rho_saturated >= rho,
            "Saturated unit weight",
            saturated_unit_weight,
            "at least that above the water",
            "it is the weight of the soil with the water in its pores");
  }

  void
  ConstitutiveLaw::require(const bool         holds,
                           const char        *name,
                           const double       value,
                           const std::string &allowed,
                           const char        *remedy) const
  {
    geocone::require(holds, parameter(name), value, allowed, remedy);
  }

  ConstitutiveLaw::Stress
  ConstitutiveLaw::full_stress(const Components &s, const double *history) const
  {
    Stress all = {{s[0], s[1], dim == 2 ? 0. : s[n_mandel / 2], s[2]}};
    if (dim == 2)
      all[2] = stress_zz(s, history);
    for (int i = 4; i < n_spatial; ++i)
      all[i] = s[i];
    return all;
  }

  ShownValue::ShownValue(const ConstitutiveLaw &law, const std::string &name)
    : law(&law)
  {
    const std::vector<ConstitutiveLaw::OutputQuantity> all =
      law.output_quantities();
    values.resize(all.size());
    while (place < all.size() && all[place].name != name)
      ++place;
  }

  double
  ShownValue::operator()(const ConstitutiveLaw::Components &stress,
                         const double                      *history)
  {
    if (place == values.size())
      return std::numeric_limits<double>::quiet_NaN();
    law->output(stress, history, values.data());
    return values[place];
  }
} // namespace geocone::GEOCONE_DIM
