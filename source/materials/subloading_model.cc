// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/types.h>
#include <geocone/materials/subloading_model.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    template <typename V>
    double
    mean(const V &x)
    {
      return (x[0] + x[1] + x[2]) * (1. / 3.);
    }

    /** x + y I; whole vectors are added, which stay in registers. */
    template <typename V>
    V
    plus_isotropic(const V &x, const double y)
    {
      alignas(32) static constexpr double identity[8] = {1., 1., 1.};
      return x + y * Eigen::Map<const V, Eigen::Aligned16>(identity);
    }

    template <typename V>
    V
    deviator(const V &x)
    {
      return plus_isotropic(x, -mean(x));
    }

    /**
     * cos t of Lode's angle t, 0 in triaxial extension and 60 degrees in
     * triaxial compression, of a deviator with the norm r.
     */
    double
    cos_lode(const Eigen::Matrix<double, 4, 1> &s, const double r)
    {
      // s_min = -sqrt(2/3) r cos t, by the principal values in closed form.
      const double half = (s[0] - s[1]) / 2.;
      const double least =
        (s[0] + s[1]) / 2. - std::sqrt(half * half + s[3] * s[3] / 2.);
      return std::clamp(-std::sqrt(1.5) * std::min(least, s[2]) / r, 0.5, 1.);
    }

    double
    cos_lode(const Eigen::Matrix<double, 6, 1> &s, const double r)
    {
      // cos 3t = -3 sqrt6 det(s)/r^3
      const double xy = s[3] / sqrt2, yz = s[4] / sqrt2, zx = s[5] / sqrt2;
      const double det = s[0] * (s[1] * s[2] - yz * yz) -
                         xy * (xy * s[2] - yz * zx) +
                         zx * (xy * yz - s[1] * zx);
      const double cos_3t = -3. * std::sqrt(6.) * det / (r * r * r);
      return std::cos(std::acos(std::clamp(cos_3t, -1., 1.)) / 3.);
    }

    /** Largest root of a x^2 + b x + c = 0 with a < 0 <= c, without
     *  cancellation; a = 0 is allowed where b < 0. */
    double
    positive_root(const double a, const double b, const double c)
    {
      const double root = std::sqrt(b * b - 4. * a * c);
      if (b > 0.)
        return (b + root) / (-2. * a);
      return c > 0. ? 2. * c / (root - b) : 0.;
    }
  } // namespace

  template <int n>
  struct SubloadingModel<n>::Quadratic
  {
    Vector sa, sd; ///< sh at a, and its change to sigma (Pa)
    double pa, dp; ///< p of a; p - pa (Pa)
    double A, B, C;

    double
    ratio() const
    {
      return positive_root(C, B, A);
    }
  };

  template <int n>
  SubloadingModel<n>::SubloadingModel(const SubloadingConstants &constants)
    : c(constants)
    , shear_ratio(3. * (1. - 2. * c.nu) / (2. * (1. + c.nu)))
    , slope(1.5 / (c.M * c.M))
    , phi_slope(slope / (c.alpha * c.alpha))
  {}

  template <int n>
  typename SubloadingModel<n>::Quadratic
  SubloadingModel<n>::quadratic(const State &y) const
  {
    Quadratic f;
    f.pa            = mean(y.a);
    f.dp            = mean(y.stress) - f.pa;
    const double ph = f.pa + c.xi * y.pcb;
    f.sa =
      plus_isotropic(y.a, -f.pa) - (c.rotates_with_ph ? ph : f.pa) * y.beta;
    f.sd = plus_isotropic<Vector>(y.stress - y.a, -f.dp) - f.dp * y.beta;
    f.A  = slope * f.sd.squaredNorm() + f.dp * f.dp;
    f.B  = 2. * slope * f.sa.dot(f.sd) + f.dp * (2. * ph - y.pcb);
    f.C  = slope * f.sa.squaredNorm() + ph * (ph - y.pcb);
    return f;
  }

  template <int n>
  double
  SubloadingModel<n>::ratio(const State &state) const
  {
    return quadratic(state).ratio();
  }

  template <int n>
  double
  SubloadingModel<n>::yield_function(const Vector &S,
                                     const Vector &beta,
                                     const double  pcb) const
  {
    const double p = mean(S), ph = p + c.xi * pcb;
    const Vector sh =
      plus_isotropic(S, -p) - (c.rotates_with_ph ? ph : p) * beta;
    return slope * sh.squaredNorm() + ph * (ph - pcb);
  }

  template <int n>
  double
  SubloadingModel<n>::size_through(const Vector &stress,
                                   const Vector &beta) const
  {
    // fbar = 0 is A pc^2 + B pc - Q = 0 in the size pc.
    const double p  = mean(stress);
    const Vector sh = plus_isotropic(stress, -p) - p * beta;
    const double Q  = p * p + slope * sh.squaredNorm();
    double       A = c.xi * (1. - c.xi), B = (1. - 2. * c.xi) * p;
    if (c.rotates_with_ph)
      {
        A -= slope * c.xi * c.xi * beta.squaredNorm();
        B += 2. * slope * c.xi * sh.dot(beta);
      }
    const double sum = B + std::sqrt(std::max(0., B * B + 4. * A * Q));
    return sum > 0. ? 2. * Q / sum : 0.;
  }

  template <int n>
  double
  SubloadingModel<n>::critical_ratio(const Vector &s,
                                     const double  norm_s,
                                     double       &lode) const
  {
    lode = 1.;
    if (c.k < 1.)
      {
        // Willam and Warnke 1975: 1 in compression, k in extension.
        const double cos_t = cos_lode(s, norm_s);
        const double w     = 4. * (1. - c.k * c.k) * cos_t * cos_t;
        const double two_k = 2. * c.k - 1.;
        lode               = (2. * (1. - c.k * c.k) * cos_t +
                two_k * std::sqrt(w + (5. * c.k - 4.) * c.k)) /
               (w + two_k * two_k);
      }
    // The positive root y of
    //   (2/alpha^2 - 1) y^2 - 2 Mcs (1/alpha^2 - 1) y - (Mcs^2 - M^2) = 0:
    // no plastic volume change at the critical state.
    const double Mcs  = c.Mc * lode;
    const double over = 1. / (c.alpha * c.alpha);
    const double a = 2. * over - 1., b = Mcs * (over - 1.);
    const double left = std::max(0., Mcs * Mcs - c.M * c.M);
    return (b + std::sqrt(b * b + a * left)) / a;
  }

  template <int n>
  SubloadingRates<n>
  SubloadingModel<n>::rates(const State  &y,
                            const double  R,
                            const Vector &strain) const
  {
    SubloadingRates<n> r;
    const double       p = mean(y.stress), pa = mean(y.a);
    const Vector       s    = plus_isotropic(y.stress, -p);
    const Vector       d    = y.stress - y.a;
    const double       over = 1. / R;
    r.K                     = (p + c.pe) / c.kappa;
    r.G                     = shear_ratio * r.K;
    const double two_G      = 2. * r.G;

    // The gradients N, m = 2 slope sh + I/3 (2 ph - pcb - 2 slope sh:beta).
    r.sy               = y.a + over * d;
    const double p_sy  = pa + over * (p - pa);
    const double ph    = p_sy + c.xi * y.pcb;
    r.p_y              = c.rotates_with_ph ? ph : p_sy;
    r.sh               = plus_isotropic(r.sy, -p_sy) - r.p_y * y.beta;
    const double sh_sh = r.sh.squaredNorm(), sh_beta = r.sh.dot(y.beta);
    const double along   = 2. * ph - y.pcb;
    const double trace_N = along - 2. * slope * sh_beta;
    r.trace_m            = along - 2. * phi_slope * sh_beta;
    r.N = plus_isotropic<Vector>(2. * slope * r.sh, trace_N / 3.);
    r.m = plus_isotropic<Vector>(2. * phi_slope * r.sh, r.trace_m / 3.);
    const double dev_m2 = 4. * phi_slope * phi_slope * sh_sh;
    r.norm_m            = std::sqrt(dev_m2 + r.trace_m * r.trace_m / 3.);
    // ln 0 at R = Rmin: a value so large that the response is elastic.
    r.U = -c.cR * std::log(std::max(1e-30, (R - c.Rmin) / (1. - c.Rmin)));

    if (c.cbeta > 0.)
      {
        const double norm_s = s.norm();
        // On the axis there is no direction to turn to.
        if (norm_s > 1e-12 * std::abs(p))
          {
            r.eta_b  = critical_ratio(s, norm_s, r.lode);
            r.h_beta = (std::sqrt(2. / 3.) * r.eta_b / norm_s) * s - y.beta;
          }
        else
          r.h_beta = -y.beta;
        r.h_beta *= c.cbeta * std::sqrt(dev_m2) * std::max(p, 0.) / c.patm;
      }
    else
      r.h_beta.setZero();

    r.h_Rb = c.cb * (c.Rbf - y.Rb) * r.norm_m;
    r.h_pc =
      (y.pcb + y.Rb * c.pe / (1. - c.xi)) / (c.lambda - c.kappa) * r.trace_m +
      y.pcb / y.Rb * r.h_Rb;
    const double growth = r.h_pc / y.pcb;

    // The similarity centre goes to st, and with the surface. What turns with
    // beta is p, or ph = p + xi pcb, by the reading of (24).
    const double offset = c.rotates_with_ph ? c.xi * y.pcb : 0.;
    const double half   = (0.5 - c.xi) * y.pcb;
    const Vector centre =
      plus_isotropic<Vector>((half + offset) * y.beta, half);
    r.st               = centre + (1. - c.delta) * (r.sy - centre);
    const Vector to_st = c.ca * r.norm_m * (r.st - y.a);
    r.h_a              = to_st + growth * y.a + (pa + offset) * r.h_beta;

    // f is homogeneous in (sigma, a, pcb), and the rotation leaves it as it is,
    // so that df = 0 gives H with few terms.
    r.H = r.N.dot(growth * y.stress + (p + offset) * r.h_beta +
                  (1. - R) * to_st + (r.U * r.norm_m * over) * d);
    r.N_D_m =
      r.K * trace_N * r.trace_m + two_G * 4. * slope * phi_slope * sh_sh;
    const double volume = strain[0] + strain[1] + strain[2];
    r.N_D_strain =
      r.K * trace_N * volume + two_G * 2. * slope * r.sh.dot(strain);
    const double denominator = r.N_D_m + r.H;
    r.stable                 = denominator > 0.;
    r.d_lambda =
      r.N_D_strain > 0. && r.stable ? r.N_D_strain / denominator : 0.;

    State       &k       = r.increment;
    const Vector elastic = strain - r.d_lambda * r.m;
    k.stress             = plus_isotropic<Vector>(
      two_G * elastic, (r.K - two_G / 3.) * (volume - r.d_lambda * r.trace_m));
    k.a    = r.d_lambda * r.h_a;
    k.beta = r.d_lambda * r.h_beta;
    k.pcb  = r.d_lambda * r.h_pc;
    k.Rb   = r.d_lambda * r.h_Rb;
    return r;
  }

  template <int n>
  double
  SubloadingModel<n>::elastic_part(State           &y,
                                   const Quadratic &f,
                                   const double     R,
                                   const Vector    &strain) const
  {
    // The elastic path is straight, sigma + u e with u the integral of K; along
    // it A = f.A + A1 u + A2 u^2 and B = f.B + B1 u.
    const double volume = strain[0] + strain[1] + strain[2];
    const Vector e      = plus_isotropic<Vector>(
      2. * shear_ratio * strain, volume * (1. - 2. * shear_ratio / 3.));
    const Vector se = deviator(e) - volume * y.beta;
    const double p = f.pa + f.dp, K = (p + c.pe) / c.kappa;
    const double A1 = 2. * (slope * f.sd.dot(se) + f.dp * volume);
    const double A2 = slope * se.squaredNorm() + volume * volume;
    const double B1 =
      2. * slope * f.sa.dot(se) + volume * (2. * (f.pa + c.xi * y.pcb) - y.pcb);
    const double whole =
      volume == 0. ? K : (p + c.pe) * std::expm1(volume / c.kappa) / volume;

    // Where R is least, dA + R dB = 0 with R the root of A + B R + C R^2.
    double u = 0., least = R;
    if (A1 + B1 * R < 0.)
      {
        const double foot = -A1 / (2. * A2);
        least             = positive_root(f.C - B1 * B1 / (4. * A2),
                              f.B + B1 * foot,
                              std::max(0., f.A + A1 * foot / 2.));
        u                 = foot - B1 * least / (2. * A2);
      }
    // Where R comes back to Rmin, if it is less there.
    if (least < c.Rmin)
      {
        const double b    = A1 + B1 * c.Rmin;
        const double rest = f.A + (f.B + f.C * c.Rmin) * c.Rmin;
        const double root = std::sqrt(std::max(0., b * b - 4. * A2 * rest));
        u = b <= 0. ? (root - b) / (2. * A2) : -2. * rest / (b + root);
      }
    if (!(u < whole))
      {
        y.stress += whole * e;
        return 1.;
      }
    y.stress += u * e;
    return volume == 0.
             ? u / K
             : std::log1p(u * volume / (p + c.pe)) * c.kappa / volume;
  }

  template <int n>
  void
  SubloadingModel<n>::limit(State &y, SubloadingReport &report) const
  {
    const double lack = c.lowest_pressure - c.pe - mean(y.stress);
    if (lack > 0.)
      {
        y.stress       = plus_isotropic(y.stress, lack);
        report.limited = true;
      }
  }

  template <int n>
  SubloadingReport
  SubloadingModel<n>::integrate(State &y, const Vector &strain) const
  {
    SubloadingReport report;
    if (strain.squaredNorm() == 0.)
      return report;
    const double largest2        = c.tolerance * c.tolerance;
    double       done            = 0.;
    double       size            = 1.;
    double       grow            = 2.;
    bool         must_be_plastic = false;
    Quadratic    f               = quadratic(y);
    double       R               = f.ratio();
    while (done < 1.)
      {
        if (!must_be_plastic)
          {
            // N:D:de has the sign of dA + R dB along the elastic path.
            const double volume = strain[0] + strain[1] + strain[2];
            const double sd_e = f.sd.dot(strain), sa_e = f.sa.dot(strain);
            const double beta_d = f.sd.dot(y.beta), beta_a = f.sa.dot(y.beta);
            const double sign =
              2. * slope *
                (2. * shear_ratio * (sd_e + R * sa_e) -
                 volume * (beta_d + R * beta_a)) +
              volume * (2. * (f.dp + R * (f.pa + c.xi * y.pcb)) - R * y.pcb);
            if (R <= c.Rmin || sign < 0.)
              {
                done +=
                  (1. - done) * elastic_part(y, f, R, (1. - done) * strain);
                limit(y, report);
                ++report.substeps;
                must_be_plastic = true;
                f               = quadratic(y);
                R               = f.ratio();
                continue;
              }
          }

        size               = std::min(size, 1. - done);
        const Vector part  = size * strain;
        const auto   first = rates(y, R, part);
        State        trial;
        trial.stress         = y.stress + first.increment.stress;
        trial.a              = y.a + first.increment.a;
        trial.beta           = y.beta + first.increment.beta;
        trial.pcb            = y.pcb + first.increment.pcb;
        trial.Rb             = y.Rb + first.increment.Rb;
        const double trial_R = ratio(trial);
        const auto   second  = rates(trial, trial_R, part);
        State        next;
        next.stress =
          y.stress + 0.5 * (first.increment.stress + second.increment.stress);
        next.a = y.a + 0.5 * (first.increment.a + second.increment.a);
        next.beta =
          y.beta + 0.5 * (first.increment.beta + second.increment.beta);
        next.pcb = y.pcb + 0.5 * (first.increment.pcb + second.increment.pcb);
        next.Rb  = y.Rb + 0.5 * (first.increment.Rb + second.increment.Rb);
        const Quadratic next_f = quadratic(next);
        const double    next_R = next_f.ratio();
        const double    p      = next_f.pa + next_f.dp;

        // The square of the error of this substep.
        const double scale2 =
          std::max(next.stress.squaredNorm(), (p + c.pe) * (p + c.pe));
        const auto half2  = [](const double x) { return 0.25 * x * x; };
        double     error2 = 0., sum = 0.;
        for (const double x :
             {0.25 *
                (second.increment.stress - first.increment.stress)
                  .squaredNorm() /
                scale2,
              0.25 * (second.increment.a - first.increment.a).squaredNorm() /
                scale2,
              0.25 *
                (second.increment.beta - first.increment.beta).squaredNorm(),
              half2((second.increment.pcb - first.increment.pcb) / next.pcb),
              half2((second.increment.Rb - first.increment.Rb) / next.Rb),
              (next_R - trial_R) * (next_R - trial_R)})
          {
            error2 = std::max(error2, x);
            sum += x; // not a number if one of them is not
          }
        const bool possible = first.stable && second.stable &&
                              mean(trial.stress) + c.pe > 0. && p + c.pe > 0. &&
                              trial.pcb > 0. && next.pcb > 0. &&
                              std::isfinite(sum);
        if (!(possible && next_R <= 1.01 && error2 <= largest2))
          {
            if (size > c.smallest_substep)
              {
                const double factor =
                  possible ? 0.9 * std::sqrt(c.tolerance / std::sqrt(error2))
                           : 0.1;
                size = std::max(c.smallest_substep,
                                size * std::clamp(factor, 0.1, 0.9));
                grow = 1.;
                continue;
              }
            ++report.forced;
          }
        ++report.substeps;
        const double step = size;
        if (possible)
          {
            if (done + step < 1.)
              {
                const double error = std::sqrt(error2);
                if (0.9 * std::sqrt(c.tolerance) < grow * std::sqrt(error))
                  size *= 0.9 * std::sqrt(c.tolerance / error);
                else
                  size *= grow;
                size = std::max(size, c.smallest_substep);
              }
            grow = 2.;
            y    = next;
            f    = next_f;
            R    = next_R;
            report.plastic_strain += 0.5 * (first.d_lambda * first.norm_m +
                                            second.d_lambda * second.norm_m);
            must_be_plastic = false;
          }
        else
          {
            // Nothing but the elastic response is left: a forced substep, too.
            const double volume = part[0] + part[1] + part[2];
            const double p0     = mean(y.stress) + c.pe;
            const double u      = volume == 0.
                                    ? p0 / c.kappa
                                    : p0 * std::expm1(volume / c.kappa) / volume;
            y.stress +=
              u * plus_isotropic<Vector>(2. * shear_ratio * part,
                                         volume * (1. - 2. * shear_ratio / 3.));
            f = quadratic(y);
            R = f.ratio();
          }
        // Lands on the end exactly.
        done = 1. - done <= step * (1. + 1e-12) ? 1. : done + step;
        if (p + c.pe < c.lowest_pressure || !possible)
          {
            limit(y, report);
            f = quadratic(y);
            R = f.ratio();
          }
      }
    return report;
  }

  template class SubloadingModel<4>;
  template class SubloadingModel<6>;
} // namespace geocone
