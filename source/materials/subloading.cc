// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/types.h>
#include <geocone/materials/spin.h>
#include <geocone/materials/subloading.h>
#include <geocone/materials/subloading_curves.h>
#include <geocone/materials/subloading_kernel.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    using Components = ConstitutiveLaw::Components;
    using Model      = SubloadingModel<n_spatial>;

    /** Places in the history of a point; s_zz is there in the plane only. */
    enum
    {
      stress_zz,
      centre      = stress_zz + (dim == 2),
      inclination = centre + n_spatial,
      size        = inclination + n_spatial,
      structure
    };

    /** Names of the components in the order of the model, and where the motion has
     *  each among its own; zz is not there in the plane. */
    constexpr const char *component[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    constexpr int place_in_motion[6]   = {0, 1, dim == 2 ? -1 : 3, 2, 4, 5};

    /** Of a component k of the model, in a Mandel vector. */
    constexpr double
    factor(const int k)
    {
      return k < 3 ? 1. : sqrt2;
    }

    /** A stress of the motion in that of the model, which keeps the others. */
    void
    take_stress(const Components &s, Model::Vector &stress)
    {
      for (int k = 0; k < n_spatial; ++k)
        if (const int i = place_in_motion[k]; i >= 0)
          stress[k] = -factor(k) * s[i];
    }

    Components
    motion_of(const Model::Vector &t, const double sign)
    {
      Components s;
      for (int k = 0; k < n_spatial; ++k)
        if (const int i = place_in_motion[k]; i >= 0)
          s[i] = sign * (t[k] / factor(k));
      return s;
    }

    /** The history h_k of a point, k = 0, 1, ..., as its state. */
    template <typename History>
    SubloadingState<n_spatial>
    state_of(const Components &s, const History &h)
    {
      SubloadingState<n_spatial> state;
      if (dim == 2)
        state.stress[2] = -h(stress_zz);
      take_stress(s, state.stress);
      for (int k = 0; k < n_spatial; ++k)
        {
          state.a[k]    = -factor(k) * h(centre + k);
          state.beta[k] = factor(k) * h(inclination + k);
        }
      state.pcb = h(size);
      state.Rb  = h(structure);
      return state;
    }

    template <typename History>
    void
    store(const SubloadingState<n_spatial> &state, const History &h)
    {
      if (dim == 2)
        h(stress_zz) = -state.stress[2];
      for (int k = 0; k < n_spatial; ++k)
        {
          const double per_factor = k < 3 ? 1. : 1. / sqrt2;
          h(centre + k)           = -per_factor * state.a[k];
          h(inclination + k)      = per_factor * state.beta[k];
        }
      h(size)      = state.pcb;
      h(structure) = state.Rb;
    }

    using Constants = SubloadingConstants;

    /** A number of the model as a parameter. */
    struct Constant
    {
      const char *name;
      double Constants::*value;
      const char        *documentation;
      bool (*holds)(const Constants &);
      const char *allowed;
      const char *remedy;

      double Constants::*bound = nullptr; ///< whose value ends what is allowed
    };

    /** Apart from the tables, which have the order of the declarations and the checks:
     *  M's bound, which is that of rotational hardening, follows its check. */
    constexpr Constant rotational_hardening = {
      "Rotational hardening rate cbeta",
      &Constants::cbeta,
      "cbeta (-), >= 0; 0: the inclination beta does not change.",
      [](const Constants &c) { return c.cbeta >= 0.; },
      "cbeta >= 0",
      "0 switches it off"};

    constexpr Constant elasticity_and_strength[] = {
      {"Swelling index kappa",
       &Constants::kappa,
       "Slope of swelling lines in ln v over ln p (-), 0 < kappa < lambda. It "
       "is the textbooks' kappa over v.",
       [](const Constants &c) { return c.kappa > 0.; },
       "kappa > 0",
       "clays have 0.005 to 0.05"},
      {"Compression index lambda",
       &Constants::lambda,
       "Slope of compression lines in ln v over ln p (-).",
       [](const Constants &c) { return c.lambda > c.kappa; },
       "lambda > kappa = ",
       "clays have lambda of 4 to 10 times kappa",
       &Constants::kappa},
      {"Poisson ratio",
       &Constants::nu,
       "nu (-), between -1 and 0.5, both excluded.",
       [](const Constants &c) { return c.nu > -1. && c.nu < 0.5; },
       "-1 < nu < 0.5",
       "soils have 0.1 to 0.4"},
      {"Elastic cohesion pe",
       &Constants::pe,
       "pe (Pa), >= 0: the bulk modulus is (p + pe)/kappa.",
       [](const Constants &c) { return c.pe >= 0.; },
       "pe >= 0 Pa",
       "0, or some kPa for stiffness without pressure"},
      {"Apex ratio xi",
       &Constants::xi,
       "xi (-), 0 <= xi < 0.5: the yield surface reaches to the tension p = "
       "-xi pcb.",
       [](const Constants &c) { return c.xi >= 0. && c.xi < 0.5; },
       "0 <= xi < 0.5",
       "0 for soil without tensile strength"},
      {"Yield slope M",
       &Constants::M,
       "M (-), > 0: half axes of the yield ellipsoid, q over p. With "
       "rotational hardening M <= k Mc.",
       [](const Constants &c) { return c.M > 0.; },
       "M > 0",
       "soils have 0.7 to 1.5"},
      {"Critical state slope Mc",
       &Constants::Mc,
       "Mc (-), > 0: q/p at the critical state in triaxial compression, 6 "
       "sin(phi)/(3 - sin(phi)). It acts by rotational hardening only; "
       "without, the critical state is at M.",
       [](const Constants &c) { return c.Mc > 0.; },
       "Mc > 0",
       "6 sin(phi)/(3 - sin(phi)), with the friction angle phi"},
      {"Strength ratio k",
       &Constants::k,
       "k (-), 0.5 < k <= 1: critical state slope in triaxial extension over "
       "that in compression; 3/(3 + Mc) is Mohr-Coulomb's.",
       [](const Constants &c) { return c.k > 0.5 && c.k <= 1.; },
       "0.5 < k <= 1",
       "3/(3 + Mc) is Mohr-Coulomb's"}};

    constexpr Constant flow_and_hardening[] = {
      {"Potential ratio alpha",
       &Constants::alpha,
       "alpha (-), 0 < alpha < sqrt(2): slope of the plastic potential over M; "
       "1 is associated flow.",
       [](const Constants &c) { return c.alpha > 0. && c.alpha < sqrt2; },
       "0 < alpha < sqrt(2)",
       "1 is associated flow"},
      {"Subloading rate cR",
       &Constants::cR,
       "cR (-), > 0: how fast the subloading surface grows to the yield "
       "surface with plastic strain.",
       [](const Constants &c) { return c.cR > 0.; },
       "cR > 0",
       "20 to 1000; the larger, the more like a classical yield surface"},
      rotational_hardening,
      {"Structure loss rate cb",
       &Constants::cb,
       "cb (-), >= 0; 0: the structure ratio does not change.",
       [](const Constants &c) { return c.cb >= 0.; },
       "cb >= 0",
       "0 switches it off"},
      {"Final structure ratio Rbf",
       &Constants::Rbf,
       "Rbf (-), >= 1: what remains of the structure.",
       [](const Constants &c) { return c.Rbf >= 1.; },
       "Rbf >= 1",
       "1: all structure can be lost"},
      {"Similarity centre rate ca",
       &Constants::ca,
       "ca (-), >= 0; 0: the centre moves with the surface only.",
       [](const Constants &c) { return c.ca >= 0.; },
       "ca >= 0",
       "0 switches it off"},
      {"Atmospheric pressure",
       &Constants::patm,
       "Reference pressure of rotational hardening (Pa), > 0.",
       [](const Constants &c) { return c.patm > 0.; },
       "> 0 Pa",
       "1e5 Pa is usual"},
      {"Elastic ratio Rmin",
       &Constants::Rmin,
       "Rmin (-), 0 < Rmin < 1, much less than 1: elastic below it.",
       [](const Constants &c) { return c.Rmin > 0. && c.Rmin < 1.; },
       "0 < Rmin < 1",
       "0.01 is usual"},
      {"Centre margin delta",
       &Constants::delta,
       "delta (-), 0 < delta < 1, much less than 1: how near the similarity "
       "centre comes to the yield surface.",
       [](const Constants &c) { return c.delta > 0. && c.delta < 1.; },
       "0 < delta < 1",
       "0.01 is usual"}};

    constexpr Constant integration[] = {
      {"Error tolerance",
       &Constants::tolerance,
       "Relative error of a substep of the integration (-), 0 < STOL <= 0.1. "
       "Smaller increments need fewer substeps.",
       [](const Constants &c) {
         return c.tolerance > 0. && c.tolerance <= 0.1;
       },
       "0 < STOL <= 0.1",
       "1e-4 is usual"},
      {"Smallest substep",
       &Constants::smallest_substep,
       "Smallest part of an increment (-), > 0 and <= 1; substeps of this size "
       "are accepted with any error, and counted.",
       [](const Constants &c) {
         return c.smallest_substep > 0. && c.smallest_substep <= 1.;
       },
       "> 0 and <= 1",
       "1e-4 is usual"},
      {"Lowest pressure",
       &Constants::lowest_pressure,
       "p + pe is kept at this value or above (Pa), > 0; counted.",
       [](const Constants &c) { return c.lowest_pressure > 0.; },
       "> 0 Pa",
       "1 Pa is usual: without pressure there is no stiffness"}};
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
                     ": the reading of the report's equation (24), sh = s - p "
                     "beta or s - ph beta with ph = p + xi pcb.");
    declare(integration);

    add_parameter("Overconsolidation ratio",
                  ocr,
                  "Size of the yield surface at the start over that of the "
                  "surface through the stress (-); 1: normally consolidated.");
    add_parameter("Initial size pcb",
                  given_size,
                  "Size of the structured yield surface at the start (Pa); 0: "
                  "by the overconsolidation ratio.");
    add_parameter("Smallest size pcb",
                  c.smallest_size,
                  "The yield surface starts at least this large, and does not "
                  "shrink below it (Pa), > 0; counted.");
    add_parameter("Initial centre ratio chi",
                  chi,
                  "chi (-), 0 <= chi < 1: the similarity centre starts at chi "
                  "times the stress.");
    add_parameter(
      "Initial centre",
      given_centre,
      "The similarity centre a at the start instead: xx, yy, zz, xy "
      "(Pa), tension positive; in 3D also yz, zx. Empty: chi times "
      "the stress.");
    add_parameter("Initial anisotropy",
                  given_beta,
                  "Inclination beta at the start: xx, yy, zz, xy (-), of trace "
                  "zero; in 3D also yz, zx.");
    add_parameter(
      "Initial anisotropy by stress",
      zeta,
      "This times s/p of the initial stress is added to the initial "
      "anisotropy (-).");
    add_parameter(
      "Initial structure ratio", initial_Rb, "Rb at the start (-), >= Rbf.");
    add_parameter(
      "Show tensors",
      show_tensors,
      "Whether fields and tables have the components of the "
      "similarity centre a (Pa) and the inclination beta (-), too.");
    if_outside.declare(*this,
                       "Stress outside",
                       ": what to do with an initial stress outside the yield "
                       "surface.");
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
    // a = 0 with xi = 0 is the limit that is allowed.
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

  std::string
  Subloading::initialise(const Stress &stress,
                         const double,
                         double *history) const
  {
    Model::Vector s;
    for (int k = 0; k < n_spatial; ++k)
      s[k] = -factor(k) * stress[k];
    SubloadingState<n_spatial> state;
    const std::string          changed = initial_state<n_spatial>(s, state);
    store(state, [&](const unsigned int k) -> double & { return history[k]; });
    return changed;
  }

  namespace
  {
    /** The turned state and the strain increment of a point. */
    void
    begin(const PointBlock           &block,
          const unsigned int          i,
          SubloadingState<n_spatial> &y,
          Model::Vector              &strain)
    {
      y            = state_of(block.stress(i),
                   [&](const unsigned int k) { return block.history[k][i]; });
      const auto l = block.gradient(i);
      const Spin spin(l);
      const auto turn = [&](Model::Vector &x) {
        Components s = motion_of(x, -1.);
        spin.turn(s);
        take_stress(s, x);
      };
      turn(y.stress);
      turn(y.a);
      turn(y.beta);

      strain = Model::Vector::Zero();
      if (block.l_zz != nullptr)
        strain[2] = -block.l_zz[i];
      for (unsigned int d = 0; d < dim; ++d)
        strain[d] = -l[(dim + 1) * d];
      for (unsigned int k = 0; k < n_shears; ++k)
        {
          const auto [place, a, b] = shears[k];
          strain[3 + k]            = -(l[dim * a + b] + l[dim * b + a]) / sqrt2;
        }
    }

    /** Into a lane, and back. */
    void
    put(const SubloadingState<n_spatial> &y,
        const Model::Vector              &strain,
        const unsigned int                j,
        SubloadingLanes<n_spatial>       &lanes)
    {
      for (int k = 0; k < n_spatial; ++k)
        {
          lanes.stress[k][j] = y.stress[k];
          lanes.a[k][j]      = y.a[k];
          lanes.beta[k][j]   = y.beta[k];
          lanes.strain[k][j] = strain[k];
        }
      lanes.pcb[j] = y.pcb;
      lanes.Rb[j]  = y.Rb;
    }

    void
    take(const SubloadingLanes<n_spatial> &lanes,
         const unsigned int                j,
         SubloadingState<n_spatial>       &y)
    {
      for (int k = 0; k < n_spatial; ++k)
        {
          y.stress[k] = lanes.stress[k][j];
          y.a[k]      = lanes.a[k][j];
          y.beta[k]   = lanes.beta[k][j];
        }
      y.pcb = lanes.pcb[j];
      y.Rb  = lanes.Rb[j];
    }
  } // namespace

  void
  Subloading::advance(const PointBlock &block, LawCounts &counts) const
  {
    counts.updates += block.n_points;
    constexpr unsigned int     n_lanes = SubloadingLanes<n_spatial>::size;
    const Model               &law     = model<n_spatial>();
    SubloadingLanes<n_spatial> lanes;
    SubloadingState<n_spatial> y[n_lanes];
    Model::Vector              strain[n_lanes];
    for (unsigned int first = 0; first < block.n_points; first += n_lanes)
      {
        // Lanes beyond the last point do as it does, and are not asked.
        const unsigned int n = std::min(n_lanes, block.n_points - first);
        for (unsigned int j = 0; j < n_lanes; ++j)
          {
            if (j < n)
              begin(block, first + j, y[j], strain[j]);
            put(y[std::min(j, n - 1)], strain[std::min(j, n - 1)], j, lanes);
          }
        take_single_substeps(law.constants(), lanes);
        for (unsigned int j = 0; j < n; ++j)
          {
            const Model::Vector before = y[j].stress;
            SubloadingReport    report;
            if (lanes.is_done[j])
              {
                report.substeps       = 1;
                report.plastic_strain = lanes.plastic_strain[j];
                take(lanes, j, y[j]);
              }
            else
              report = law.integrate(y[j], strain[j]);
            counts.substeps += report.substeps;
            counts.forced += report.forced;
            counts.limited += report.limited;
            counts.most = std::max(counts.most, report.substeps);

            const unsigned int i      = first + j;
            const auto         stress = y[j].stress;
            block.work[i]             = 0.5 * strain[j].dot(before + stress);
            block.plastic_strain[i] += report.plastic_strain;
            block.wave_modulus[i] =
              law.wave_modulus((stress[0] + stress[1] + stress[2]) / 3.);
            block.set_stress(i, motion_of(stress, -1.));
            store(y[j], [&](const unsigned int k) -> double & {
              return block.history[k][i];
            });
          }
      }
  }

  double
  Subloading::wave_modulus(const Stress &stress, const double *) const
  {
    return model<n_spatial>().wave_modulus(
      -(stress[0] + stress[1] + stress[2]) / 3.);
  }

  SubloadingState<n_spatial>
  Subloading::state(const Components &stress, const double *history) const
  {
    return state_of(stress, [&](const unsigned int k) { return history[k]; });
  }

  std::vector<ConstitutiveLaw::Shown>
  Subloading::shown() const
  {
    std::vector<Shown> all;
    if (dim == 2)
      all.push_back({"stress_zz", "stress zz (Pa)"});
    for (const Shown &shown :
         std::vector<Shown>{{"mean_pressure", "p (Pa)"},
                            {"deviatoric_stress", "q (Pa)"},
                            {"subloading_ratio", "R (-)"},
                            {"structure_ratio", "Rb (-)"},
                            {"yield_surface_size", "pcb (Pa)"},
                            {"anisotropy", "anisotropy (-)"}})
      all.push_back(shown);
    if (show_tensors)
      for (const bool is_centre : {false, true})
        for (int k = 0; k < n_spatial; ++k)
          all.push_back(
            {std::string(is_centre ? "centre_" : "inclination_") + component[k],
             std::string(is_centre ? "a " : "beta ") + component[k] +
               (is_centre ? " (Pa)" : " (-)")});
    return all;
  }

  void
  Subloading::show(const Components &stress,
                   const double     *history,
                   double           *values) const
  {
    const SubloadingState<n_spatial> y = state(stress, history);
    const double p = (y.stress[0] + y.stress[1] + y.stress[2]) / 3.;
    if (dim == 2)
      *values++ = -y.stress[2];
    *values++ = p;
    // sqrt(3/2) ||s|| and the same of beta, a stress ratio q/p.
    *values++ =
      std::sqrt(1.5 * std::max(0., y.stress.squaredNorm() - 3. * p * p));
    *values++ = model<n_spatial>().ratio(y);
    *values++ = y.Rb;
    *values++ = y.pcb;
    *values++ = std::sqrt(1.5) * y.beta.norm();
    if (show_tensors)
      for (const int first : {inclination, centre})
        for (int k = 0; k < n_spatial; ++k)
          *values++ = history[first + k];
  }

  std::vector<YieldCurve>
  Subloading::yield_curves(const Components   &stress,
                           const double       *history,
                           const SectionPlane &plane) const
  {
    return subloading_curves(model<n_spatial>(), state(stress, history), plane);
  }
} // namespace geocone
