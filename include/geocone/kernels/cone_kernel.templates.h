// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_cone_kernel_templates_h
#define geocone_kernels_cone_kernel_templates_h

#include <geocone/kernels/point_block.h>
#include <geocone/kernels/simd.h>
#include <geocone/kernels/spin.h>

namespace geocone::GEOCONE_DIM
{
  /** Material constants of the kernel advance_cone() in d dimensions. */
  struct ConeConstants
  {
    double a, b;
    double radius; ///< k/sqrt(d) (Pa)
    double apex;   ///< mean stress at the apex, k/(sqrt(d) a) (Pa), or infinity
    double K;      ///< d lambda + 2 G (Pa)
    double two_G;  ///< (Pa)
    double wave_modulus;

    /** @name Friction with memory */
    /** @{ */
    double   memory_factor = 0.; ///< memory factor lambda of the step
    unsigned place         = 0;  ///< index of p in the history; 0: no memory
    /** @} */
  };

  /**
   * Rotated stresses and strain increments of a group of points (SIMD lanes).
   * The stress of a point is stored as the mean stress m and the deviatoric
   * components d_i, rotated by the spin increment. Elastically, m increases by
   * K/d trace and d_i by 2 G part_i strain_i. The stress work per volume is m
   * trace + sum_i d_i strain_i, and tau^2 = |s_t|^2/d = sum_i weight_i d_i^2.
   * In two dimensions d is ((s_xx - s_yy)/2, s_xy), in three dimensions the
   * deviator in the order of tensor_component.
   */
  template <typename P>
  struct TurnedStress
  {
    static constexpr int    n       = dim == 2 ? 2 : 6;
    static constexpr double part[6] = {
      dim == 2 ? 0.5 : 1., dim == 2 ? 0.5 : 1., 0.5, 1., 0.5, 0.5};
    static constexpr double weight[6] = {
      1. / 3., 1. / 3., 2. / 3., 1. / 3., 2. / 3., 2. / 3.};

    P m, trace, d[n], strain[n];

    /** Reads the stresses and strain increments of consecutive points from a
     *  block, starting at point p. */
    TurnedStress(const PointBlock &block, const unsigned int p)
    {
      if constexpr (dim == 2)
        {
          const P half(0.5), quarter(0.25), one(1.);
          const P xx = P::load(block.l[0] + p), xy = P::load(block.l[1] + p),
                  yx = P::load(block.l[2] + p), yy = P::load(block.l[3] + p);
          trace     = xx + yy;
          strain[0] = xx - yy;
          strain[1] = xy + yx;

          // Rotation by the Cayley transform, tan(angle/2) = spin/2.
          const P t = quarter * (yx - xy), t2 = t * t;
          const P q = one + t2, per_q2 = one / (q * q);
          const P cos2 = (one - t2 * (P(6.) - t2)) * per_q2;
          const P sin2 = P(4.) * t * (one - t2) * per_q2;
          const P sxx = P::load(block.s[0] + p), syy = P::load(block.s[1] + p),
                  sxy        = P::load(block.s[2] + p);
          m                  = half * (sxx + syy);
          const P difference = half * (sxx - syy);
          d[0]               = cos2 * difference - sin2 * sxy;
          d[1]               = sin2 * difference + cos2 * sxy;
        }
      else
        {
          const P          third(1. / 3.);
          std::array<P, 9> l;
          for (int i = 0; i < 9; ++i)
            l[i] = P::load(block.l[i] + p);
          std::array<P, 6> s;
          for (int i = 0; i < 6; ++i)
            s[i] = P::load(block.s[i] + p);
          trace = l[0] + l[4] + l[8];
          m     = third * (s[0] + s[1] + s[3]);
          SpatialSpin<P>(l).turn(s);
          for (int i = 0; i < 3; ++i)
            {
              const int place = index_of_normal[i];
              d[place]        = s[place] - m;
              strain[place]   = l[4 * i] - third * trace;
            }
          for (const auto &[place, a, b] : shears)
            {
              d[place]      = s[place];
              strain[place] = l[3 * a + b] + l[3 * b + a];
            }
        }
    }

    static P
    norm(const P (&d)[n])
    {
      if constexpr (dim == 2)
        return sqrt(d[0] * d[0] + d[1] * d[1]);
      else
        {
          P sum(0.);
          for (int i = 0; i < n; ++i)
            sum += P(weight[i]) * (d[i] * d[i]);
          return sqrt(sum);
        }
    }

    static void
    store(const P &m,
          const P (&d)[n],
          const PointBlock  &block,
          const unsigned int p)
    {
      if constexpr (dim == 2)
        {
          (m + d[0]).store(block.s[0] + p);
          (m - d[0]).store(block.s[1] + p);
          d[1].store(block.s[2] + p);
        }
      else
        for (int i = 0; i < n; ++i)
          (part[i] == 1. ? m + d[i] : d[i]).store(block.s[i] + p);
    }
  };

  /** Implements the stress update advance_cone() for one SIMD instruction set,
   *  with or without friction memory. */
  template <typename Arch, bool has_memory>
  void
  advance_cone_block(const ConeConstants &cone, const PointBlock &block)
  {
    using P = Pack<Arch>;
    // With memory: aperture and radius of the delayed cone.
    const double lagging =
      has_memory ? cone.memory_factor * (cone.a - cone.b) : 0.;
    const double     aperture = cone.a - lagging;
    double *const    memory = has_memory ? block.history[cone.place] : nullptr;
    const P          one(1.), half(0.5), zero(0.), tiny(1e-300);
    const P          a(aperture), b(cone.b), k(cone.radius), apex(cone.apex);
    constexpr double root = dim == 2 ? sqrt2 : 1.73205080756887729353;
    // s_n = -sqrt2 m, of which lambda mu/sqrt2 contributes to the radius.
    const P least(-root * cone.apex), part_of_p(lagging / root),
      part(cone.memory_factor), kept(root * (1. - cone.memory_factor));
    const P K(cone.K), G2(cone.two_G), K_part(cone.K / dim);
    const P per_H(1. / (cone.two_G + aperture * cone.b * cone.K));
    const P per_K(1. / cone.K), per_G2(1. / cone.two_G), M(cone.wave_modulus);
    const P root_of_dim(root);
    using Turned = TurnedStress<P>;
    for (unsigned int p = 0; p < block.n_points; p += PointBlock::lanes)
      {
        const Turned turned(block, p);
        const P      m0 = turned.m, mt = m0 + K_part * turned.trace;
        P            trial[Turned::n];
        for (int i = 0; i < Turned::n; ++i)
          trial[i] =
            turned.d[i] + P(Turned::part[i] * cone.two_G) * turned.strain[i];
        const P tau    = Turned::norm(trial);
        P       radius = k;
        if constexpr (has_memory)
          radius = k + part_of_p * max(P::load(memory + p), least);
        P       f = tau - (radius - a * mt);
        const P g = max(f, zero) * per_H;
        // Smooth part; the apex follows below.
        const P tau_1 = tau - G2 * g;
        P       m1, tau_2;
        if constexpr (has_memory)
          {
            // The cut-off is at the apex of the exact cone.
            const P m = mt - K * b * g;
            tau_2     = where_greater(
              m, apex, min(tau, max(radius - a * apex, zero)), tau_1);
            m1 = min(m, apex);
            f  = max(f, mt - apex);
            (part * P::load(memory + p) - kept * m1).store(memory + p);
          }
        else
          {
            m1    = where_greater(zero, tau_1, apex, mt - K * b * g);
            tau_2 = max(tau_1, zero);
          }
        const P scale = where_greater(f, zero, tau_2 / max(tau, tiny), one);
        P       end[Turned::n];
        P       work = (m0 + m1) * turned.trace;
        for (int i = 0; i < Turned::n; ++i)
          {
            end[i] = scale * trial[i];
            work += (turned.d[i] + end[i]) * turned.strain[i];
          }
        Turned::store(m1, end, block, p);

        const P volumetric = (mt - m1) * per_K;
        const P deviatoric = (tau - tau_2) * per_G2;
        const P plastic =
          root_of_dim * sqrt(volumetric * volumetric + deviatoric * deviatoric);
        (P::load(block.plastic_strain + p) +
         where_greater(f, zero, plastic, zero))
          .store(block.plastic_strain + p);
        (half * work).store(block.work + p);
        M.store(block.wave_modulus + p);
      }
  }

  /** Calls the version of the cone kernel with or without friction memory, as
   *  required. */
  template <typename Arch>
  void
  advance_cone_block(const ConeConstants &cone, const PointBlock &block)
  {
    if (cone.place > 0)
      advance_cone_block<Arch, true>(cone, block);
    else
      advance_cone_block<Arch, false>(cone, block);
  }
} // namespace geocone::GEOCONE_DIM

#endif
