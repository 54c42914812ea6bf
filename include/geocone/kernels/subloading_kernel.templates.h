// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_kernel_templates_h
#define geocone_kernels_subloading_kernel_templates_h

#include <geocone/kernels/simd.h>
#include <geocone/kernels/subloading_body.h>
#include <geocone/kernels/subloading_kernel.h>

#include <array>

namespace geocone
{
  /** State variables of the subloading model at four points. */
  template <typename P, int n>
  struct SubloadingPacks
  {
    std::array<P, n> stress, a, beta;
    P                pcb, Rb;
  };

  /** SIMD integration of the subloading model at four points, with one substep
   *  per point. */
  template <typename P, int n>
  class SubloadingSubstep
  {
  public:
    explicit SubloadingSubstep(const DerivedSubloadingConstants &c)
      : body(c)
    {}

    /** Integrates the constitutive law in a single substep at the four points
     *  stored in the SIMD lanes; see take_single_substeps(). */
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

      const P    zero(0.), one(1.);
      const auto f      = body.quadratic(y);
      const P    R      = f.ratio();
      const P    volume = strain[0] + strain[1] + strain[2];
      // Masks of zeros and ones; NaN counts as zero.
      const P is_loaded =
        Body::is_less(P(body.c.Rmin), R) *
        Body::is_less(zero, body.loading(y, f, R, strain, volume));
      P is_done(0.), plastic_strain(0.);
      if (is_loaded.largest() > 0.)
        {
          const auto next = body.substep(y, R, strain, volume);
          is_done         = is_loaded * is_good(next, R);
          plastic_strain  = next.plastic_strain;
          store(is_done, next.end, lanes);
        }
      if (is_loaded.least() < 1.)
        {
          const auto path = body.elastic_path(y, f, R, strain, volume);
          State      end  = y;
          for (int i = 0; i < n; ++i)
            end.stress[i] = y.stress[i] + path.end * path.e[i];
          const P is_elastic =
            (one - is_loaded) *
            (Body::is_less(path.end, path.loads) *
             Body::is_less(P(body.c.lowest_pressure),
                           Body::mean(end.stress) + P(body.c.pe)));
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
    using State  = SubloadingPacks<P, n>;
    using Body   = SubloadingBody<State, n>;
    using Vector = typename Body::Vector;

    /** Returns 1 if a plastic substep over the full strain increment satisfies
     *  the error tolerance and all limits, otherwise 0. */
    P
    is_good(const typename Body::Substep &next, const P &R) const
    {
      const DerivedSubloadingConstants &c = body.c;
      return next.possible *
             Body::is_less(next.error2, P(c.tolerance * c.tolerance)) *
             Body::is_less(P(c.smallest_size), next.end.pcb) *
             Body::is_less(P(c.lowest_pressure), next.pressure) *
             Body::is_less(next.R, max(P(1.01), R));
    }

    static void
    load(const double (&from)[n][4], Vector &to)
    {
      for (int i = 0; i < n; ++i)
        to[i] = P::load(from[i]);
    }

    /** Stores the results of the SIMD lanes whose substep is accepted (mask
     *  @p accepted = 1). */
    static void
    store(const P &accepted, const P &end, double (&to)[4])
    {
      where_greater(accepted, P(0.), end, P::load(to)).store(to);
    }

    static void
    store(const P &accepted, const State &end, SubloadingLanes<n> &lanes)
    {
      for (int i = 0; i < n; ++i)
        {
          store(accepted, end.stress[i], lanes.stress[i]);
          store(accepted, end.a[i], lanes.a[i]);
          store(accepted, end.beta[i], lanes.beta[i]);
        }
      store(accepted, end.pcb, lanes.pcb);
      store(accepted, end.Rb, lanes.Rb);
    }

    const Body body;
  };

  /** Implements take_single_substeps() for one SIMD instruction set. */
  template <typename Arch, int n>
  void
  take_single_substeps_by(const DerivedSubloadingConstants &c,
                          SubloadingLanes<n>               &lanes)
  {
    SubloadingSubstep<Pack<Arch>, n>{c}(lanes);
  }
} // namespace geocone

#endif
