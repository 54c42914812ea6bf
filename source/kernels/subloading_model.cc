// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/subloading_body.h>
#include <geocone/kernels/subloading_model.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    template <int n>
    using Body = SubloadingBody<SubloadingState<n>, n>;

    template <typename V>
    double
    trace(const V &x)
    {
      return x[0] + x[1] + x[2];
    }

    /** Advances the stress elastically to the onset of plastic loading.
     *  @return the part of the increment, 0 to 1, that this takes */
    template <int n>
    double
    elastic_part(const Body<n>                             &body,
                 SubloadingState<n>                        &y,
                 const typename Body<n>::Quadratic         &f,
                 const double                               R,
                 const typename SubloadingState<n>::Vector &strain)
    {
      const double volume = trace(strain);
      const auto   path   = body.elastic_path(y, f, R, strain, volume);
      if (!(path.loads < path.end))
        {
          y.stress += path.end * path.e;
          return 1.;
        }
      y.stress += path.loads * path.e;
      return volume == 0.
               ? path.loads / path.end
               : std::log1p(path.loads * volume / (f.pa + f.dp + body.c.pe)) *
                   body.c.kappa / volume;
    }

    /** Limits p + pe from below by the lowest pressure. */
    template <int n>
    void
    limit(const DerivedSubloadingConstants &c,
          SubloadingState<n>               &y,
          SubloadingReport                 &report)
    {
      const double lack = c.lowest_pressure - c.pe - Body<n>::mean(y.stress);
      if (lack > 0.)
        {
          y.stress.template head<3>().array() += lack;
          report.limited = true;
        }
    }
  } // namespace

  template <int n>
  double
  SubloadingModel<n>::ratio(const State &state) const
  {
    return Body<n>(c).quadratic(state).ratio();
  }

  template <int n>
  double
  SubloadingModel<n>::yield_function(const Vector &S,
                                     const Vector &beta,
                                     const double  pcb) const
  {
    State y;
    y.a    = S;
    y.beta = beta;
    y.pcb  = pcb;
    return Body<n>(c).quadratic(y).C;
  }

  template <int n>
  double
  SubloadingModel<n>::size_through(const Vector &stress,
                                   const Vector &beta) const
  {
    // fbar = 0 is A pc^2 + B pc - Q = 0 in the size pc.
    const double p  = trace(stress) / 3.;
    Vector       sh = stress - p * beta;
    sh.template head<3>().array() -= p;
    const double Q = p * p + c.slope * sh.squaredNorm();
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
  SubloadingRates<n>
  SubloadingModel<n>::rates(const State  &y,
                            const double  R,
                            const Vector &strain) const
  {
    return Body<n>(c).template rates<SubloadingRates<n>>(
      y, R, strain, trace(strain));
  }

  template <int n>
  SubloadingReport
  SubloadingModel<n>::integrate(State &y, const Vector &strain) const
  {
    SubloadingReport report;
    if (strain.squaredNorm() == 0.)
      return report;
    const double  volume = trace(strain);
    double        done = 0., size = 1., growth = 2.;
    bool          must_be_plastic = false; // after an elastic part
    const Body<n> body(c);
    auto          f = body.quadratic(y);
    double        R = f.ratio();
    while (done < 1.)
      {
        const double left = 1. - done;
        if (!must_be_plastic &&
            !(R > c.Rmin && body.loading(y, f, R, strain, volume) >= 0.))
          {
            const double part = elastic_part<n>(body, y, f, R, left * strain);
            done              = part == 1. ? 1. : done + part * left;
            limit(c, y, report);
            ++report.substeps;
            must_be_plastic = true;
            f               = body.quadratic(y);
            R               = f.ratio();
            continue;
          }

        // A tiny last substep would cost as much as a full one.
        const bool   last     = size >= left * (1. - 1e-12);
        const double part     = last ? left : size;
        const Vector now      = part * strain;
        const auto   next     = body.substep(y, R, now, trace(now));
        const double error    = std::sqrt(next.error2);
        const bool   possible = next.possible > 0.;
        // States may start above R = 1, by limit() or by force, but must not go
        // further.
        const bool good =
          possible && next.R <= std::max(1.01, R) && error <= c.tolerance;
        if (!good && part > c.smallest_substep * (1. + 1e-9))
          {
            const double factor =
              possible ? 0.9 * std::sqrt(c.tolerance / error) : 0.1;
            size =
              std::max(c.smallest_substep, part * std::clamp(factor, 0.1, 0.9));
            growth = 1.;
            continue;
          }
        ++report.substeps;
        report.forced += !good;
        done = last ? 1. : done + part;
        if (possible)
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
          {
            const auto path = body.elastic_path(y, f, R, now, trace(now));
            y.stress += path.end * path.e;
          }
        limit(c, y, report);
        f = body.quadratic(y);
        R = f.ratio();
      }
    return report;
  }

  template class SubloadingModel<4>;
  template class SubloadingModel<6>;
} // namespace geocone
