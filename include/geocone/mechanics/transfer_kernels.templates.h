// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_transfer_kernels_templates_h
#define geocone_mechanics_transfer_kernels_templates_h

#include <geocone/base/simd.h>
#include <geocone/mechanics/particle_transfer.h>
#include <geocone/mechanics/transfer_kernels.h>

/*
 * The versions of the kernels: a unit per architecture includes this file and
 * instantiates make_transfer_kernels(). Vectors run over the four values of a
 * node, which needs no lists of the points of a cell, or over four points.
 * Everything here is a template over the architecture, or a member of one: a
 * plain inline function might be taken from the unit of another one.
 */
namespace geocone
{
  template <typename Arch>
  struct TransferLoops
  {
    using P = Pack<Arch>;

    /** The functions that live at a place on an axis. */
    template <int p>
    struct Functions
    {
      int    first; ///< the lowest one, among those that are stored
      P      value, slope;
      double N[4], dN[4];

      Functions(const GridAxis &axis, const double x)
      {
        const double u = (x - axis.origin) * axis.inverse_size;
        int          i = static_cast<int>(u);
        i              = i < 0 ? 0 : i;
        i              = i < axis.n_intervals ? i : axis.n_intervals - 1;
        const P       xi(u - i);
        const double *c = axis.coefficients + 4 * (2 * p + 1) * axis.type[i];
        value           = P::load(c + 4 * p);
        slope           = P::load(c + 4 * (2 * p));
        for (int k = p - 1; k >= 0; --k)
          value = value * xi + P::load(c + 4 * k);
        for (int k = 2 * p - 1; k >= p + 1; --k)
          slope = slope * xi + P::load(c + 4 * k);
        value.store(N);
        slope.store(dN);
        first = i - axis.first;
      }
    };

    /** The functions at a point, and the first of its (p + 1)^2 nodes. */
    template <int p>
    struct Nodes
    {
      const Functions<p> X, Y;
      const long         first;

      Nodes(const GridView &grid, const double x, const double y)
        : X(grid.x, x)
        , Y(grid.y, y)
        , first(static_cast<long>(X.first) * grid.stride + Y.first)
      {}
    };

    template <int p, bool with_gradients>
    static void
    gather(const GridView      &view,
           const TransferBlock &points,
           BlockScratch        &scratch)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points.x[k], points.y[k]);
          const double  *node = grid.read + 4 * at.first;
          P              v(0.), v_x(0.), v_y(0.);
          for (int j = 0; j <= p; ++j)
            {
              P row(0.), slope(0.);
              for (int i = 0; i <= p; ++i)
                {
                  const P q = P::load(node + 4 * (i * grid.stride + j));
                  row += q * P(at.X.N[i]);
                  if constexpr (with_gradients)
                    slope += q * P(at.X.dN[i]);
                }
              v += row * P(at.Y.N[j]);
              if constexpr (with_gradients)
                {
                  v_x += slope * P(at.Y.N[j]);
                  v_y += row * P(at.Y.dN[j]);
                }
            }
          double *out = scratch.gathered + 12 * k;
          v.store(out);
          if constexpr (with_gradients)
            {
              v_x.store(out + 4);
              v_y.store(out + 8);
            }
        }
    }

    template <int p>
    static void
    gather_affine(const GridView      &view,
                  const TransferBlock &points,
                  BlockScratch &)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points.x[k], points.y[k]);
          const double  *node = grid.read + 4 * at.first;
          double         wx[p + 1], wy[p + 1];
          moments(grid.x, at.X, points.x[k], wx);
          moments(grid.y, at.Y, points.y[k], wy);
          P c_x(0.), c_y(0.);
          for (int j = 0; j <= p; ++j)
            {
              P row(0.), slope(0.);
              for (int i = 0; i <= p; ++i)
                {
                  const P q = P::load(node + 4 * (i * grid.stride + j));
                  row += q * P(at.X.N[i]);
                  slope += q * P(wx[i]);
                }
              c_x += slope * P(at.Y.N[j]);
              c_y += row * P(wy[j]);
            }
          double column[4];
          c_x.store(column);
          points.c_xx[k] = column[0];
          points.c_yx[k] = column[1];
          c_y.store(column);
          points.c_xy[k] = column[0];
          points.c_yy[k] = column[1];
        }
    }

    /** N_i (x_i - x)/sum_i N_i (x_i - x)^2, or dN_i/dx where that is 0/0. */
    template <int p>
    static void
    moments(const GridAxis     &axis,
            const Functions<p> &functions,
            const double        x,
            double             *weights)
    {
      const double *places = axis.places + axis.first + functions.first;
      double        second = 0.;
      for (int i = 0; i <= p; ++i)
        {
          const double r = places[i] - x;
          weights[i]     = functions.N[i] * r;
          second += weights[i] * r;
        }
      const bool vanishes =
        second * axis.inverse_size * axis.inverse_size < vanishing_moment;
      for (int i = 0; i <= p; ++i)
        weights[i] = vanishes ? functions.dN[i] : weights[i] / second;
    }

    template <int p, bool with_gradients>
    static void
    scatter(const GridView      &view,
            const TransferBlock &points,
            BlockScratch        &scratch)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points.x[k], points.y[k]);
          const double  *in = scratch.given + 12 * k;
          const P a = P::load(in), b = P::load(in + 4), c = P::load(in + 8);
          P       row[p + 1], slope[p + 1];
          for (int j = 0; j <= p; ++j)
            {
              row[j] = a * P(at.Y.N[j]);
              if constexpr (with_gradients)
                {
                  row[j] += c * P(at.Y.dN[j]);
                  slope[j] = b * P(at.Y.N[j]);
                }
            }
          for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= p; ++j)
              {
                double *node =
                  grid.write + 4 * (at.first + i * grid.stride + j);
                P sum = P::load(node) + row[j] * P(at.X.N[i]);
                if constexpr (with_gradients)
                  sum += slope[j] * P(at.X.dN[i]);
                sum.store(node);
              }
          if (grid.mass != nullptr)
            scatter_mass(grid, at, points.mass[k]);
        }
    }

    /** Columns of four functions: beyond the p + 1st, zeros are added. */
    template <int p>
    static void
    scatter_mass(const GridView &grid, const Nodes<p> &at, const double m)
    {
      const P column = at.Y.value * P(m);
      for (int i = 0; i <= p; ++i)
        {
          double *mass = grid.mass + at.first + i * grid.stride;
          (P::load(mass) + column * P(at.X.N[i])).store(mass);
        }
    }

    template <int p>
    static void
    scatter_affine(const GridView      &view,
                   const TransferBlock &points,
                   BlockScratch &)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points.x[k], points.y[k]);
          const double  *places_x = grid.x.places + grid.x.first + at.X.first;
          const double  *places_y = grid.y.places + grid.y.first + at.Y.first;
          const double   m        = points.mass[k];
          for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= p; ++j)
              {
                const double mN = m * at.X.N[i] * at.Y.N[j];
                const double rx = places_x[i] - points.x[k];
                const double ry = places_y[j] - points.y[k];
                double      *node =
                  grid.write + 4 * (at.first + i * grid.stride + j);
                node[0] += mN * (points.c_xx[k] * rx + points.c_xy[k] * ry);
                node[1] += mN * (points.c_yx[k] * rx + points.c_yy[k] * ry);
              }
        }
    }

    static void
    update_points(const Update         update,
                  const double         dt,
                  const double         flip_part,
                  const TransferBlock &points,
                  BlockScratch        &scratch)
    {
      const P h(dt), f(flip_part), pic(1. - flip_part);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const double *in = scratch.gathered + 12 * k;
          if (update.velocity || update.position)
            {
              P vx = P::load(in), vy = P::load(in + 12), dvx = P::load(in + 24),
                dvy = P::load(in + 36);
              transpose(vx, vy, dvx, dvy);
              if (update.velocity)
                {
                  (f * (P::load(points.vx + k) + dvx) + pic * vx)
                    .store(points.vx + k);
                  (f * (P::load(points.vy + k) + dvy) + pic * vy)
                    .store(points.vy + k);
                }
              if (update.position)
                {
                  (P::load(points.x + k) + h * vx).store(points.x + k);
                  (P::load(points.y + k) + h * vy).store(points.y + k);
                }
            }
          if (update.strain)
            {
              P a = P::load(in + 4), b = P::load(in + 16), c = P::load(in + 28),
                d = P::load(in + 40);
              transpose(a, b, c, d);
              (h * a).store(scratch.l_xx + k);
              (h * b).store(scratch.l_yx + k);
              a = P::load(in + 8), b = P::load(in + 20), c = P::load(in + 32),
              d = P::load(in + 44);
              transpose(a, b, c, d);
              (h * a).store(scratch.l_xy + k);
              (h * b).store(scratch.l_yy + k);
            }
        }
    }

    static void
    finish(const TransferBlock &points, BlockScratch &scratch, PassSums &sums)
    {
      P work(0.), speed2(0.), strain(0.), least(1e300);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const P xx = P::load(scratch.l_xx + k),
                  xy = P::load(scratch.l_xy + k),
                  yx = P::load(scratch.l_yx + k),
                  yy = P::load(scratch.l_yy + k);
          const P J  = (P(1.) + xx) * (P(1.) + yy) - xy * yx;
          const P V  = P::load(points.volume + k);
          const P V1 = J * V;
          V1.store(points.volume + k);
          work += P(0.5) * (V + V1) * P::load(scratch.work + k);
          // Points without mass fill up the last block: 1e-300 keeps them quiet.
          speed2 = max(speed2,
                       P::load(scratch.wave_modulus + k) * V1 /
                         max(P::load(points.mass + k), P(1e-300)));
          strain =
            max(strain, max(max(abs(xx), abs(xy)), max(abs(yx), abs(yy))));
          least = min(least, J);
        }
      sums.work += work.sum();
      keep_larger(sums.wave_speed2, speed2.largest());
      keep_larger(sums.strain, strain.largest());
      keep_smaller(sums.least_volume, least.least());
    }

    static void
    bound(const TransferBlock &points, PassSums &sums)
    {
      P speed2(0.), check(0.), x0(1e300), x1(-1e300), y0(1e300), y1(-1e300);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const P x = P::load(points.x + k), y = P::load(points.y + k);
          const P vx = P::load(points.vx + k), vy = P::load(points.vy + k);
          const P v2 = vx * vx + vy * vy;
          speed2     = max(speed2, v2);
          check += v2 + (x + y);
          x0 = min(x0, x), x1 = max(x1, x);
          y0 = min(y0, y), y1 = max(y1, y);
        }
      keep_larger(sums.speed2, speed2.largest());
      sums.check += check.sum();
      keep_smaller(sums.lower[0], x0.least());
      keep_smaller(sums.lower[1], y0.least());
      keep_larger(sums.upper[0], x1.largest());
      keep_larger(sums.upper[1], y1.largest());
    }

    static void
    keep_larger(double &a, const double b)
    {
      a = a > b ? a : b;
    }
    static void
    keep_smaller(double &a, const double b)
    {
      a = a < b ? a : b;
    }

    static void
    prepare_scatter(const bool           momentum,
                    const bool           force,
                    const TransferBlock &points,
                    BlockScratch        &scratch)
    {
      for (unsigned int k = 0; k < points.n; ++k)
        {
          double      *out = scratch.given + 12 * k;
          const double m   = momentum ? points.mass[k] : 0.;
          const double V   = force ? points.volume[k] : 0.;
          out[0]           = m * points.vx[k];
          out[1]           = m * points.vy[k];
          out[6]           = -V * points.s_xx[k];
          out[7]           = -V * points.s_xy[k];
          out[10]          = out[7];
          out[11]          = -V * points.s_yy[k];
        }
    }
  };

  template <typename Arch>
  constexpr TransferKernels
  make_transfer_kernels(const char *name)
  {
    using Loops = TransferLoops<Arch>;
    return {name,
            {nullptr,
             &Loops::template gather<1, true>,
             &Loops::template gather<2, true>,
             &Loops::template gather<3, true>},
            {nullptr,
             &Loops::template gather<1, false>,
             &Loops::template gather<2, false>,
             &Loops::template gather<3, false>},
            {nullptr,
             nullptr,
             &Loops::template gather_affine<2>,
             &Loops::template gather_affine<3>},
            {nullptr,
             &Loops::template scatter<1, true>,
             &Loops::template scatter<2, true>,
             &Loops::template scatter<3, true>},
            {nullptr,
             &Loops::template scatter<1, false>,
             &Loops::template scatter<2, false>,
             &Loops::template scatter<3, false>},
            {nullptr,
             nullptr,
             &Loops::template scatter_affine<2>,
             &Loops::template scatter_affine<3>},
            &Loops::update_points,
            &Loops::finish,
            &Loops::bound,
            &Loops::prepare_scatter};
  }
} // namespace geocone

#endif
