// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_kernel_templates_h
#define geocone_kernels_subloading_kernel_templates_h

#include <geocone/base/simd.h>
#include <geocone/kernels/subloading_kernel.h>

/*
 * SubloadingModel::substep() of several points at once, by the same formulas in
 * the same order, which are explained there.
 */
namespace geocone
{
  template <typename P, int n>
  class SubloadingSubstep
  {
  public:
    explicit SubloadingSubstep(const SubloadingNumbers &c)
      : c(c)
    {}

    /** See take_single_substeps(). */
    void
    operator()(SubloadingLanes<n> &lanes) const
    {
      State  y;
      Vector strain;
      load(lanes.stress, y.stress);
      load(lanes.a, y.a);
      load(lanes.beta, y.beta);
      load(lanes.strain, strain);
      y.pcb = P::load(lanes.pcb);
      y.Rb  = P::load(lanes.Rb);

      const P         zero(0.), one(1.);
      const Quadratic f         = quadratic(y);
      const P         R         = f.ratio();
      const P         volume    = strain[0] + strain[1] + strain[2];
      const P         is_loaded = loads(y, f, R, strain, volume);
      // Masks of zeros and ones; NaN counts as zero.
      P     is_done(0.), plastic_strain(0.);
      State end = y;
      if (is_loaded.largest() > 0.)
        {
          is_done = is_loaded *
                    plastic_substep(y, R, strain, volume, end, plastic_strain);
          store(is_done, end, lanes);
        }
      if (is_loaded.least() < 1.)
        {
          const P is_elastic =
            (one - is_loaded) * elastic_substep(y, f, R, strain, volume, end);
          store(is_elastic, end, lanes);
          plastic_strain =
            where_greater(is_elastic, zero, zero, plastic_strain);
          is_done += is_elastic;
        }
      plastic_strain.store(lanes.plastic_strain);
      double done[4];
      is_done.store(done);
      for (int k = 0; k < 4; ++k)
        lanes.is_done[k] = done[k] > 0.;
    }

  private:
    struct Vector
    {
      P x[n];

      P &
      operator[](const int i)
      {
        return x[i];
      }
      const P &
      operator[](const int i) const
      {
        return x[i];
      }
    };

    struct State
    {
      Vector stress, a, beta;
      P      pcb, Rb;
    };

    /** Root of a x^2 + b x + c = 0, as in SubloadingModel. */
    static P
    positive_root(const P &a, const P &b, const P &c)
    {
      const P zero(0.), root = sqrt(b * b - P(4.) * a * c);
      return where_greater(b,
                           zero,
                           (b + root) / (P(-2.) * a),
                           where_greater(c, zero, (c + c) / (root - b), zero));
    }

    struct Quadratic
    {
      Vector sa, sd;
      P      pa, dp, ph, A, B, C;

      P
      ratio() const
      {
        return positive_root(C, B, A);
      }
    };

    struct Rates
    {
      State increment;
      P     stable, plastic_strain;
    };

    static void
    load(const double (&from)[n][4], Vector &to)
    {
      for (int i = 0; i < n; ++i)
        to[i] = P::load(from[i]);
    }

    /** Stores the lanes with good = 1. */
    static void
    store(const P &good, const P &end, double (&to)[4])
    {
      where_greater(good, P(0.), end, P::load(to)).store(to);
    }

    static void
    store(const P &good, const State &end, SubloadingLanes<n> &lanes)
    {
      for (int i = 0; i < n; ++i)
        {
          store(good, end.stress[i], lanes.stress[i]);
          store(good, end.a[i], lanes.a[i]);
          store(good, end.beta[i], lanes.beta[i]);
        }
      store(good, end.pcb, lanes.pcb);
      store(good, end.Rb, lanes.Rb);
    }

    /** 1 if a < b, otherwise 0. */
    static P
    is_less(const P &a, const P &b)
    {
      return where_greater(b, a, P(1.), P(0.));
    }

    static P
    dot(const Vector &a, const Vector &b)
    {
      P all = a[0] * b[0];
      for (int i = 1; i < n; ++i)
        all += a[i] * b[i];
      return all;
    }

    static P
    distance(const Vector &a, const Vector &b)
    {
      P all(0.);
      for (int i = 0; i < n; ++i)
        {
          const P d = a[i] - b[i];
          all += d * d;
        }
      return all;
    }

    static P
    mean(const Vector &a)
    {
      return P(1. / 3.) * (a[0] + a[1] + a[2]);
    }

    static State
    sum(const State &y, const State &k)
    {
      State end;
      for (int i = 0; i < n; ++i)
        {
          end.stress[i] = y.stress[i] + k.stress[i];
          end.a[i]      = y.a[i] + k.a[i];
          end.beta[i]   = y.beta[i] + k.beta[i];
        }
      end.pcb = y.pcb + k.pcb;
      end.Rb  = y.Rb + k.Rb;
      return end;
    }

    static State
    mean_of(const State &y, const State &k, const State &l)
    {
      const P half(0.5);
      State   end;
      for (int i = 0; i < n; ++i)
        {
          end.stress[i] = y.stress[i] + half * (k.stress[i] + l.stress[i]);
          end.a[i]      = y.a[i] + half * (k.a[i] + l.a[i]);
          end.beta[i]   = y.beta[i] + half * (k.beta[i] + l.beta[i]);
        }
      end.pcb = y.pcb + half * (k.pcb + l.pcb);
      end.Rb  = y.Rb + half * (k.Rb + l.Rb);
      return end;
    }

    Quadratic
    quadratic(const State &y) const
    {
      const P   slope(c.slope);
      Quadratic f;
      f.pa            = mean(y.a);
      f.dp            = mean(y.stress) - f.pa;
      f.ph            = f.pa + P(c.xi) * y.pcb;
      const P turning = c.rotates_with_ph ? f.ph : f.pa;
      for (int i = 0; i < n; ++i)
        {
          f.sa[i] = y.a[i] - turning * y.beta[i];
          f.sd[i] = y.stress[i] - y.a[i] - f.dp * y.beta[i];
          if (i < 3)
            {
              f.sa[i] = f.sa[i] - f.pa;
              f.sd[i] = f.sd[i] - f.dp;
            }
        }
      f.A = slope * dot(f.sd, f.sd) + f.dp * f.dp;
      f.B = P(2.) * slope * dot(f.sa, f.sd) + f.dp * (f.ph + f.ph - y.pcb);
      f.C = slope * dot(f.sa, f.sa) + f.ph * (f.ph - y.pcb);
      return f;
    }

    /** 1 if R > Rmin and N:D:de > 0, otherwise 0. */
    P
    loads(const State     &y,
          const Quadratic &f,
          const P         &R,
          const Vector    &strain,
          const P         &volume) const
    {
      const P two(2.);
      const P N_D_strain =
        two * P(c.slope) *
          (P(2. * c.shear_ratio) * (dot(f.sd, strain) + R * dot(f.sa, strain)) -
           volume * (dot(f.sd, y.beta) + R * dot(f.sa, y.beta))) +
        volume * (two * (f.dp + R * f.ph) - R * y.pcb);
      return is_less(P(c.Rmin), R) * is_less(P(0.), N_D_strain);
    }

    /** 1 if the full increment is one plastic substep, otherwise 0. */
    P
    plastic_substep(const State  &y,
                    const P      &R,
                    const Vector &strain,
                    const P      &volume,
                    State        &end,
                    P            &plastic_strain) const
    {
      const P      zero(0.), one(1.), quarter(0.25);
      const Rates  first   = rates(y, R, strain, volume);
      const State  trial   = sum(y, first.increment);
      const P      trial_R = quadratic(trial).ratio();
      const Rates  second  = rates(trial, trial_R, strain, volume);
      const State &k = first.increment, &l = second.increment;
      end                      = mean_of(y, k, l);
      const Quadratic g        = quadratic(end);
      const P         end_R    = g.ratio();
      const P         pressure = g.pa + g.dp + P(c.pe);
      plastic_strain = P(0.5) * (first.plastic_strain + second.plastic_strain);

      const P per_size2 =
        quarter / max(dot(end.stress, end.stress), pressure * pressure);
      const P of_pcb = (l.pcb - k.pcb) / end.pcb,
              of_Rb  = (l.Rb - k.Rb) / end.Rb;
      const P of_R   = end_R - trial_R;
      P       good   = first.stable * second.stable;
      for (const P &error2 : {per_size2 * distance(l.stress, k.stress),
                              per_size2 * distance(l.a, k.a),
                              quarter * distance(l.beta, k.beta),
                              quarter * of_pcb * of_pcb,
                              quarter * of_Rb * of_Rb,
                              of_R * of_R})
        good *= is_less(error2, P(c.tolerance * c.tolerance));
      good *= is_less(zero, mean(trial.stress) + P(c.pe));
      good *= is_less(zero, trial.pcb) * is_less(P(c.smallest_size), end.pcb);
      good *= is_less(P(c.lowest_pressure), pressure);
      return good * is_less(end_R, max(P(1.01), R));
    }

    /** 1 if the full increment is elastic, otherwise 0; see
     *  SubloadingModel::elastic_part(). */
    P
    elastic_substep(const State     &y,
                    const Quadratic &f,
                    const P         &R,
                    const Vector    &strain,
                    const P         &volume,
                    State           &end) const
    {
      const P zero(0.), half(0.5), one(1.), two(2.), slope(c.slope),
        Rmin(c.Rmin);
      Vector e, se;
      for (int i = 0; i < n; ++i)
        {
          e[i]  = P(2. * c.shear_ratio) * strain[i];
          se[i] = e[i] - volume * y.beta[i];
          if (i < 3)
            {
              e[i] += P(1. - 2. * c.shear_ratio / 3.) * volume;
              se[i] = e[i] - volume - volume * y.beta[i];
            }
        }
      const P A1 = two * (slope * dot(f.sd, se) + f.dp * volume);
      const P A2 = slope * dot(se, se) + volume * volume;
      const P B1 = two * slope * dot(f.sa, se) + volume * (f.ph + f.ph - y.pcb);
      const P per_2A2 = half / A2;

      // Position of the minimum of R, and of its return to Rmin.
      const P inward  = A1 + B1 * R;
      const P foot    = zero - A1 * per_2A2;
      const P nearest = positive_root(f.C - half * B1 * B1 * per_2A2,
                                      f.B + B1 * foot,
                                      max(f.A + half * A1 * foot, zero));
      const P least   = where_greater(zero, inward, nearest, R);
      P       u       = where_greater(
        zero, inward, max(foot - B1 * nearest * per_2A2, zero), zero);
      const P b    = A1 + B1 * Rmin;
      const P rest = f.A + (f.B + f.C * Rmin) * Rmin;
      const P root = sqrt(max(b * b - two * two * A2 * rest, zero));
      const P back = where_greater(
        b, zero, zero - two * rest / (b + root), (root - b) * per_2A2);
      u = where_greater(Rmin, least, back, u);

      const P pressure = f.pa + f.dp + P(c.pe);
      const P whole =
        pressure * where_greater(abs(volume),
                                 zero,
                                 expm1(P(1. / c.kappa) * volume) / volume,
                                 P(1. / c.kappa));
      end = y;
      for (int i = 0; i < n; ++i)
        end.stress[i] = y.stress[i] + whole * e[i];
      return is_less(whole, u) *
             is_less(P(c.lowest_pressure), mean(end.stress) + P(c.pe));
    }

    static P
    cos_lode(const Vector &s, const P &r)
    {
      const P half(0.5), one(1.);
      if constexpr (n == 4)
        {
          const P apart = half * (s[0] - s[1]);
          const P least =
            half * (s[0] + s[1]) - sqrt(apart * apart + half * s[3] * s[3]);
          return min(
            max(P(-1.22474487139158904910) * min(least, s[2]) / r, half), one);
        }
      else
        {
          const P per_root2(0.70710678118654752440);
          const P xy = per_root2 * s[3], yz = per_root2 * s[4],
                  zx  = per_root2 * s[5];
          const P det = s[0] * (s[1] * s[2] - yz * yz) -
                        xy * (xy * s[2] - yz * zx) + zx * (xy * yz - s[1] * zx);
          const P cos_3t = P(-7.34846922834953429459) * det / (r * r * r);
          return cos(P(1. / 3.) * acos(min(max(cos_3t, P(-1.)), one)));
        }
    }

    P
    critical_ratio(const Vector &s, const P &norm_s) const
    {
      P lode(1.);
      if (c.k < 1.)
        {
          const double rest = 1. - c.k * c.k, two_k = 2. * c.k - 1.;
          const P      cos_t = cos_lode(s, norm_s);
          const P      w     = P(4. * rest) * cos_t * cos_t;
          lode               = (P(2. * rest) * cos_t +
                  P(two_k) * sqrt(w + P((5. * c.k - 4.) * c.k))) /
                 (w + P(two_k * two_k));
        }
      const P      Mcs  = P(c.Mc) * lode;
      const double over = 1. / (c.alpha * c.alpha), a = 2. * over - 1.;
      const P      b    = P(over - 1.) * Mcs;
      const P      left = max(P(0.), Mcs * Mcs - P(c.M * c.M));
      return (b + sqrt(b * b + P(a) * left)) * P(1. / a);
    }

    Rates
    rates(const State  &y,
          const P      &R,
          const Vector &strain,
          const P      &volume) const
    {
      const P zero(0.), one(1.), two(2.), third(1. / 3.);
      const P slope(c.slope), phi_slope(c.phi_slope), xi(c.xi), pe(c.pe);
      Rates   r;
      const P p = mean(y.stress), pa = mean(y.a), over = one / R;
      const P K = P(1. / c.kappa) * (p + pe), two_G = P(2. * c.shear_ratio) * K;

      const P p_sy = pa + over * (p - pa), ph = p_sy + xi * y.pcb;
      const P p_y = c.rotates_with_ph ? ph : p_sy;
      Vector  d, sy, sh;
      for (int i = 0; i < n; ++i)
        {
          d[i]  = y.stress[i] - y.a[i];
          sy[i] = y.a[i] + over * d[i];
          sh[i] = sy[i] - p_y * y.beta[i];
          if (i < 3)
            sh[i] = sh[i] - p_sy;
        }
      const P sh_sh = dot(sh, sh), sh_beta = dot(sh, y.beta);
      const P along   = ph + ph - y.pcb;
      const P trace_N = along - two * slope * sh_beta;
      const P trace_m = along - two * phi_slope * sh_beta;
      const P dev_m2  = P(4. * c.phi_slope * c.phi_slope) * sh_sh;
      const P norm_m  = sqrt(dev_m2 + third * trace_m * trace_m);
      const P U =
        P(-c.cR) * log(max(P(1e-30), P(1. / (1. - c.Rmin)) * (R - P(c.Rmin))));

      Vector h_beta;
      if (c.cbeta > 0.)
        {
          Vector s;
          for (int i = 0; i < n; ++i)
            s[i] = i < 3 ? y.stress[i] - p : y.stress[i];
          const P norm_s = sqrt(dot(s, s));
          const P axis   = P(1e-12) * abs(p);
          const P of_s   = where_greater(norm_s,
                                       axis,
                                       P(0.81649658092772603273) *
                                         critical_ratio(s, norm_s) / norm_s,
                                       zero);
          const P rate   = P(c.cbeta / c.patm) * sqrt(dev_m2) * max(p, zero);
          for (int i = 0; i < n; ++i)
            h_beta[i] = rate * (of_s * s[i] - y.beta[i]);
        }
      else
        for (int i = 0; i < n; ++i)
          h_beta[i] = zero;

      const P h_Rb = P(c.cb) * (P(c.Rbf) - y.Rb) * norm_m;
      P       h_pc = (y.pcb + P(c.pe / (1. - c.xi)) * y.Rb) *
                 P(1. / (c.lambda - c.kappa)) * trace_m +
               y.pcb / y.Rb * h_Rb;
      h_pc = where_greater(y.pcb, P(c.smallest_size), h_pc, max(h_pc, zero));
      const P growth = h_pc / y.pcb;

      const P offset     = c.rotates_with_ph ? xi * y.pcb : zero;
      const P half       = P(0.5 - c.xi) * y.pcb;
      const P to_st_rate = P(c.ca) * norm_m, far(1. - c.delta);
      const P turned     = pa + offset;
      const P of_d       = U * norm_m * over;
      Vector  h_a;
      P       H(0.);
      for (int i = 0; i < n; ++i)
        {
          P centre = (half + offset) * y.beta[i];
          if (i < 3)
            centre += half;
          const P st    = centre + far * (sy[i] - centre);
          const P to_st = to_st_rate * (st - y.a[i]);
          h_a[i]        = to_st + growth * y.a[i] + turned * h_beta[i];
          P N           = two * slope * sh[i];
          if (i < 3)
            N += third * trace_N;
          H += N * (growth * y.stress[i] + (p + offset) * h_beta[i] +
                    (one - R) * to_st + of_d * d[i]);
        }
      const P N_D_m =
        K * trace_N * trace_m + two_G * P(4. * c.slope * c.phi_slope) * sh_sh;
      const P N_D_strain =
        K * trace_N * volume + two_G * two * slope * dot(sh, strain);
      const P denominator = N_D_m + H;
      r.stable            = is_less(zero, denominator);
      const P d_lambda    = where_greater(
        N_D_strain, zero, r.stable * (N_D_strain / denominator), zero);
      r.plastic_strain = d_lambda * norm_m;

      State  &k         = r.increment;
      const P mean_part = (K - third * two_G) * (volume - d_lambda * trace_m);
      for (int i = 0; i < n; ++i)
        {
          P m = two * phi_slope * sh[i];
          if (i < 3)
            m += third * trace_m;
          k.stress[i] = two_G * (strain[i] - d_lambda * m);
          if (i < 3)
            k.stress[i] += mean_part;
          k.a[i]    = d_lambda * h_a[i];
          k.beta[i] = d_lambda * h_beta[i];
        }
      k.pcb = d_lambda * h_pc;
      k.Rb  = d_lambda * h_Rb;
      return r;
    }

    const SubloadingNumbers c; ///< a copy, which stores cannot alias
  };
} // namespace geocone

#endif
