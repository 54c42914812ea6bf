// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/constitutive_law.h>

#include <limits>

namespace geocone
{
  ConstitutiveLaw::ConstitutiveLaw(const std::string &section)
    : dealii::ParameterAcceptor("/" + section)
  {
    add_parameter("Density", rho, "Mass density rho (kg/m^3), > 0.");
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
  }

  ShownValue::ShownValue(const ConstitutiveLaw &law, const std::string &name)
    : law(&law)
  {
    const std::vector<ConstitutiveLaw::Shown> all = law.shown();
    values.resize(all.size());
    while (place < all.size() && all[place].name != name)
      ++place;
  }

  double
  ShownValue::operator()(const std::array<double, 3> &in_plane,
                         const double                *history)
  {
    if (place == values.size())
      return std::numeric_limits<double>::quiet_NaN();
    law->show(in_plane, history, values.data());
    return values[place];
  }
} // namespace geocone
