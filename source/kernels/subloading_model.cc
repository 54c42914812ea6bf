// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/kernels/subloading_model.h>

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

    /** x + y I; complete vectors are added, so that they stay in registers. */
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
     * cos t of the Lode angle t, 0 in triaxial extension and 60 degrees in
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
     *  cancellation; a = 0 is allowed if b < 0. */
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
    f.A  = c.slope * f.sd.squaredNorm() + f.dp * f.dp;
    f.B  = 2. * c.slope * f.sa.dot(f.sd) + f.dp * (2. * ph - y.pcb);
    f.C  = c.slope * f.sa.squaredNorm() + ph * (ph - y.pcb);
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
    return c.slope * sh.squaredNorm() + ph * (ph - pcb);
  }

  template <int n>
  double
  SubloadingModel<n>::size_through(const Vector &stress,
                                   const Vector &beta) const
  {
    // fbar = 0 is A pc^2 + B pc - Q = 0 in the size pc.
    const double p  = mean(stress);
    const Vector sh = plus_isotropic(stress, -p) - p * beta;
    const double Q  = p * p + c.slope * sh.squaredNorm();
    double       A = c.xi * (1. - c.xi), B = (1. - 2. * c.xi) * p;
    if (c.rotates_with_ph)
      {
        A -= c.slope * c.xi * c.xi * beta.squaredNorm();
        B += 2. * c.slope * c.xi * sh.dot(beta);
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
    r.G                     = c.shear_ratio * r.K;
    const double two_G      = 2. * r.G;

    // The gradients N, m = 2 c.slope sh + I/3 (2 ph - pcb - 2 c.slope sh:beta).
    r.sy               = y.a + over * d;
    const double p_sy  = pa + over * (p - pa);
    const double ph    = p_sy + c.xi * y.pcb;
    r.p_y              = c.rotates_with_ph ? ph : p_sy;
    r.sh               = plus_isotropic(r.sy, -p_sy) - r.p_y * y.beta;
    const double sh_sh = r.sh.squaredNorm(), sh_beta = r.sh.dot(y.beta);
    const double along   = 2. * ph - y.pcb;
    const double trace_N = along - 2. * c.slope * sh_beta;
    r.trace_m            = along - 2. * c.phi_slope * sh_beta;
    r.N = plus_isotropic<Vector>(2. * c.slope * r.sh, trace_N / 3.);
    r.m = plus_isotropic<Vector>(2. * c.phi_slope * r.sh, r.trace_m / 3.);
    const double dev_m2 = 4. * c.phi_slope * c.phi_slope * sh_sh;
    r.norm_m            = std::sqrt(dev_m2 + r.trace_m * r.trace_m / 3.);
    // ln 0 at R = Rmin: a value so large that the response is elastic.
    r.U = -c.cR * std::log(std::max(1e-30, (R - c.Rmin) / (1. - c.Rmin)));

    if (c.cbeta > 0.)
      {
        const double norm_s = s.norm();
        // On the axis the direction is undefined.
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
    // Otherwise pcb of soil that has lost all contact would vanish, and the
    // soil could not carry any load when recompressed.
    if (y.pcb <= c.smallest_size)
      r.h_pc = std::max(r.h_pc, 0.);
    const double growth = r.h_pc / y.pcb;

    // The similarity centre moves to st, and with the surface. In (24) beta
    // multiplies p or, by another reading, ph = p + xi pcb.
    const double offset = c.rotates_with_ph ? c.xi * y.pcb : 0.;
    const double half   = (0.5 - c.xi) * y.pcb;
    const Vector centre =
      plus_isotropic<Vector>((half + offset) * y.beta, half);
    r.st               = centre + (1. - c.delta) * (r.sy - centre);
    const Vector to_st = c.ca * r.norm_m * (r.st - y.a);
    r.h_a              = to_st + growth * y.a + (pa + offset) * r.h_beta;

    // f is homogeneous in (sigma, a, pcb) and invariant under the rotation, so
    // that df = 0 gives H with few terms.
    r.H = r.N.dot(growth * y.stress + (p + offset) * r.h_beta +
                  (1. - R) * to_st + (r.U * r.norm_m * over) * d);
    r.N_D_m =
      r.K * trace_N * r.trace_m + two_G * 4. * c.slope * c.phi_slope * sh_sh;
    const double volume = strain[0] + strain[1] + strain[2];
    r.N_D_strain =
      r.K * trace_N * volume + two_G * 2. * c.slope * r.sh.dot(strain);
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
  typename SubloadingModel<n>::Vector
  SubloadingModel<n>::elastic_direction(const Vector &strain) const
  {
    const double volume = strain[0] + strain[1] + strain[2];
    return plus_isotropic<Vector>(2. * c.shear_ratio * strain,
                                  volume * (1. - 2. * c.shear_ratio / 3.));
  }

  template <int n>
  double
  SubloadingModel<n>::elastic_length(const double p, const Vector &strain) const
  {
    const double volume = strain[0] + strain[1] + strain[2];
    return (p + c.pe) * (volume == 0. ? 1. / c.kappa
                                      : std::expm1(volume / c.kappa) / volume);
  }

  template <int n>
  double
  SubloadingModel<n>::elastic_part(State           &y,
                                   const Quadratic &f,
                                   const double     R,
                                   const Vector    &strain) const
  {
    // Along sigma + u e, A = f.A + A1 u + A2 u^2 and B = f.B + B1 u.
    const double volume = strain[0] + strain[1] + strain[2];
    const Vector e      = elastic_direction(strain);
    const Vector se     = deviator(e) - volume * y.beta;
    const double p      = f.pa + f.dp;
    const double A1     = 2. * (c.slope * f.sd.dot(se) + f.dp * volume);
    const double A2     = c.slope * se.squaredNorm() + volume * volume;
    const double B1     = 2. * c.slope * f.sa.dot(se) +
                      volume * (2. * (f.pa + c.xi * y.pcb) - y.pcb);

    // Minimum of R: dA + R dB = 0 with R the root of A + B R + C R^2.
    double u = 0., least = R;
    if (A1 + B1 * R < 0.)
      {
        const double foot = -A1 / (2. * A2);
        least             = positive_root(f.C - B1 * B1 / (4. * A2),
                              f.B + B1 * foot,
                              std::max(0., f.A + A1 * foot / 2.));
        u                 = std::max(0., foot - B1 * least / (2. * A2));
      }
    // Return of R to Rmin, if the minimum is below it.
    if (least < c.Rmin)
      {
        const double b    = A1 + B1 * c.Rmin;
        const double rest = f.A + (f.B + f.C * c.Rmin) * c.Rmin;
        const double root = std::sqrt(std::max(0., b * b - 4. * A2 * rest));
        u = b <= 0. ? (root - b) / (2. * A2) : -2. * rest / (b + root);
      }
    const double whole = elastic_length(p, strain);
    if (!(u < whole))
      {
        y.stress += whole * e;
        return 1.;
      }
    y.stress += u * e;
    return volume == 0.
             ? u / whole
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
  bool
  SubloadingModel<n>::loads(const State     &y,
                            const Quadratic &f,
                            const double     R,
                            const Vector    &strain) const
  {
    if (R <= c.Rmin)
      return false;
    // N:D:de has the sign of dA + R dB along the elastic path.
    const double volume = strain[0] + strain[1] + strain[2];
    const double sd_e = f.sd.dot(strain), sa_e = f.sa.dot(strain);
    const double sd_beta = f.sd.dot(y.beta), sa_beta = f.sa.dot(y.beta);
    return 2. * c.slope *
               (2. * c.shear_ratio * (sd_e + R * sa_e) -
                volume * (sd_beta + R * sa_beta)) +
             volume * (2. * (f.dp + R * (f.pa + c.xi * y.pcb)) - R * y.pcb) >=
           0.;
  }

  template <int n>
  struct SubloadingModel<n>::Substep
  {
    State     end;
    Quadratic f; ///< at the end
    double    R;
    double    error2;   ///< square of the error
    bool      possible; ///< finite and admissible
    double    plastic_strain;
  };

  template <int n>
  typename SubloadingModel<n>::Substep
  SubloadingModel<n>::substep(const State  &y,
                              const double  R,
                              const Vector &strain) const
  {
    Substep      result;
    const auto   first = rates(y, R, strain);
    const State &k     = first.increment;
    State        trial;
    trial.stress          = y.stress + k.stress;
    trial.a               = y.a + k.a;
    trial.beta            = y.beta + k.beta;
    trial.pcb             = y.pcb + k.pcb;
    trial.Rb              = y.Rb + k.Rb;
    const double trial_R  = ratio(trial);
    const auto   second   = rates(trial, trial_R, strain);
    const State &l        = second.increment;
    State       &end      = result.end;
    end.stress            = y.stress + 0.5 * (k.stress + l.stress);
    end.a                 = y.a + 0.5 * (k.a + l.a);
    end.beta              = y.beta + 0.5 * (k.beta + l.beta);
    end.pcb               = y.pcb + 0.5 * (k.pcb + l.pcb);
    end.Rb                = y.Rb + 0.5 * (k.Rb + l.Rb);
    result.f              = quadratic(end);
    result.R              = result.f.ratio();
    const double pressure = result.f.pa + result.f.dp + c.pe;

    const double size2 =
      std::max(end.stress.squaredNorm(), pressure * pressure);
    const auto square = [](const double x) { return x * x; };
    double     sum    = 0.;
    result.error2     = 0.;
    for (const double error2 :
         {0.25 * (l.stress - k.stress).squaredNorm() / size2,
          0.25 * (l.a - k.a).squaredNorm() / size2,
          0.25 * (l.beta - k.beta).squaredNorm(),
          0.25 * square((l.pcb - k.pcb) / end.pcb),
          0.25 * square((l.Rb - k.Rb) / end.Rb),
          square(result.R - trial_R)})
      {
        result.error2 = std::max(result.error2, error2);
        sum += error2; // NaN if one of them is
      }
    // Trial stages can lie far outside, where the rates are meaningless.
    result.possible = first.stable && second.stable && std::isfinite(sum) &&
                      mean(trial.stress) + c.pe > 0. && pressure > 0. &&
                      trial.pcb > 0. && end.pcb > 0.;
    result.plastic_strain =
      0.5 * (first.d_lambda * first.norm_m + second.d_lambda * second.norm_m);
    return result;
  }

  template <int n>
  SubloadingReport
  SubloadingModel<n>::integrate(State &y, const Vector &strain) const
  {
    SubloadingReport report;
    if (strain.squaredNorm() == 0.)
      return report;
    double    done = 0., size = 1., growth = 2.;
    bool      must_be_plastic = false; // after an elastic part
    Quadratic f               = quadratic(y);
    double    R               = f.ratio();
    while (done < 1.)
      {
        const double left = 1. - done;
        if (!must_be_plastic && !loads(y, f, R, strain))
          {
            const double part = elastic_part(y, f, R, left * strain);
            done              = part == 1. ? 1. : done + part * left;
            limit(y, report);
            ++report.substeps;
            must_be_plastic = true;
            f               = quadratic(y);
            R               = f.ratio();
            continue;
          }

        // A tiny last substep would cost as much as a full one.
        const bool    last  = size >= left * (1. - 1e-12);
        const double  part  = last ? left : size;
        const Substep next  = substep(y, R, part * strain);
        const double  error = std::sqrt(next.error2);
        // States may start above R = 1, by limit() or by force, but must not go
        // further.
        const bool good =
          next.possible && next.R <= std::max(1.01, R) && error <= c.tolerance;
        if (!good && part > c.smallest_substep * (1. + 1e-9))
          {
            const double factor =
              next.possible ? 0.9 * std::sqrt(c.tolerance / error) : 0.1;
            size =
              std::max(c.smallest_substep, part * std::clamp(factor, 0.1, 0.9));
            growth = 1.;
            continue;
          }
        ++report.substeps;
        report.forced += !good;
        done = last ? 1. : done + part;
        if (next.possible)
          {
            size = std::max(
              c.smallest_substep,
              part * std::min(0.9 * std::sqrt(c.tolerance / (error + 1e-300)),
                              growth));
            growth          = 2.;
            must_be_plastic = false;
            y               = next.end;
            f               = next.f;
            R               = next.R;
            report.plastic_strain += next.plastic_strain;
            report.limited = report.limited || y.pcb <= c.smallest_size;
            if (f.pa + f.dp + c.pe >= c.lowest_pressure)
              continue;
          }
        else // only the elastic response is left
          y.stress += elastic_length(mean(y.stress), part * strain) *
                      elastic_direction(part * strain);
        limit(y, report);
        f = quadratic(y);
        R = f.ratio();
      }
    return report;
  }

  template class SubloadingModel<4>;
  template class SubloadingModel<6>;
} // namespace geocone
