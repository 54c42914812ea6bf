// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/materials/retention.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    const UsedWhere used_retention[] = {
      {"Materials/*/Retention", "Seepage/Names", {}},
      {"Materials/*/Retention alpha",
       "Materials/*/Retention",
       {"van Genuchten", "Gardner"}},
      {"Materials/*/Retention n", "Materials/*/Retention", {"van Genuchten"}},
      {"Materials/*/Retention table", "Materials/*/Retention", {"table"}},
      {"Materials/*/Saturated water content",
       "Materials/*/Retention",
       {"van Genuchten", "Gardner", "table"},
       "Time stepping/Consolidation"},
      {"Materials/*/Residual water content",
       "Materials/*/Retention",
       {"van Genuchten", "Gardner", "table"}},
      {"Materials/*/Specific storage",
       "Materials/*/Retention",
       {"van Genuchten", "Gardner", "table"}},
      {"Materials/*/Bishop parameter",
       "Materials/*/Retention",
       {"van Genuchten", "Gardner", "table"}}};

    /** Least relative permeability: equations of dry soil remain regular. */
    constexpr double least_permeability = 1e-12;

    /** Suction head times alpha below which k_r of van Genuchten's curve is linear
     *  in psi: its derivative at psi = 0 is infinite for n < 2. */
    constexpr double linear_part = 0.01;
  } // namespace

  void
  Retention::declare(dealii::ParameterAcceptor &law)
  {
    curve.declare(
      law,
      "Retention",
      ". Water content and relative permeability of unsaturated soil as "
      "functions of the suction; none: the soil above the free surface has no "
      "suction. All materials of a flow have a curve, or none has.");
    law.add_parameter("Retention alpha",
                      alpha,
                      "alpha of the retention curve [1/m], the inverse of a "
                      "height of capillary rise.");
    law.add_parameter(
      "Retention n", n, "n of van Genuchten's retention curve [-], > 1.");
    law.add_parameter("Retention table",
                      rows,
                      "Retention curve s, Se, kr; s, Se, kr; ... with the "
                      "suction head s [m], effective saturation and relative "
                      "permeability, from 0, 1, 1 on; linear between, constant "
                      "beyond.");
    law.add_parameter("Saturated water content",
                      theta_s,
                      "Volume of water per volume of saturated soil [-].");
    law.add_parameter("Residual water content",
                      theta_r,
                      "Volume of water per volume of soil at a large suction "
                      "[-].");
    law.add_parameter("Specific storage",
                      storage,
                      "Volume of water that a volume of saturated soil takes "
                      "per head of pressure [1/m].");
    bishop.declare(
      law,
      "Bishop parameter",
      ". chi of Bishop's effective stress: the part of the suction that "
      "presses the grains together, which acts as a cohesion. none: suction "
      "adds no strength, which is conservative.");
  }

  void
  Retention::prepare(const std::string &section)
  {
    if (!acts())
      return;
    const std::string place = section + "/";
    if (curve != Curve::table)
      require(alpha > 0. && std::isfinite(alpha),
              place + "Retention alpha",
              alpha,
              "> 0 1/m, finite",
              "sand has 3 to 15, silt 1 to 3, clay 0.5 to 1");
    if (curve == Curve::van_genuchten)
      require(n > 1. && std::isfinite(n),
              place + "Retention n",
              n,
              "> 1: otherwise the curve is not monotone",
              "sand has 2 to 3, silt 1.4, clay 1.1");
    if (curve == Curve::table)
      check_table(section);
    require(theta_s > 0. && theta_s < 1.,
            place + "Saturated water content",
            theta_s,
            "> 0, < 1",
            "it is the porosity, e.g. 0.4");
    require(theta_r >= 0. && theta_r < theta_s,
            place + "Residual water content",
            theta_r,
            format(">= 0 and less than the saturated one, %g", theta_s),
            "0.05 is usual");
    require(storage >= 0. && std::isfinite(storage),
            place + "Specific storage",
            storage,
            ">= 0 1/m, finite",
            "1e-5 to 1e-3 are usual; 0: rigid soil");
  }

  void
  Retention::check_table(const std::string &section) const
  {
    bool is_valid = rows.size() >= 2 && rows[0] == dealii::Point<3>(0., 1., 1.);
    for (std::size_t i = 0; is_valid && i < rows.size(); ++i)
      {
        is_valid = std::isfinite(rows[i].square()) && rows[i][1] >= 0. &&
                   rows[i][2] > 0.;
        if (i > 0)
          is_valid = is_valid && rows[i][0] > rows[i - 1][0] &&
                     rows[i][1] < rows[i - 1][1] && rows[i][2] < rows[i - 1][2];
      }
    if (!is_valid)
      throw InputError(
        section + "/Retention table",
        dealii::Patterns::Tools::to_string(rows),
        "rows s, Se, kr from 0, 1, 1 on, with growing s, falling Se >= 0 and "
        "falling kr > 0: a monotone curve",
        "e.g. 0, 1, 1; 1, 0.6, 0.1; 10, 0.1, 1e-5");
  }

  std::size_t
  Retention::row(const double suction) const
  {
    std::size_t i = 0;
    while (i + 1 < rows.size() && rows[i + 1][0] <= suction)
      ++i;
    return i;
  }

  std::array<double, 2>
  Retention::saturation(const double psi) const
  {
    if (psi >= 0.)
      return {{1., 0.}};
    switch (curve)
      {
        case Curve::gardner:
          {
            const double S = std::exp(alpha * psi);
            return {{S, alpha * S}};
          }
        case Curve::van_genuchten:
          {
            const double m = 1. - 1. / n, x = -alpha * psi, p = std::pow(x, n),
                         S = std::pow(1. + p, -m);
            return {{S, m * n * alpha * p / x * S / (1. + p)}};
          }
        default:
          {
            const std::size_t i = row(-psi);
            if (i + 1 == rows.size())
              return {{rows[i][1], 0.}};
            const double slope =
              (rows[i + 1][1] - rows[i][1]) / (rows[i + 1][0] - rows[i][0]);
            return {{rows[i][1] + slope * (-psi - rows[i][0]), -slope}};
          }
      }
  }

  std::array<double, 2>
  Retention::permeability(const double psi) const
  {
    if (psi >= 0.)
      return {{1., 0.}};
    double k = 1., slope = 0.;
    switch (curve)
      {
        case Curve::gardner:
          k     = std::exp(alpha * psi);
          slope = alpha * k;
          break;
        case Curve::van_genuchten:
          {
            const double x = -alpha * psi, m = 1. - 1. / n;
            // k_r at x and its derivative by x, of the exact curve.
            const auto exact = [&](const double at) {
              // 1 - (1 - S_e^(1/m))^m = 1 - (p/(1 + p))^m
              const double p = std::pow(at, n), S = std::pow(1. + p, -m),
                           r = p / (1. + p), g = -std::expm1(m * std::log(r)),
                           root = std::sqrt(S);
              const double dS   = -m * n * p / at * S / (1. + p),
                           dg   = -m * std::pow(r, m) * n / (at * (1. + p));
              return std::array<double, 2>{
                {root * g * g, 0.5 * dS / root * g * g + 2. * root * g * dg}};
            };
            if (x < linear_part)
              {
                slope = alpha * (1. - exact(linear_part)[0]) / linear_part;
                k     = 1. + slope * psi;
              }
            else
              {
                const auto [value, derivative] = exact(x);
                k                              = value;
                slope                          = -alpha * derivative;
              }
            break;
          }
        default:
          {
            const std::size_t i = row(-psi);
            k                   = rows[i][2];
            if (i + 1 < rows.size())
              {
                const double by_suction =
                  (rows[i + 1][2] - rows[i][2]) / (rows[i + 1][0] - rows[i][0]);
                k += by_suction * (-psi - rows[i][0]);
                slope = -by_suction;
              }
          }
      }
    if (!(k > least_permeability))
      return {{least_permeability, 0.}};
    return {{k, slope}};
  }

  Retention::State
  Retention::at(const double psi) const
  {
    const auto [S, dS]       = saturation(psi);
    const auto [k, dk]       = permeability(psi);
    const double compression = psi > 0. ? storage : 0.;
    return {theta_r + (theta_s - theta_r) * S + compression * psi,
            (theta_s - theta_r) * dS + compression,
            k,
            dk,
            S};
  }

  double
  Retention::suction_stress(const double u, const double unit_weight) const
  {
    if (!(u < 0.) || !adds_strength())
      return 0.;
    const double S = saturation(u / unit_weight)[0];
    return u * (bishop == Bishop::effective_saturation
                  ? S
                  : (theta_r + (theta_s - theta_r) * S) / theta_s);
  }
} // namespace geocone
