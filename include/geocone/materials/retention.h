// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_retention_h
#define geocone_materials_retention_h

#include <geocone/base/choice.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Water retention curve and relative permeability of unsaturated soil.
   * The effective saturation S_e and the relative permeability k_r are
   * functions of the pressure head psi < 0 (m). The volumetric water content is
   *   theta = theta_r + (theta_s - theta_r) S_e.
   * Bishop's parameter chi(S_e) scales the suction in the effective stress
   * (Bishop 1959). Curves:
   *   van Genuchten (1980) with Mualem's model, m = 1 - 1/n,
   *     S_e = (1 + (alpha |psi|)^n)^-m,
   *     k_r = S_e^(1/2) (1 - (1 - S_e^(1/m))^m)^2;
   *   Gardner (1958): S_e = k_r = exp(alpha psi);
   *   a table of suction head, S_e and k_r.
   */
  class Retention
  {
  public:
    /** Declares the parameters of a material. */
    void
    declare(dealii::ParameterAcceptor &law);

    /** Checks the parameters. @param section of the material, for error
     *  messages
     *  @throws InputError for curves that are not monotone */
    void
    prepare(const std::string &section);

    /** Returns true if the soil retains water above the free surface. */
    bool
    acts() const
    {
      return curve != Curve::none;
    }

    /** Volume of water per volume of saturated soil (-): the porosity. */
    double
    saturated_content() const
    {
      return theta_s;
    }

    /** Returns true if suction increases the shear strength. */
    bool
    adds_strength() const
    {
      return acts() && bishop != Bishop::none;
    }

    /** Water content and relative permeability at a pressure head psi, with
     *  their derivatives with respect to psi. */
    struct State
    {
      double content, capacity;    ///< theta (-), d(theta)/d(psi) (1/m)
      double permeability, slope;  ///< k_r (-), d(k_r)/d(psi) (1/m)
      double effective_saturation; ///< S_e (-)
    };
    State
    at(const double psi) const;

    /** Suction stress chi u (Pa) in Bishop's effective stress, for a negative
     *  pore pressure u (Pa).
     *  @param unit_weight of water (N/m^3) */
    double
    suction_stress(const double u, const double unit_weight) const;

  private:
    enum class Curve
    {
      none,
      van_genuchten,
      gardner,
      table
    };
    enum class Bishop
    {
      none,
      effective_saturation,
      saturation
    };

    /** Effective saturation S_e and its derivative dS_e/dpsi (1/m). */
    std::array<double, 2>
    saturation(const double psi) const;

    /** Relative permeability k_r and its derivative dk_r/dpsi (1/m). */
    std::array<double, 2>
    permeability(const double psi) const;

    /** Index of the table row at the lower end of the interval that contains a
     *  suction head (m); the last row beyond the table. */
    std::size_t
    row(const double suction) const;

    void
    check_table(const std::string &section) const;

    Choice<Curve>  curve{{{"none", Curve::none},
                          {"van Genuchten", Curve::van_genuchten},
                          {"Gardner", Curve::gardner},
                          {"table", Curve::table}}};
    Choice<Bishop> bishop{
      {{"none", Bishop::none},
       {"effective saturation", Bishop::effective_saturation},
       {"saturation", Bishop::saturation}}};
    double alpha = 0., n = 0., theta_s = 0., theta_r = 0., storage = 0.;
    std::vector<dealii::Point<3>> rows; ///< suction head (m), S_e, k_r
  };
} // namespace geocone

#endif
