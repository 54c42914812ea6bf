// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_body_h
#define geocone_kernels_subloading_body_h

#include <geocone/base/simd_scalar.h>
#include <geocone/kernels/subloading_constants.h>

#include <type_traits>

namespace geocone
{
  /**
   * Constitutive equations of the subloading model (doc/theory/subloading.md)
   * for one material point or for a group of points (SIMD).
   * @tparam State members stress, a, beta (vectors of n components with [] as
   * in SubloadingState), pcb, Rb (scalars). Scalars are double or Pack;
   * conditions are evaluated without branches (where_greater()) to zero or one.
   */
  template <typename State, int n>
  class SubloadingBody
  {
  public:
    using Vector = decltype(State::stress);
    using Number = decltype(State::pcb);

    explicit SubloadingBody(const DerivedSubloadingConstants &c)
      : c(c)
    {}

    /** Coefficients of the yield function along the ray from the similarity
     *  centre a through the stress sigma: fbar(a + x (sigma - a)) = C + B x + A
     *  x^2. */
    struct Quadratic
    {
      Vector sa, sd; ///< sh at a; sh at sigma minus sh at a (Pa)
      Number pa, dp; ///< p of a; p - pa (Pa)
      Number ph;     ///< shifted pressure of a (Pa)
      Number A, B, C;

      /** Similarity ratio R: positive root of A + B R + C R^2 = 0 with the
       *  coefficients A, B and C. */
      Number
      ratio() const
      {
        return positive_root(C, B, A);
      }
    };

    Quadratic
    quadratic(const State &y) const
    {
      const Number slope(c.slope);
      Quadratic    f;
      f.pa                 = mean(y.a);
      f.dp                 = mean(y.stress) - f.pa;
      f.ph                 = f.pa + Number(c.xi) * y.pcb;
      const Number turning = c.rotates_with_ph ? f.ph : f.pa;
      for (int i = 0; i < n; ++i)
        {
          f.sa[i] = y.a[i] - turning * y.beta[i];
          f.sd[i] = y.stress[i] - y.a[i] - f.dp * y.beta[i];
        }
      for (int i = 0; i < 3; ++i)
        {
          f.sa[i] = f.sa[i] - f.pa;
          f.sd[i] = f.sd[i] - f.dp;
        }
      f.A = slope * dot(f.sd, f.sd) + f.dp * f.dp;
      f.B = Number(2.) * slope * dot(f.sa, f.sd) + f.dp * (f.ph + f.ph - y.pcb);
      f.C = slope * dot(f.sa, f.sa) + f.ph * (f.ph - y.pcb);
      return f;
    }

    /** Loading criterion: positive for plastic loading, with the sign of
     *  N:D:de. The sign is equal to the sign of dA + R dB along the elastic
     *  path. */
    Number
    loading(const State     &y,
            const Quadratic &f,
            const Number    &R,
            const Vector    &strain,
            const Number    &volume) const
    {
      const Number two(2.);
      return two * Number(c.slope) *
               (Number(2. * c.shear_ratio) *
                  (dot(f.sd, strain) + R * dot(f.sa, strain)) -
                volume * (dot(f.sd, y.beta) + R * dot(f.sa, y.beta))) +
             volume * (two * (f.dp + R * f.ph) - R * y.pcb);
    }

    /** Elastic stress path sigma + u e of a strain increment de, with e =
     *  tr(de) I + 2 G/K dev(de). The parameter u increases from 0 to the
     *  integral of K over the strain increment. */
    struct ElasticPath
    {
      Vector e;
      Number loads; ///< u at the onset of plastic loading
      Number end;   ///< u for the full strain increment
    };

    ElasticPath
    elastic_path(const State     &y,
                 const Quadratic &f,
                 const Number    &R,
                 const Vector    &strain,
                 const Number    &volume) const
    {
      const Number zero(0.), half(0.5), two(2.), slope(c.slope), Rmin(c.Rmin);
      ElasticPath  path;
      Vector       se;
      for (int i = 0; i < n; ++i)
        {
          path.e[i] = Number(2. * c.shear_ratio) * strain[i];
          se[i]     = path.e[i] - volume * y.beta[i];
          if (i < 3)
            {
              path.e[i] += Number(1. - 2. * c.shear_ratio / 3.) * volume;
              se[i] = path.e[i] - volume - volume * y.beta[i];
            }
        }
      // Along it, A = f.A + A1 u + A2 u^2 and B = f.B + B1 u.
      const Number A1 = two * (slope * dot(f.sd, se) + f.dp * volume);
      const Number A2 = slope * dot(se, se) + volume * volume;
      const Number B1 =
        two * slope * dot(f.sa, se) + volume * (f.ph + f.ph - y.pcb);
      const Number per_2A2 = half / A2;

      // Minimum of R: dA + R dB = 0 with R the root of A + B R + C R^2.
      const Number inward  = A1 + B1 * R;
      const Number foot    = zero - A1 * per_2A2;
      const Number nearest = positive_root(f.C - half * B1 * B1 * per_2A2,
                                           f.B + B1 * foot,
                                           max(f.A + half * A1 * foot, zero));
      const Number least   = where_greater(zero, inward, nearest, R);
      path.loads           = where_greater(
        zero, inward, max(foot - B1 * nearest * per_2A2, zero), zero);
      // Return of R to Rmin, if the minimum is below it.
      const Number b    = A1 + B1 * Rmin;
      const Number rest = f.A + (f.B + f.C * Rmin) * Rmin;
      const Number root = sqrt(max(b * b - two * two * A2 * rest, zero));
      const Number back = where_greater(
        b, zero, zero - two * rest / (b + root), (root - b) * per_2A2);
      path.loads = where_greater(Rmin, least, back, path.loads);

      path.end = (f.pa + f.dp + Number(c.pe)) *
                 where_greater(abs(volume),
                               zero,
                               expm1(Number(1. / c.kappa) * volume) / volume,
                               Number(1. / c.kappa));
      return path;
    }

    /** Increments of the state variables for a strain increment de at the
     *  similarity ratio R. */
    struct Rates
    {
      State                 increment;
      static constexpr bool has_all = false;

      Number stable; ///< 1 if N:D:m + H > 0, or 0
      Number plastic_strain;
    };

    /** Computes the increments of the state variables for a strain increment.
     *  With Result = SubloadingRates, all intermediate quantities are returned
     *  as well. */
    template <typename Result = Rates>
    Result
    rates(const State  &y,
          const Number &R,
          const Vector &strain,
          const Number &volume) const
    {
      const Number    zero(0.), two(2.), slope(c.slope);
      const Gradients g    = gradients(y, R);
      const Rotation  turn = rotation(y, g);
      const Hardening h    = hardening(y, R, g, turn);
      const Number    N_D_m =
        g.K * g.trace_N * g.trace_m +
        g.two_G * Number(4. * c.slope * c.phi_slope) * g.sh_sh;
      const Number N_D_strain =
        g.K * g.trace_N * volume + g.two_G * two * slope * dot(g.sh, strain);
      const Number denominator = N_D_m + h.H;

      Result r;
      r.stable              = is_less(zero, denominator);
      const Number d_lambda = where_greater(
        N_D_strain, zero, r.stable * (N_D_strain / denominator), zero);
      r.plastic_strain = d_lambda * g.norm_m;

      State       &k = r.increment;
      const Number mean_part =
        (g.K - Number(1. / 3.) * g.two_G) * (volume - d_lambda * g.trace_m);
      for (int i = 0; i < n; ++i)
        {
          k.stress[i] = g.two_G * (strain[i] - d_lambda * h.m[i]);
          k.a[i]      = d_lambda * h.h_a[i];
          k.beta[i]   = d_lambda * turn.h_beta[i];
        }
      for (int i = 0; i < 3; ++i)
        k.stress[i] += mean_part;
      k.pcb = d_lambda * h.h_pc;
      k.Rb  = d_lambda * h.h_Rb;

      if constexpr (Result::has_all)
        {
          r.K = g.K, r.G = c.shear_ratio * g.K, r.p_y = g.p_y, r.U = h.U;
          r.sy = g.sy, r.st = h.st, r.sh = g.sh, r.N = h.N, r.m = h.m;
          r.trace_m = g.trace_m, r.norm_m = g.norm_m;
          r.lode = turn.lode, r.eta_b = turn.eta_b;
          r.h_a = h.h_a, r.h_beta = turn.h_beta, r.h_pc = h.h_pc,
          r.h_Rb = h.h_Rb;
          r.H = h.H, r.N_D_m = N_D_m, r.N_D_strain = N_D_strain;
          r.d_lambda = d_lambda;
        }
      return r;
    }

    /** Result of a substep of the modified Euler method, from the state y over
     *  a strain increment. */
    struct Substep
    {
      State     end;
      Quadratic f; ///< coefficients at the end state
      Number    R, pressure;
      Number    error2;   ///< squared relative error estimate
      Number    possible; ///< 1 if finite and admissible, or 0
      Number    plastic_strain;
    };

    Substep
    substep(const State  &y,
            const Number &R,
            const Vector &strain,
            const Number &volume) const
    {
      const Number zero(0.), quarter(0.25), pe(c.pe);
      Substep      result;
      const Rates  first   = rates(y, R, strain, volume);
      const State  trial   = sum(y, first.increment);
      const Number trial_R = quadratic(trial).ratio();
      const Rates  second  = rates(trial, trial_R, strain, volume);
      const State &k = first.increment, &l = second.increment;
      const State  end = mean_of(y, k, l);
      result.end       = end;
      result.f         = quadratic(end);
      result.R         = result.f.ratio();
      result.pressure  = result.f.pa + result.f.dp + pe;
      result.plastic_strain =
        Number(0.5) * (first.plastic_strain + second.plastic_strain);

      const Number per_size2 = quarter / max(dot(end.stress, end.stress),
                                             result.pressure * result.pressure);
      const Number of_pcb    = (l.pcb - k.pcb) / end.pcb,
                   of_Rb     = (l.Rb - k.Rb) / end.Rb;
      const Number of_R      = result.R - trial_R;
      Number       sum(0.);
      result.error2 = zero;
      for (const Number &error2 : {per_size2 * distance(l.stress, k.stress),
                                   per_size2 * distance(l.a, k.a),
                                   quarter * distance(l.beta, k.beta),
                                   quarter * of_pcb * of_pcb,
                                   quarter * of_Rb * of_Rb,
                                   of_R * of_R})
        {
          result.error2 = max(result.error2, error2);
          sum += error2; // NaN if one of them is
        }
      // Trial stages can lie far outside, where the rates are meaningless.
      result.possible = first.stable * second.stable *
                        is_less(sum, Number(1e300)) *
                        is_less(zero, mean(trial.stress) + pe) *
                        is_less(zero, result.pressure) *
                        is_less(zero, trial.pcb) * is_less(zero, end.pcb);
      return result;
    }

    /** Returns 1 if a < b, otherwise 0. */
    static Number
    is_less(const Number &a, const Number &b)
    {
      return where_greater(b, a, Number(1.), Number(0.));
    }

    static Number
    mean(const Vector &a)
    {
      return Number(1. / 3.) * (a[0] + a[1] + a[2]);
    }

    const DerivedSubloadingConstants
      c; ///< copied, so that stores do not alias it

  private:
    /** Traces, norms and vectors of the gradients N of the yield function and m of the
     *  plastic potential: N, m = 2 slope sh + I/3 (2 ph - pcb - 2 slope sh:beta). */
    struct Gradients
    {
      Number p, pa;    ///< mean of stress and similarity centre (Pa)
      Number K, two_G; ///< tangential moduli (Pa)
      Number over;     ///< 1/R
      Number p_y;      ///< pressure that is multiplied by beta (Pa)
      Vector d;        ///< stress less similarity centre (Pa)
      Vector sy,
        sh; ///< stress on the yield surface, and its deviator from beta (Pa)
      Number sh_sh, trace_N, trace_m;
      Number dev_m2, norm_m; ///< |dev m|^2, |m|
    };

    Gradients
    gradients(const State &y, const Number &R) const
    {
      const Number one(1.), two(2.), slope(c.slope), phi_slope(c.phi_slope);
      Gradients    g;
      g.p = mean(y.stress), g.pa = mean(y.a), g.over = one / R;
      g.K               = Number(1. / c.kappa) * (g.p + Number(c.pe));
      g.two_G           = Number(2. * c.shear_ratio) * g.K;
      const Number p_sy = g.pa + g.over * (g.p - g.pa),
                   ph   = p_sy + Number(c.xi) * y.pcb;
      g.p_y             = c.rotates_with_ph ? ph : p_sy;
      for (int i = 0; i < n; ++i)
        {
          g.d[i]  = y.stress[i] - y.a[i];
          g.sy[i] = y.a[i] + g.over * g.d[i];
          g.sh[i] = g.sy[i] - g.p_y * y.beta[i];
        }
      for (int i = 0; i < 3; ++i)
        g.sh[i] = g.sh[i] - p_sy;
      g.sh_sh              = dot(g.sh, g.sh);
      const Number sh_beta = dot(g.sh, y.beta), along = ph + ph - y.pcb;
      g.trace_N = along - two * slope * sh_beta;
      g.trace_m = along - two * phi_slope * sh_beta;
      g.dev_m2  = Number(4. * c.phi_slope * c.phi_slope) * g.sh_sh;
      g.norm_m  = sqrt(g.dev_m2 + Number(1. / 3.) * g.trace_m * g.trace_m);
      return g;
    }

    /** Rotational hardening: rate of beta, per plastic multiplier. */
    struct Rotation
    {
      Vector h_beta;
      Number lode  = Number(1.); ///< Willam and Warnke's h
      Number eta_b = Number(0.); ///< limit of the stress ratio
    };

    Rotation
    rotation(const State &y, const Gradients &g) const
    {
      const Number zero(0.);
      Rotation     turn;
      if (c.cbeta > 0.)
        {
          Vector s = y.stress;
          for (int i = 0; i < 3; ++i)
            s[i] = s[i] - g.p;
          const Number norm_s = sqrt(dot(s, s));
          // On the axis the direction is undefined.
          const Number axis = Number(1e-12) * abs(g.p);
          if (any_greater(norm_s, axis))
            turn.eta_b = critical_ratio(s, norm_s, turn.lode);
          const Number of_s =
            where_greater(norm_s,
                          axis,
                          Number(0.81649658092772603273) * turn.eta_b / norm_s,
                          zero);
          const Number rate =
            Number(c.cbeta / c.patm) * sqrt(g.dev_m2) * max(g.p, zero);
          for (int i = 0; i < n; ++i)
            turn.h_beta[i] = rate * (of_s * s[i] - y.beta[i]);
        }
      else
        for (int i = 0; i < n; ++i)
          turn.h_beta[i] = zero;
      return turn;
    }

    /** Gradients and rates of the state variables per plastic multiplier, and the
     *  plastic modulus H. */
    struct Hardening
    {
      Number U; ///< rate of R
      Vector st, N, m, h_a;
      Number h_pc, h_Rb, H = Number(0.);
    };

    /** The similarity centre moves to st, and with the surface. In (24) beta multiplies
     *  p or, by another reading, ph = p + xi pcb. f is homogeneous in (sigma, a, pcb)
     *  and invariant under the rotation, so that df = 0 gives H with few terms. */
    Hardening
    hardening(const State     &y,
              const Number    &R,
              const Gradients &g,
              const Rotation  &turn) const
    {
      const Number zero(0.), one(1.), two(2.), third(1. / 3.);
      const Number slope(c.slope), phi_slope(c.phi_slope);
      Hardening    h;
      // ln 0 at R = Rmin: a value so large that the response is elastic.
      h.U = Number(-c.cR) *
            log(max(Number(1e-30),
                    Number(1. / (1. - c.Rmin)) * (R - Number(c.Rmin))));
      h.h_Rb = Number(c.cb) * (Number(c.Rbf) - y.Rb) * g.norm_m;
      h.h_pc = (y.pcb + Number(c.pe / (1. - c.xi)) * y.Rb) *
                 Number(1. / (c.lambda - c.kappa)) * g.trace_m +
               y.pcb / y.Rb * h.h_Rb;
      // Otherwise pcb of soil that has lost all contact would vanish, and the
      // soil could not carry any load when recompressed.
      h.h_pc = where_greater(
        y.pcb, Number(c.smallest_size), h.h_pc, max(h.h_pc, zero));

      const Number growth     = h.h_pc / y.pcb;
      const Number offset     = c.rotates_with_ph ? Number(c.xi) * y.pcb : zero;
      const Number half       = Number(0.5 - c.xi) * y.pcb;
      const Number to_st_rate = Number(c.ca) * g.norm_m, far(1. - c.delta);
      const Number turned     = g.pa + offset;
      const Number of_d       = h.U * g.norm_m * g.over;
      for (int i = 0; i < n; ++i)
        {
          Number centre = (half + offset) * y.beta[i];
          h.N[i]        = two * slope * g.sh[i];
          h.m[i]        = two * phi_slope * g.sh[i];
          if (i < 3)
            {
              centre += half;
              h.N[i] += third * g.trace_N;
              h.m[i] += third * g.trace_m;
            }
          h.st[i]            = centre + far * (g.sy[i] - centre);
          const Number to_st = to_st_rate * (h.st[i] - y.a[i]);
          h.h_a[i] = to_st + growth * y.a[i] + turned * turn.h_beta[i];
          h.H +=
            h.N[i] * (growth * y.stress[i] + (g.p + offset) * turn.h_beta[i] +
                      (one - R) * to_st + of_d * g.d[i]);
        }
      return h;
    }

    /** Largest root of a x^2 + b x + c = 0 for a < 0 <= c, computed without
     *  cancellation. The case a = 0 is allowed if b < 0. */
    static Number
    positive_root(const Number &a, const Number &b, const Number &c)
    {
      const Number zero(0.), root = sqrt(b * b - Number(4.) * a * c);
      return where_greater(b,
                           zero,
                           (b + root) / (Number(-2.) * a),
                           where_greater(c, zero, (c + c) / (root - b), zero));
    }

    static Number
    dot(const Vector &a, const Vector &b)
    {
      if constexpr (std::is_same_v<Number, double>)
        return a.dot(b);
      Number all = a[0] * b[0];
      for (int i = 1; i < n; ++i)
        all += a[i] * b[i];
      return all;
    }

    static Number
    distance(const Vector &a, const Vector &b)
    {
      Number all(0.);
      for (int i = 0; i < n; ++i)
        {
          const Number d = a[i] - b[i];
          all += d * d;
        }
      return all;
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
      const Number half(0.5);
      State        end;
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

    /**
     * Cosine of the Lode angle t of a stress deviator s with the norm r. The
     * angle t is 0 in triaxial extension and 60 degrees in triaxial
     * compression.
     */
    static Number
    cos_lode(const Vector &s, const Number &r)
    {
      const Number half(0.5), one(1.);
      if constexpr (n == 4)
        {
          // s_min = -sqrt(2/3) r cos t, by the principal values in closed form.
          const Number apart = half * (s[0] - s[1]);
          const Number least =
            half * (s[0] + s[1]) - sqrt(apart * apart + half * s[3] * s[3]);
          return min(
            max(Number(-1.22474487139158904910) * min(least, s[2]) / r, half),
            one);
        }
      else
        {
          // cos 3t = -3 sqrt6 det(s)/r^3
          const Number per_root2(0.70710678118654752440);
          const Number xy = per_root2 * s[3], yz = per_root2 * s[4],
                       zx  = per_root2 * s[5];
          const Number det = s[0] * (s[1] * s[2] - yz * yz) -
                             xy * (xy * s[2] - yz * zx) +
                             zx * (xy * yz - s[1] * zx);
          const Number cos_3t =
            Number(-7.34846922834953429459) * det / (r * r * r);
          return cos(Number(1. / 3.) *
                     acos(min(max(cos_3t, Number(-1.)), one)));
        }
    }

    /** Critical-state stress ratio eta_beta,cs in the direction of the stress
     *  deviator s.
     *  @param norm_s norm of s @param[out] lode Willam and Warnke's h */
    Number
    critical_ratio(const Vector &s, const Number &norm_s, Number &lode) const
    {
      if (c.k < 1.)
        {
          // Willam and Warnke 1975: 1 in compression, k in extension.
          const double rest = 1. - c.k * c.k, two_k = 2. * c.k - 1.;
          const Number cos_t = cos_lode(s, norm_s);
          const Number w     = Number(4. * rest) * cos_t * cos_t;
          lode               = (Number(2. * rest) * cos_t +
                  Number(two_k) * sqrt(w + Number((5. * c.k - 4.) * c.k))) /
                 (w + Number(two_k * two_k));
        }
      // The positive root y of
      //   (2/alpha^2 - 1) y^2 - 2 Mcs (1/alpha^2 - 1) y - (Mcs^2 - M^2) = 0:
      // no plastic volume change at the critical state.
      const Number Mcs  = Number(c.Mc) * lode;
      const double over = 1. / (c.alpha * c.alpha), a = 2. * over - 1.;
      const Number b    = Number(over - 1.) * Mcs;
      const Number left = max(Number(0.), Mcs * Mcs - Number(c.M * c.M));
      return (b + sqrt(b * b + Number(a) * left)) * Number(1. / a);
    }
  };
} // namespace geocone

#endif
