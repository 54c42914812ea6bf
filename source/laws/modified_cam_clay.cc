// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/laws/modified_cam_clay.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    SpatialMandel
    deviator(const SpatialMandel &t)
    {
      return t - (trace(t) / 3.) * unit_tensor<n_spatial>();
    }

    /** q of a deviator. */
    double
    equivalent(const SpatialMandel &s)
    {
      return std::sqrt(1.5) * s.norm();
    }

    /** Projection onto deviators. */
    SpatialMandelMatrix
    along_deviators()
    {
      const SpatialMandel I = unit_tensor<n_spatial>();
      return SpatialMandelMatrix::Identity() - I * I.transpose() / 3.;
    }

    /** Initial state and strain of a step. */
    struct StrainStep
    {
      double        P_n, Pc_n; ///< (Pa)
      double        v;         ///< volume strain, compression positive
      SpatialMandel e;         ///< deviator of the strain
      SpatialMandel s_n;       ///< deviator of the stress at t_n (Pa)
    };

    /** (exp(x) - 1)/x. */
    double
    mean_exponential(const double x)
    {
      return x == 0. ? 1. : std::expm1(x) / x;
    }

    /** Derivative of mean_exponential(), by its series where the formula
     *  cancels. */
    double
    mean_exponential_slope(const double x)
    {
      if (std::abs(x) > 0.05)
        return (std::exp(x) * (x - 1.) + 1.) / (x * x);
      double sum = 0.;
      for (const double factor : {5760., 840., 144., 30., 8., 3., 2.})
        sum = sum * x + 1. / factor;
      return sum;
    }

    /**
     * Root of a function that changes sign from - to +, within rounding:
     * Newton's method, with bisection if it leaves the bracket or converges
     * slowly.
     * @param evaluate returns value and slope
     * @return NaN if a value is NaN
     */
    template <typename Function>
    double
    increasing_root(double low, double high, double x, const Function &evaluate)
    {
      for (unsigned int n = 0; n < 200; ++n)
        {
          const auto [value, slope] = evaluate(x);
          if (!std::isfinite(value))
            return std::numeric_limits<double>::quiet_NaN();
          if (value == 0.)
            return x;
          (value < 0. ? low : high) = x;
          double next               = x - value / slope;
          if (std::abs(next - x) <= 1e-14 * std::abs(x))
            return next;
          if (!(next > low && next < high) || (n > 12 && n % 2 == 0))
            next = (low + high) / 2.;
          if (!(next > low && next < high))
            return x;
          x = next;
        }
      return x;
    }
  } // namespace

  ModifiedCamClay::ModifiedCamClay(const std::string &section)
    : SpatialLaw(section, Stiffness::of_state)
  {
    add_parameter("Swelling index kappa",
                  kappa,
                  "Slope kappa of swelling lines in ln v - ln p [-], 0 < kappa "
                  "< lambda: the kappa of textbooks divided by v.");
    add_parameter("Compression index lambda",
                  lambda,
                  "Slope lambda of compression lines in ln v - ln p [-].");
    add_parameter(
      "Critical state slope M",
      M,
      "Stress ratio M = q/p at the critical state [-], > 0: 6 sin(phi)/(3 - "
      "sin(phi)) in triaxial compression, and the same in extension.");
    add_parameter("Attraction",
                  a,
                  "Attraction a [Pa], >= 0: stiffness and strength depend on p "
                  "+ a, so that they do not vanish at zero pressure, e.g. at a "
                  "free surface. Critical state: q = M (p + a).");
    add_parameter("Overconsolidation ratio",
                  ratio,
                  "Initial pc + a over that of the yield surface through the "
                  "initial stress [-], >= 1; 1: normally consolidated.");
    add_parameter(
      "Preconsolidation pressure",
      given_pc,
      "Initial preconsolidation pressure pc [Pa], where the yield surface "
      "intersects q = 0; 0: from the overconsolidation ratio.");
    if_outside.declare(
      *this,
      "Stress outside",
      ": treatment of an initial stress outside the yield surface. Raise size: "
      "the yield surface is enlarged to contain it.");
  }

  void
  ModifiedCamClay::prepare()
  {
    SpatialLaw::prepare();
    require(kappa > 0. && std::isfinite(kappa),
            "Swelling index kappa",
            kappa,
            "kappa > 0",
            "clays have 0.005 to 0.05");
    require(lambda > kappa && std::isfinite(lambda),
            "Compression index lambda",
            lambda,
            "lambda > kappa = " + format("%g", kappa),
            "clays have lambda of 4 to 10 times kappa");
    require(M > 0. && std::isfinite(M),
            "Critical state slope M",
            M,
            "M > 0",
            "soils have 0.7 to 1.5");
    require(a >= 0. && std::isfinite(a),
            "Attraction",
            a,
            "a >= 0 Pa",
            "0, or about 1 kPa where there is a free surface");
    require(ratio >= 1. && std::isfinite(ratio),
            "Overconsolidation ratio",
            ratio,
            ">= 1",
            "1 is normally consolidated, 1 to 3 lightly overconsolidated");
    require(given_pc >= 0. && std::isfinite(given_pc),
            "Preconsolidation pressure",
            given_pc,
            "pc > 0 Pa, or 0",
            "0: by the overconsolidation ratio");
    require(given_pc == 0. || ratio == 1.,
            "Overconsolidation ratio",
            ratio,
            "1 where 'Preconsolidation pressure' is given",
            "give one of them");
    g_over_k = 1.5 * (1. - 2. * poisson()) / (1. + poisson());
    set_elasticity(elasticity_of(1e5));
  }

  ModifiedCamClay::Elastic
  ModifiedCamClay::elastic(const double P_n, const double x) const
  {
    const double y = x / kappa;
    return {P_n * std::exp(y),
            g_over_k * P_n / kappa * mean_exponential(y),
            g_over_k * P_n / (kappa * kappa) * mean_exponential_slope(y)};
  }

  double
  ModifiedCamClay::size_through(const SpatialMandel &stress) const
  {
    const double P = pressure(stress), q = equivalent(deviator(stress));
    return P + q * q / (M * M * P);
  }

  /** Primes in comments are derivatives; those with respect to v are at fixed
   *  phi. */
  struct ModifiedCamClay::Trial
  {
    Trial(const ModifiedCamClay &law, const StrainStep &step, const double phi)
      : M(law.M)
      , cosine(std::cos(phi))
      , sine(std::sin(phi))
    {
      const auto &[P_n, Pc_n, v, e, s_n] = step;
      const double kappa = law.kappa, hardening = law.lambda - kappa;
      const double A    = kappa * hardening / law.lambda;
      w                 = A * (v / kappa + std::log(P_n / Pc_n) -
               2. * std::log(std::cos(phi / 2.)));
      by_v.w            = A / kappa;
      by_phi.w          = A * std::tan(phi / 2.);
      const Elastic now = law.elastic(P_n, v - w);
      P                 = now.P;
      G                 = now.G;
      by_v.P            = P / kappa * (1. - by_v.w);
      by_phi.P          = -P / kappa * by_phi.w;
      by_v.G            = now.slope * (1. - by_v.w);
      by_phi.G          = -now.slope * by_phi.w;
      Pc                = Pc_n * std::exp(w / hardening);
      by_v.Pc           = Pc / hardening * by_v.w;
      by_phi.Pc         = Pc / hardening * by_phi.w;

      // s = rho t with rho = N/D, and q = M Pc sine/2 = rho q_t.
      t            = s_n + 2. * G * e;
      q_t          = equivalent(t);
      const auto c = [&](const double stiffness) {
        return 6. * stiffness / (M * M);
      };
      N     = Pc * cosine;
      D     = w * c(G) + N;
      q_t_G = q_t > 0. ? 3. * t.dot(e) / q_t : 0.;
      for (By *by : {&by_v, &by_phi})
        {
          by->N = by->Pc * cosine - (by == &by_phi ? Pc * sine : 0.);
          by->D = by->w * c(G) + w * c(by->G) + by->N;
        }
      value        = D * M / 2. * sine - q_t * cosine;
      by_v.value   = by_v.D * M / 2. * sine - cosine * q_t_G * by_v.G;
      by_phi.value = by_phi.D * M / 2. * sine - cosine * q_t_G * by_phi.G +
                     D * M / 2. * cosine + q_t * sine;
    }

    /**
     * Solution with plastic flow.
     * @param P,q of the elastic trial stress, q over M (Pa)
     */
    static Trial
    of_flow(const ModifiedCamClay &law,
            const StrainStep      &step,
            const double           P,
            const double           q)
    {
      // The half of the ellipse to which plastic flow leads, bounded by the
      // angle of constant size, beyond which the trial stress is outside.
      const double part      = P / step.Pc_n;
      const bool   contracts = part >= 0.5;
      const double unchanged = part < 1. ? 2. * std::acos(std::sqrt(part)) : 0.;
      const double low   = contracts ? std::min(unchanged, pi / 2.) : pi / 2.,
                   high  = contracts ? pi / 2. : std::max(unchanged, pi / 2.);
      const double guess = std::atan2(q, P - step.Pc_n / 2.);
      const double phi   = increasing_root(
        low,
        high,
        guess >= low && guess <= high ? guess : (low + high) / 2.,
        [&](const double x) {
          const Trial here(law, step, x);
          return std::pair(here.value, here.by_phi.value);
        });
      return Trial(law, step, phi);
    }

    /** Near the critical state N/D is 0/0. */
    bool
    by_quotient() const
    {
      return std::abs(cosine) > 0.5;
    }

    /** rho of s = rho t. */
    double
    factor_of_t() const
    {
      return by_quotient() ? N / D : M * Pc * sine / 2. / q_t;
    }

    /** Tangent ds/de. @param opens whether the pressure is constant */
    SpatialMandelMatrix
    tangent(const SpatialMandel &e, const bool opens) const
    {
      // Gradients with respect to strain: v' = -I, and q_t' = q_t_G
      // G' + normal.
      const double        rho = factor_of_t();
      const SpatialMandel I   = unit_tensor<n_spatial>();
      const SpatialMandel normal =
        q_t > 0. ? SpatialMandel(3. * G / q_t * t) : SpatialMandel::Zero();
      const SpatialMandel of_phi =
        (by_v.value * I + cosine * normal) / by_phi.value;
      const auto gradient = [&](const double x_v, const double x_phi) {
        return SpatialMandel(x_phi * of_phi - x_v * I);
      };
      const SpatialMandel of_P = gradient(by_v.P, by_phi.P),
                          of_G = gradient(by_v.G, by_phi.G);
      SpatialMandel of_rho;
      if (by_quotient())
        of_rho =
          (gradient(by_v.N, by_phi.N) - rho * gradient(by_v.D, by_phi.D)) / D;
      else
        of_rho =
          (M / 2. *
             (sine * gradient(by_v.Pc, by_phi.Pc) + Pc * cosine * of_phi) -
           rho * (q_t_G * of_G + normal)) /
          q_t;
      SpatialMandelMatrix result = 2. * rho * G * along_deviators() +
                                   2. * rho * e * of_G.transpose() +
                                   t * of_rho.transpose();
      if (!opens)
        result -= I * of_P.transpose();
      return result;
    }

    double M;
    double cosine, sine;
    double w;        ///< plastic volume strain, compression positive
    double P, G, Pc; ///< at the end of the step (Pa)
    double N, D;     ///< (Pa)

    SpatialMandel t;          ///< s_n + 2 G e (Pa)
    double        q_t   = 0.; ///< its q (Pa)
    double        q_t_G = 0.; ///< dq_t/dG (-)
    double        value = 0.; ///< zero at the solution (Pa)

    struct By
    {
      double w, P, G, Pc, N, D, value;
    };
    By by_v{}, by_phi{};
  };

  Mode
  ModifiedCamClay::respond(const SpatialMandel &strain,
                           const SpatialMandel &stress_n,
                           const double        *history_n,
                           const StepData &,
                           SpatialMandel       &stress,
                           double              *history,
                           SpatialMandelMatrix *tangent) const
  {
    const SpatialMandel I    = unit_tensor<n_spatial>();
    const StrainStep    step = {pressure(stress_n),
                                history_n[index_of_pc()] + a,
                                -trace(strain),
                                deviator(strain),
                                deviator(stress_n)};
    const auto          set  = [&](const Mode           mode,
                         const SpatialMandel &s,
                         const double         P,
                         const double         Pc) {
      const bool   opens = P < lowest();
      const double q = equivalent(s) / M, least = std::max(P, lowest());
      stress = s - (least - a) * I;
      if (history != nullptr)
        history[index_of_pc()] =
          (opens ? std::max(Pc, least + q * q / least) : Pc) - a;
      return opens ? Mode::apex : mode;
    };

    const Elastic       trial   = elastic(step.P_n, step.v);
    const SpatialMandel t       = step.s_n + 2. * trial.G * step.e;
    const double        q_trial = equivalent(t) / M;
    if (q_trial * q_trial + trial.P * (trial.P - step.Pc_n) <= 0.)
      {
        const Mode mode = set(Mode::elastic, t, trial.P, step.Pc_n);
        if (tangent != nullptr)
          {
            *tangent = 2. * trial.G * along_deviators() -
                       2. * trial.slope * step.e * I.transpose();
            if (mode != Mode::apex)
              *tangent += trial.P / kappa * I * I.transpose();
          }
        return mode;
      }

    const Trial end = Trial::of_flow(*this, step, trial.P, q_trial);
    const Mode mode = set(Mode::cone, end.factor_of_t() * end.t, end.P, end.Pc);
    if (tangent != nullptr)
      *tangent = end.tangent(step.e, mode == Mode::apex);
    return mode;
  }

  double
  ModifiedCamClay::wave_modulus(const Stress &stress, const double *) const
  {
    const double P = a - (stress[0] + stress[1] + stress[2]) / 3.;
    return (1. + 4. / 3. * g_over_k) * P / kappa;
  }

  std::string
  ModifiedCamClay::initialise(const Stress &stress,
                              const double  size,
                              double       *history) const
  {
    SpatialLaw::initialise(stress, size, history);
    SpatialMandel s = SpatialMandel::Zero();
    for (int i = 0; i < 3; ++i)
      s[index_of_normal[i]] = stress[i];
    for (int i = 0; i < n_shears; ++i)
      s[shears[i].place] = sqrt2 * stress[3 + i];
    const double      P  = pressure(s);
    const std::string at = format(" (p = %g Pa)", P - a);
    if (!(P >= lowest()))
      throw InputError(parameter("Attraction"),
                       a,
                       format("p + a >= %g Pa at the start", lowest()) + at,
                       "raise the attraction or the initial pressure: there "
                       "would be no stiffness");
    const double through = size_through(s);
    double       Pc      = given_pc > 0. ? given_pc + a : ratio * through;
    std::string  changed;
    if (Pc < through * (1. - 1e-12))
      {
        if (if_outside == Outside::refuse)
          throw InputError(parameter("Preconsolidation pressure"),
                           given_pc,
                           format(">= %g Pa, where the initial stress is on "
                                  "the yield surface",
                                  through - a) +
                             at,
                           "raise it, or set 'Stress outside = raise size'");
        changed = format("pc was raised from %g to %g Pa: the initial stress "
                         "was outside the yield surface",
                         given_pc,
                         through - a);
        Pc      = through;
      }
    history[index_of_pc()] = Pc - a;
    return changed;
  }

  std::vector<ConstitutiveLaw::OutputQuantity>
  ModifiedCamClay::output_quantities() const
  {
    std::vector<OutputQuantity> all = SpatialLaw::output_quantities();
    all.push_back({"mean_pressure", "p (Pa)"});
    all.push_back({"deviatoric_stress", "q (Pa)"});
    all.push_back({"preconsolidation_pressure", "pc (Pa)"});
    all.push_back({"overconsolidation_ratio", "overconsolidation ratio (-)"});
    return all;
  }

  void
  ModifiedCamClay::output(const Components &stress,
                          const double     *history,
                          double           *values) const
  {
    SpatialLaw::output(stress, history, values);
    values += SpatialLaw::output_quantities().size();
    const SpatialMandel s = whole_stress(mandel_of_components(stress), history);
    values[0]             = -trace(s) / 3.;
    values[1]             = equivalent(deviator(s));
    values[2]             = history[index_of_pc()];
    values[3]             = (values[2] + a) / size_through(s);
  }

  std::optional<double>
  ModifiedCamClay::overstress(const Mandel &stress, const double *history) const
  {
    return size_through(whole_stress(stress, history)) -
           (history[index_of_pc()] + a);
  }

  void
  ModifiedCamClay::reduce_strength(const double)
  {
    throw InputError(parameter("Type"),
                     "modified Cam-Clay",
                     "a law with cohesion and friction where strength is "
                     "divided by a factor",
                     "take Mohr-Coulomb's with the strength that counts");
  }

  SpatialMandel
  ModifiedCamClay::elastic_strain(const SpatialMandel &from,
                                  const SpatialMandel &to,
                                  const double *) const
  {
    const double P_n = pressure(from);
    const double x   = kappa * std::log(pressure(to) / P_n);
    return deviator(SpatialMandel(to - from)) / (2. * elastic(P_n, x).G) -
           x / 3. * unit_tensor<n_spatial>();
  }

  double
  ModifiedCamClay::elastic_energy(const Mandel &stress,
                                  const double *history) const
  {
    const SpatialMandel s = whole_stress(stress, history);
    const double        P = pressure(s), q = equivalent(deviator(s));
    const double        beside = a > 0. ? a * (1. + std::log(P / a)) : 0.;
    return kappa * (P - beside) + q * q * kappa / (6. * g_over_k * P);
  }

  Elasticity
  ModifiedCamClay::elasticity_at(const Mandel &stress,
                                 const double *history) const
  {
    return elasticity_of(pressure(whole_stress(stress, history)));
  }

  std::vector<YieldCurve>
  ModifiedCamClay::yield_curves(const Components &,
                                const double *history,
                                const SectionPlane &) const
  {
    // q^2 = M^2 (p + a) (pc - p)
    const double half = (preconsolidation(history) + attraction()) / 2.;
    YieldCurve   ellipse;
    constexpr unsigned int n_points = 240;
    for (unsigned int i = 0; i <= n_points; ++i)
      {
        const double angle = 2. * pi * i / n_points;
        ellipse.emplace_back(half * (1. + std::cos(angle)) - attraction(),
                             critical_slope() * half * std::sin(angle));
      }
    return {ellipse};
  }
} // namespace geocone::GEOCONE_DIM
