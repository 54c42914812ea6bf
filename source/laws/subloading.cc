// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/renamed_parameters.h>
#include <geocone/base/types.h>
#include <geocone/laws/subloading.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Constants = SubloadingConstants;

    const RenamedParameter
      renamed_tensors("Materials/*", "Show tensors", "Output tensors");

    /** A constant of the model as a parameter. */
    struct Constant
    {
      const char *name;
      double Constants::*value;
      const char        *documentation;
      bool (*holds)(const Constants &);
      const char *allowed;
      const char *remedy;

      double Constants::*bound = nullptr; ///< constant that limits the range
    };

    /** Not in the tables, which have the order of declarations and checks: the
     *  bound of M depends on it and follows its check. */
    constexpr Constant rotational_hardening = {
      "Rotational hardening rate cbeta",
      &Constants::cbeta,
      "Rate cbeta of rotational hardening [-], >= 0; 0: constant inclination "
      "beta.",
      [](const Constants &c) { return c.cbeta >= 0.; },
      "cbeta >= 0",
      "0 switches it off"};

    constexpr Constant elasticity_and_strength[] = {
      {"Swelling index kappa",
       &Constants::kappa,
       "Slope kappa of swelling lines in ln v - ln p [-], 0 < kappa < lambda: "
       "the kappa of textbooks divided by v.",
       [](const Constants &c) { return c.kappa > 0.; },
       "kappa > 0",
       "clays have 0.005 to 0.05"},
      {"Compression index lambda",
       &Constants::lambda,
       "Slope lambda of compression lines in ln v - ln p [-].",
       [](const Constants &c) { return c.lambda > c.kappa; },
       "lambda > kappa = ",
       "clays have lambda of 4 to 10 times kappa",
       &Constants::kappa},
      {"Poisson ratio",
       &Constants::nu,
       "Poisson's ratio nu [-], -1 < nu < 0.5.",
       [](const Constants &c) { return c.nu > -1. && c.nu < 0.5; },
       "-1 < nu < 0.5",
       "soils have 0.1 to 0.4"},
      {"Elastic cohesion pe",
       &Constants::pe,
       "Elastic cohesion pe [Pa], >= 0: the bulk modulus is (p + pe)/kappa.",
       [](const Constants &c) { return c.pe >= 0.; },
       "pe >= 0 Pa",
       "0, or some kPa for stiffness without pressure"},
      {"Apex ratio xi",
       &Constants::xi,
       "Apex ratio xi [-], 0 <= xi < 0.5: the yield surface extends to the "
       "tension p = -xi pcb.",
       [](const Constants &c) { return c.xi >= 0. && c.xi < 0.5; },
       "0 <= xi < 0.5",
       "0 for soil without tensile strength"},
      {"Yield slope M",
       &Constants::M,
       "Ratio M of the half axes q over p of the yield ellipsoid [-], > 0. "
       "With rotational hardening M <= k Mc.",
       [](const Constants &c) { return c.M > 0.; },
       "M > 0",
       "soils have 0.7 to 1.5"},
      {"Critical state slope Mc",
       &Constants::Mc,
       "Stress ratio Mc = q/p at the critical state in triaxial compression "
       "[-], > 0: 6 sin(phi)/(3 - sin(phi)). Used only by rotational "
       "hardening; without it the critical state is at M.",
       [](const Constants &c) { return c.Mc > 0.; },
       "Mc > 0",
       "6 sin(phi)/(3 - sin(phi)), with the friction angle phi"},
      {"Strength ratio k",
       &Constants::k,
       "Ratio k of the critical state slopes in triaxial extension and "
       "compression [-], 0.5 < k <= 1; 3/(3 + Mc): Mohr-Coulomb.",
       [](const Constants &c) { return c.k > 0.5 && c.k <= 1.; },
       "0.5 < k <= 1",
       "3/(3 + Mc) is Mohr-Coulomb's"}};

    constexpr Constant flow_and_hardening[] = {
      {"Potential ratio alpha",
       &Constants::alpha,
       "Slope of the plastic potential over M, alpha [-], 0 < alpha < sqrt(2); "
       "1: associated flow.",
       [](const Constants &c) { return c.alpha > 0. && c.alpha < sqrt2; },
       "0 < alpha < sqrt(2)",
       "1 is associated flow"},
      {"Subloading rate cR",
       &Constants::cR,
       "Rate cR [-], > 0, at which the subloading surface approaches the yield "
       "surface with plastic strain.",
       [](const Constants &c) { return c.cR > 0.; },
       "cR > 0",
       "20 to 1000; the larger, the more like a classical yield surface"},
      rotational_hardening,
      {"Structure loss rate cb",
       &Constants::cb,
       "Rate cb of structure loss [-], >= 0; 0: constant structure ratio.",
       [](const Constants &c) { return c.cb >= 0.; },
       "cb >= 0",
       "0 switches it off"},
      {"Final structure ratio Rbf",
       &Constants::Rbf,
       "Final structure ratio Rbf [-], >= 1.",
       [](const Constants &c) { return c.Rbf >= 1.; },
       "Rbf >= 1",
       "1: all structure can be lost"},
      {"Similarity centre rate ca",
       &Constants::ca,
       "Rate ca of the similarity centre [-], >= 0; 0: the centre moves only "
       "with the surface.",
       [](const Constants &c) { return c.ca >= 0.; },
       "ca >= 0",
       "0 switches it off"},
      {"Atmospheric pressure",
       &Constants::patm,
       "Reference pressure of rotational hardening [Pa], > 0.",
       [](const Constants &c) { return c.patm > 0.; },
       "> 0 Pa",
       "0.1 MPa is usual"},
      {"Elastic ratio Rmin",
       &Constants::Rmin,
       "Elastic ratio Rmin [-], 0 < Rmin < 1, much less than 1: elastic "
       "behaviour below it.",
       [](const Constants &c) { return c.Rmin > 0. && c.Rmin < 1.; },
       "0 < Rmin < 1",
       "0.01 is usual"},
      {"Centre margin delta",
       &Constants::delta,
       "Smallest relative distance delta of the similarity centre to the yield "
       "surface [-], 0 < delta < 1, much less than 1.",
       [](const Constants &c) { return c.delta > 0. && c.delta < 1.; },
       "0 < delta < 1",
       "0.01 is usual"}};

    constexpr Constant integration[] = {
      {"Error tolerance",
       &Constants::tolerance,
       "Relative error of a substep of the integration [-], > 0 and <= 0.1. "
       "Smaller increments need fewer substeps.",
       [](const Constants &c) {
         return c.tolerance > 0. && c.tolerance <= 0.1;
       },
       "0 < STOL <= 0.1",
       "1e-4 is usual"},
      {"Smallest substep",
       &Constants::smallest_substep,
       "Smallest substep relative to the increment [-], > 0 and <= 1; substeps "
       "of this size are accepted regardless of their error, and counted.",
       [](const Constants &c) {
         return c.smallest_substep > 0. && c.smallest_substep <= 1.;
       },
       "> 0 and <= 1",
       "1e-4 is usual"},
      {"Lowest pressure",
       &Constants::lowest_pressure,
       "Lower limit of p + pe [Pa], > 0; its use is counted.",
       [](const Constants &c) { return c.lowest_pressure > 0.; },
       "> 0 Pa",
       "a small value is usual: without pressure there is no stiffness"}};
  } // namespace

  Subloading::Subloading(const std::string &section)
    : ConstitutiveLaw(section)
  {
    const auto declare = [&](const auto &constants) {
      for (const Constant &constant : constants)
        add_parameter(constant.name, c.*constant.value, constant.documentation);
    };
    declare(elasticity_and_strength);
    declare(flow_and_hardening);
    rotation.declare(*this,
                     "Pressure of rotation",
                     ": interpretation of equation (24) of the report: sh = s "
                     "- p beta, or s - ph beta with ph = p + xi pcb.");
    declare(integration);

    add_parameter("Overconsolidation ratio",
                  ocr,
                  "Initial size of the yield surface over that of the surface "
                  "through the initial stress [-]; 1: normally consolidated.");
    add_parameter("Initial size pcb",
                  given_size,
                  "Initial size pcb of the structured yield surface [Pa]; 0: "
                  "from the overconsolidation ratio.");
    add_parameter("Smallest size pcb",
                  c.smallest_size,
                  "Lower limit of the size pcb of the yield surface [Pa], > 0, "
                  "initially and in softening; its use is counted.");
    add_parameter("Initial centre ratio chi",
                  chi,
                  "Initial ratio chi of the similarity centre to the stress "
                  "[-], 0 <= chi < 1.");
    add_parameter("Initial centre",
                  given_centre,
                  "Initial similarity centre a: xx, yy, zz, xy [Pa], tension "
                  "positive; in 3D also yz, zx. Empty: chi times the stress.");
    add_parameter("Initial anisotropy",
                  given_beta,
                  "Initial inclination beta: xx, yy, zz, xy [-], trace zero; "
                  "in 3D also yz, zx.");
    add_parameter("Initial anisotropy by stress",
                  zeta,
                  "Multiple of s/p of the initial stress that is added to the "
                  "initial anisotropy [-].");
    add_parameter("Initial structure ratio",
                  initial_Rb,
                  "Initial structure ratio Rb [-], >= Rbf.");
    add_parameter("Output tensors",
                  output_tensors,
                  "Whether fields and tables also contain the components of "
                  "the similarity centre a (Pa) and the inclination beta (-).");
    if_outside.declare(
      *this,
      "Stress outside",
      ": treatment of an initial stress outside the yield surface. Raise size: "
      "the yield surface is enlarged to contain it.");
  }

  void
  Subloading::check_constants() const
  {
    const auto check = [&](const Constant &constant) {
      require(constant.holds(c),
              constant.name,
              c.*constant.value,
              constant.allowed + (constant.bound != nullptr
                                    ? format("%g", c.*constant.bound)
                                    : ""),
              constant.remedy);
    };
    for (const Constant &constant : elasticity_and_strength)
      check(constant);
    check(rotational_hardening);
    require(c.cbeta == 0. || c.M <= c.k * c.Mc * (1. + 1e-12),
            "Yield slope M",
            c.M,
            "M <= k Mc = " + format("%g", c.k * c.Mc) + " where cbeta > 0",
            "lower M, or there is no critical state in extension");
    for (const Constant &constant : flow_and_hardening)
      check(constant);
    for (const Constant &constant : integration)
      check(constant);
  }

  void
  Subloading::check_initial() const
  {
    if (!(ocr > 0.))
      throw InputError(parameter("Overconsolidation ratio"),
                       ocr,
                       "> 0",
                       "1 is normally consolidated");
    if (!(given_size >= 0.))
      throw InputError(parameter("Initial size pcb"),
                       given_size,
                       ">= 0 Pa",
                       "0: by the overconsolidation ratio");
    if (!(c.smallest_size > 0.))
      throw InputError(parameter("Smallest size pcb"),
                       c.smallest_size,
                       "> 0 Pa",
                       "some kPa: a surface without size has no strength");
    if (!(chi >= 0. && chi < 1.))
      throw InputError(parameter("Initial centre ratio chi"),
                       chi,
                       "0 <= chi < 1",
                       "0: the centre starts at zero stress");
    bool is_finite = true;
    for (const double component : given_centre)
      is_finite = is_finite && std::isfinite(component);
    if (!is_finite || (!given_centre.empty() && given_centre.size() != 4 &&
                       given_centre.size() != 6))
      throw InputError(
        parameter("Initial centre"),
        dealii::Patterns::Tools::to_string(given_centre),
        "finite numbers xx, yy, zz, xy or xx, yy, zz, xy, yz, zx "
        "(Pa), or nothing",
        "leave it empty for 'Initial centre ratio chi'");
    if (!given_centre.empty() && chi != 0.)
      throw InputError(parameter("Initial centre ratio chi"),
                       chi,
                       "0 where 'Initial centre' is given",
                       "give one of them");
    double trace = 0., largest = 0.;
    for (std::size_t i = 0; i < given_beta.size(); ++i)
      {
        trace += i < 3 ? given_beta[i] : 0.;
        largest = std::max(largest, std::abs(given_beta[i]));
      }
    if ((given_beta.size() != 4 && given_beta.size() != 6) ||
        !(std::abs(trace) <= 1e-12 * largest))
      throw InputError(parameter("Initial anisotropy"),
                       dealii::Patterns::Tools::to_string(given_beta),
                       "xx, yy, zz, xy or xx, yy, zz, xy, yz, zx, with xx + yy "
                       "+ zz = 0",
                       "0, 0, 0, 0 is isotropic");
    if (!std::isfinite(zeta))
      throw InputError(parameter("Initial anisotropy by stress"),
                       zeta,
                       "a number",
                       "0 is isotropic");
    if (!(initial_Rb >= c.Rbf))
      throw InputError(parameter("Initial structure ratio"),
                       initial_Rb,
                       ">= Rbf = " + format("%g", c.Rbf),
                       "take Rbf for a soil that has lost its structure");
  }

  void
  Subloading::prepare()
  {
    ConstitutiveLaw::prepare();
    check_constants();
    check_initial();
    c.rotates_with_ph = rotation == Rotation::ph;
    in_plane          = SubloadingModel<4>(c);
    in_space          = SubloadingModel<6>(c);
  }

  template <int n>
  std::string
  Subloading::initial_state(const typename SubloadingModel<n>::Vector &stress,
                            SubloadingState<n>                        &y) const
  {
    const SubloadingModel<n> &law = model<n>();
    const double              p   = (stress[0] + stress[1] + stress[2]) / 3.;
    const std::string         at  = format(" (p = %g Pa)", p + 0.);
    if (!(p + c.pe >= c.lowest_pressure))
      throw InputError(parameter("Elastic cohesion pe"),
                       c.pe,
                       "p + pe >= " + format("%g", c.lowest_pressure) +
                         " Pa at the start" + at,
                       "raise pe or the initial pressure: there would be no "
                       "stiffness");
    y.stress = stress;
    y.a      = chi * stress;
    for (unsigned int i = 0; i < std::min<std::size_t>(n, given_centre.size());
         ++i)
      y.a[i] = (i < 3 ? -1. : -sqrt2) * given_centre[i];
    y.Rb = initial_Rb;
    y.beta.setZero();
    for (unsigned int i = 0; i < std::min<std::size_t>(n, given_beta.size());
         ++i)
      y.beta[i] = (i < 3 ? 1. : sqrt2) * given_beta[i];
    if (zeta != 0.)
      {
        if (!(p > 0.))
          throw InputError(parameter("Initial anisotropy by stress"),
                           zeta,
                           "0 where the initial stress has no pressure" + at,
                           "give 'Initial anisotropy' instead");
        y.beta += (zeta / p) * stress;
        y.beta.template head<3>().array() -= zeta;
      }
    const double through = law.size_through(y.stress, y.beta);
    if (!(through >= 0.) || (through == 0. && y.stress.norm() > 0.))
      throw InputError(parameter("Apex ratio xi"),
                       c.xi,
                       "a yield surface that can contain the initial stress" +
                         at,
                       "raise xi, or start from compression");
    y.pcb =
      given_size > 0. ? given_size : std::max(ocr * through, c.smallest_size);

    std::string changed;
    double      R = law.ratio(y);
    if (!(R <= 1. + 1e-12))
      {
        const std::string where =
          given_size > 0. ? "Initial size pcb" : "Overconsolidation ratio";
        if (if_outside == Outside::refuse)
          throw InputError(parameter(where),
                           given_size > 0. ? given_size : ocr,
                           "an initial stress within the yield surface; R = " +
                             format("%g", R) + at,
                           "raise it, or set 'Stress outside = raise size'");
        changed =
          "the size pcb was raised from " + format("%g", y.pcb) + " to " +
          format("%g", through) +
          " Pa: the initial stress was outside the yield surface, R = " +
          format("%g", R);
        y.pcb = through;
        R     = law.ratio(y);
      }
    // a = 0 with xi = 0 is an admissible limit.
    const double inside = law.yield_function(y.a, y.beta, y.pcb);
    if (!(R <= 1. + 1e-9) ||
        !(inside < 0. || (inside == 0. && y.a.norm() == 0.)))
      throw InputError(
        parameter(given_centre.empty() ? "Initial centre ratio chi"
                                       : "Initial centre"),
        given_centre.empty() ? format("%g", chi)
                             : dealii::Patterns::Tools::to_string(given_centre),
        "a similarity centre within the yield surface; fbar(a) = " +
          format("%g", inside) + " Pa^2" + at,
        "bring it nearer to zero stress, or lower the initial anisotropy");
    return changed;
  }

  template std::string
  Subloading::initial_state<4>(const SubloadingModel<4>::Vector &,
                               SubloadingState<4> &) const;
  template std::string
  Subloading::initial_state<6>(const SubloadingModel<6>::Vector &,
                               SubloadingState<6> &) const;
} // namespace geocone::GEOCONE_DIM
