// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_cone_kernel_templates_h
#define geocone_kernels_cone_kernel_templates_h

#include <geocone/cone/second_order_cone.h>
#include <geocone/kernels/point_block.h>
#include <geocone/kernels/simd.h>
#include <geocone/kernels/spin.h>

namespace geocone::GEOCONE_DIM
{
  /** Material constants of the kernel advance_cone() in d dimensions. */
  struct ConeConstants
  {
    FlowCone cone;  ///< k and tension over sqrt(d), for mean stress and tau
    double   K;     ///< d lambda + 2 G (Pa)
    double   two_G; ///< (Pa)
    double   wave_modulus;

    /** @name Friction with memory */
    /** @{ */
    double   memory_factor; ///< memory factor lambda of the step
    double   delayed;       ///< lambda (a - b)/sqrt(d)
    unsigned place;         ///< index of p in the history; 0: no memory
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
          const P half(0.5);
          const P xx = P::load(block.l[0] + p), xy = P::load(block.l[1] + p),
                  yx = P::load(block.l[2] + p), yy = P::load(block.l[3] + p);
          trace     = xx + yy;
          strain[0] = xx - yy;
          strain[1] = xy + yx;

          const P sxx = P::load(block.s[0] + p), syy = P::load(block.s[1] + p);
          m    = half * (sxx + syy);
          d[0] = half * (sxx - syy);
          d[1] = P::load(block.s[2] + p);
          PlaneSpin<P>(std::array<P, 4>{{xx, xy, yx, yy}}).turn(d[0], d[1]);
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

  /** Implements the stress update advance_cone() for one SIMD instruction
   *  set. */
  template <typename Arch>
  void
  advance_cone_block(const ConeConstants &cone, const PointBlock &block)
  {
    using P              = Pack<Arch>;
    using Turned         = TurnedStress<P>;
    double *const memory = cone.place > 0 ? block.history[cone.place] : nullptr;
    const P       zero(0.), half(0.5), tiny(1e-300), k(cone.cone.k);
    constexpr double root = dim == 2 ? sqrt2 : 1.73205080756887729353;
    // p >= -k/a, of which lambda mu/sqrt(d) contributes to the radius.
    const P least(-root * cone.cone.tension), delayed(cone.delayed),
      part(cone.memory_factor), kept(root * (1. - cone.memory_factor));
    const P K_part(cone.K / dim), root_of_dim(root), M(cone.wave_modulus);
    const P per_K(1. / cone.K), per_G2(1. / cone.two_G);
    const ConeReturn<P> returns(cone.cone, cone.K, cone.two_G);
    for (unsigned int p = 0; p < block.n_points; p += PointBlock::lanes)
      {
        const Turned turned(block, p);
        const P      t_n = zero - (turned.m + K_part * turned.trace);
        P            trial[Turned::n];
        for (int i = 0; i < Turned::n; ++i)
          trial[i] =
            turned.d[i] + P(Turned::part[i] * cone.two_G) * turned.strain[i];
        const P tau = Turned::norm(trial);
        P       own = k;
        if (memory != nullptr)
          own = k + delayed * max(P::load(memory + p), least);
        const auto end = returns(own, t_n, tau);
        if (memory != nullptr)
          (part * P::load(memory + p) + kept * end.s_n).store(memory + p);

        const P scale = end.radius / max(tau, tiny), m = zero - end.s_n;
        P       work = (turned.m + m) * turned.trace;
        for (int i = 0; i < Turned::n; ++i)
          {
            trial[i] = scale * trial[i];
            work += (turned.d[i] + trial[i]) * turned.strain[i];
          }
        Turned::store(m, trial, block, p);

        const P volumetric = (end.s_n - t_n) * per_K;
        const P deviatoric = (tau - end.radius) * per_G2;
        const P plastic =
          root_of_dim * sqrt(volumetric * volumetric + deviatoric * deviatoric);
        (P::load(block.plastic_strain + p) + plastic)
          .store(block.plastic_strain + p);
        (half * work).store(block.work + p);
        M.store(block.wave_modulus + p);
      }
  }
} // namespace geocone::GEOCONE_DIM

#endif
