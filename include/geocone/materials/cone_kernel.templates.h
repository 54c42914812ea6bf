// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_cone_kernel_templates_h
#define geocone_materials_cone_kernel_templates_h

#include <geocone/base/simd.h>
#include <geocone/materials/point_block.h>

namespace geocone
{
  /** The numbers of advance_cone(). */
  struct ConeNumbers
  {
    double a, b;
    double radius; ///< k/sqrt2 (Pa)
    double apex;   ///< mean stress at the apex, k/(sqrt2 a) (Pa), or infinity
    double K;      ///< 2(lambda + G) (Pa)
    double two_G;  ///< (Pa)
    double wave_modulus;

    /** @name Of friction with memory */
    /** @{ */
    double   part  = 0.; ///< lambda of the step
    unsigned place = 0;  ///< of p in the history; 0: no memory
    /** @} */
  };

  /** advance_cone() for one architecture, with or without memory; see there. */
  template <typename Arch, bool remembers>
  void
  advance_cone_block(const ConeNumbers &cone, const PointBlock &block)
  {
    using P = Pack<Arch>;
    // With memory: a and the radius are those of the delayed cone.
    const double     lagging  = remembers ? cone.part * (cone.a - cone.b) : 0.;
    const double     aperture = cone.a - lagging;
    double *const    memory   = remembers ? block.history[cone.place] : nullptr;
    const P          one(1.), half(0.5), quarter(0.25), zero(0.), tiny(1e-300);
    const P          a(aperture), b(cone.b), k(cone.radius), apex(cone.apex);
    constexpr double root = 1.41421356237309504880;
    // s_n = -sqrt2 m, of which lambda mu/sqrt2 counts for the radius.
    const P least(-root * cone.apex), part_of_p(lagging / root),
      part(cone.part), kept(root * (1. - cone.part));
    const P K(cone.K), G2(cone.two_G), K_half(cone.K / 2.), G(cone.two_G / 2.);
    const P per_H(1. / (cone.two_G + aperture * cone.b * cone.K));
    const P per_K(1. / cone.K), per_G2(1. / cone.two_G), M(cone.wave_modulus);
    const P sqrt_2(root);
    for (unsigned int p = 0; p < block.n_points; p += PointBlock::lanes)
      {
        const P xx = P::load(block.l_xx + p), xy = P::load(block.l_xy + p),
                yx = P::load(block.l_yx + p), yy = P::load(block.l_yy + p);
        const P trace = xx + yy, difference = xx - yy, shear = xy + yx;

        // Turned by the Cayley transform, tan(angle/2) = spin/2.
        const P t = quarter * (yx - xy), t2 = t * t;
        const P q = one + t2, per_q2 = one / (q * q);
        const P cos2 = (one - t2 * (P(6.) - t2)) * per_q2;
        const P sin2 = P(4.) * t * (one - t2) * per_q2;
        const P sxx = P::load(block.s_xx + p), syy = P::load(block.s_yy + p),
                sxy = P::load(block.s_xy + p);
        const P m0 = half * (sxx + syy), d = half * (sxx - syy);
        const P d0 = cos2 * d - sin2 * sxy, s0 = sin2 * d + cos2 * sxy;

        const P mt = m0 + K_half * trace, dt = d0 + G * difference,
                st     = s0 + G * shear;
        const P tau    = sqrt(dt * dt + st * st);
        P       radius = k;
        if constexpr (remembers)
          radius = k + part_of_p * max(P::load(memory + p), least);
        P       f = tau - (radius - a * mt);
        const P g = max(f, zero) * per_H;
        // On the smooth part; beyond it, at the apex.
        const P tau_1 = tau - G2 * g;
        P       m1, tau_2;
        if constexpr (remembers)
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
        const P d1 = scale * dt, s1 = scale * st;

        (m1 + d1).store(block.s_xx + p);
        (m1 - d1).store(block.s_yy + p);
        s1.store(block.s_xy + p);

        const P volumetric = (mt - m1) * per_K;
        const P deviatoric = (tau - tau_2) * per_G2;
        const P plastic =
          sqrt_2 * sqrt(volumetric * volumetric + deviatoric * deviatoric);
        (P::load(block.plastic_strain + p) +
         where_greater(f, zero, plastic, zero))
          .store(block.plastic_strain + p);
        (half *
         ((m0 + m1) * trace + (d0 + d1) * difference + (s0 + s1) * shear))
          .store(block.work + p);
        M.store(block.wave_modulus + p);
      }
  }

  /** The one that the numbers ask for. */
  template <typename Arch>
  void
  advance_cone_block(const ConeNumbers &cone, const PointBlock &block)
  {
    if (cone.place > 0)
      advance_cone_block<Arch, true>(cone, block);
    else
      advance_cone_block<Arch, false>(cone, block);
  }
} // namespace geocone

#endif
