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

    /** The functions that live at a point, the first of its (p + 1)^dim nodes, and
     *  the values of the last direction as they are added to masses. */
    template <int p>
    struct Nodes
    {
      long   first = 0;   ///< among those that are stored
      int    lowest[dim]; ///< functions of the directions, among all
      double N[dim][4], dN[dim][4];
      P      last;

      Nodes(const GridView &grid, const TransferBlock &points, const unsigned k)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            const GridAxis &axis = grid.axes[d];
            const double u = (points.x[d][k] - axis.origin) * axis.inverse_size;
            int          i = static_cast<int>(u);
            i              = i < 0 ? 0 : i;
            i              = i < axis.n_intervals ? i : axis.n_intervals - 1;
            const P       xi(u - i);
            const double *c =
              axis.coefficients + 4 * (2 * p + 1) * axis.type[i];
            P value = P::load(c + 4 * p);
            P slope = P::load(c + 4 * (2 * p));
            for (int power = p - 1; power >= 0; --power)
              value = value * xi + P::load(c + 4 * power);
            for (int power = 2 * p - 1; power >= p + 1; --power)
              slope = slope * xi + P::load(c + 4 * power);
            value.store(N[d]);
            slope.store(dN[d]);
            first += (i - axis.first) * grid.stride[d];
            lowest[d] = i;
            last      = value;
          }
      }

      /** Where the first node has its doubles. */
      const double *
      read(const GridView &grid) const
      {
        return grid.read + node_size * first;
      }
      double *
      write(const GridView &grid) const
      {
        return grid.write + node_size * first;
      }
    };

    /** A sum over the functions of the directions 0 ... d, and its slopes. */
    template <int d>
    struct Sum
    {
      P value = P(0.);
      P slope[d + 1];
      Sum()
      {
        for (P &s : slope)
          s = P(0.);
      }
    };

    /**
     * sum q N over the functions of the directions 0 ... d, q four doubles of a
     * node, and the same with dN in place of N for one direction after the other.
     */
    template <int p, int d, bool with_slopes>
    static Sum<d>
    sum(const GridView &grid,
        const double (&N)[dim][4],
        const double (&dN)[dim][4],
        const double *node)
    {
      Sum<d> all;
      for (int i = 0; i <= p; ++i)
        {
          const double *at = node + node_size * i * grid.stride[d];
          const P       N_i(N[d][i]);
          P             below;
          if constexpr (d == 0)
            below = P::load(at);
          else
            {
              const auto part = sum<p, d - 1, with_slopes>(grid, N, dN, at);
              below           = part.value;
              if constexpr (with_slopes)
                for (int e = 0; e < d; ++e)
                  all.slope[e] += part.slope[e] * N_i;
            }
          all.value += below * N_i;
          if constexpr (with_slopes)
            all.slope[d] += below * P(dN[d][i]);
        }
      return all;
    }

    template <int p, bool with_slopes>
    static void
    gather(const GridView      &view,
           const TransferBlock &points,
           BlockScratch        &scratch)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points, k);
          const double  *node = at.read(grid);
          double        *out  = scratch.gathered + BlockScratch::n_gathered * k;
          const auto     first =
            sum<p, dim - 1, with_slopes>(grid, at.N, at.dN, node);
          first.value.store(out);
          if constexpr (dim == 3)
            sum<p, dim - 1, false>(grid, at.N, at.dN, node + 4)
              .value.store(out + 4);
          if constexpr (with_slopes)
            for (unsigned int d = 0; d < dim; ++d)
              first.slope[d].store(out + node_size + 4 * d);
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
          const Nodes<p> at(grid, points, k);
          double         weights[dim][4];
          for (unsigned int d = 0; d < dim; ++d)
            moments(grid, at, d, points.x[d][k], weights[d]);
          const auto all =
            sum<p, dim - 1, true>(grid, at.N, weights, at.read(grid));
          for (unsigned int d = 0; d < dim; ++d)
            {
              double column[4];
              all.slope[d].store(column);
              for (unsigned int c = 0; c < dim; ++c)
                points.c[dim * c + d][k] = column[c];
            }
        }
    }

    /** N_i (x_i - x)/sum_i N_i (x_i - x)^2, or dN_i/dx where that is 0/0. */
    template <int p>
    static void
    moments(const GridView    &grid,
            const Nodes<p>    &at,
            const unsigned int d,
            const double       x,
            double            *weights)
    {
      const double *x_i    = grid.axes[d].places + at.lowest[d];
      const double  size   = grid.axes[d].inverse_size;
      double        second = 0.;
      for (int i = 0; i <= p; ++i)
        {
          const double r = x_i[i] - x;
          weights[i]     = at.N[d][i] * r;
          second += weights[i] * r;
        }
      const bool vanishes = second * size * size < vanishing_moment;
      for (int i = 0; i <= p; ++i)
        weights[i] = vanishes ? at.dN[d][i] : weights[i] / second;
    }

    /** Adds a N to the functions of the directions 0 ... d, unless there is no a,
     *  and b_e dN for each direction. */
    template <int p, int d, bool has_a, bool has_b>
    static void
    add(const GridView &grid,
        const Nodes<p> &at,
        const P        &a,
        const P        *b,
        double         *node)
    {
      for (int i = 0; i <= p; ++i)
        {
          double *const to = node + node_size * i * grid.stride[d];
          const P       N(at.N[d][i]), dN(at.dN[d][i]);
          if constexpr (d == 0)
            {
              P all = P::load(to);
              if constexpr (has_a)
                all += a * N;
              if constexpr (has_b)
                all += b[0] * dN;
              all.store(to);
            }
          else
            {
              P next, slope[d];
              if constexpr (has_a)
                next = a * N;
              if constexpr (has_a && has_b)
                next += b[d] * dN;
              else if constexpr (has_b)
                next = b[d] * dN;
              if constexpr (has_b)
                for (int e = 0; e < d; ++e)
                  slope[e] = b[e] * N;
              add<p, d - 1, has_a || has_b, has_b>(grid, at, next, slope, to);
            }
        }
    }

    template <int p, bool with_slopes>
    static void
    scatter(const GridView      &view,
            const TransferBlock &points,
            BlockScratch        &scratch)
    {
      const GridView grid = view; // a copy: stores cannot change it
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const Nodes<p> at(grid, points, k);
          const double  *in   = scratch.given + BlockScratch::n_given * k;
          double        *node = at.write(grid);
          const P        a    = P::load(in);
          P              b[dim];
          for (unsigned int d = 0; d < dim; ++d)
            b[d] = P::load(in + 4 + 4 * d);
          if constexpr (dim == 2)
            add<p, dim - 1, true, with_slopes>(grid, at, a, b, node);
          else
            {
              add<p, dim - 1, true, false>(grid, at, a, b, node);
              if constexpr (with_slopes)
                add<p, dim - 1, false, true>(grid, at, a, b, node + 4);
            }
          if (grid.mass != nullptr)
            add_mass<p, 0>(
              grid, at, at.last * P(points.mass[k]), grid.mass + at.first);
        }
    }

    /** Functions of the last direction by four: beyond the p + 1st, zeros are
     *  added. */
    template <int p, int d>
    static void
    add_mass(const GridView &grid,
             const Nodes<p> &at,
             const P        &column,
             double         *mass)
    {
      if constexpr (d == dim - 1)
        (P::load(mass) + column).store(mass);
      else
        for (int i = 0; i <= p; ++i)
          add_mass<p, d + 1>(
            grid, at, column * P(at.N[d][i]), mass + i * grid.stride[d]);
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
          const Nodes<p> at(grid, points, k);
          double         C[dim * dim], r[dim][p + 1];
          for (unsigned int i = 0; i < dim * dim; ++i)
            C[i] = points.c[i][k];
          for (unsigned int d = 0; d < dim; ++d)
            for (int i = 0; i <= p; ++i)
              r[d][i] = grid.axes[d].places[at.lowest[d] + i] - points.x[d][k];
          const double  m    = points.mass[k];
          double *const node = at.write(grid);
          for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= p; ++j)
              {
                const double mN = m * at.N[0][i] * at.N[1][j];
                double      *to =
                  node + node_size * (i * grid.stride[0] + j * grid.stride[1]);
                if constexpr (dim == 2)
                  for (unsigned int c = 0; c < dim; ++c)
                    to[c] +=
                      mN * (C[dim * c] * r[0][i] + C[dim * c + 1] * r[1][j]);
                else
                  for (int l = 0; l <= p; ++l, to += node_size)
                    for (unsigned int c = 0; c < dim; ++c)
                      to[c] +=
                        mN * at.N[2][l] *
                        (C[dim * c] * r[0][i] + C[dim * c + 1] * r[1][j] +
                         C[dim * c + 2] * r[2][l]);
              }
        }
    }

    static void
    find_divergence(const TransferBlock &points, BlockScratch &scratch)
    {
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const double *slopes =
            scratch.gathered + BlockScratch::n_gathered * k + node_size;
          double divergence = 0.;
          for (unsigned int d = 0; d < dim; ++d)
            divergence += slopes[4 * d + d];
          scratch.divergence[k] = divergence;
        }
    }

    static void
    replace_divergence(const double         dt,
                       const TransferBlock &points,
                       BlockScratch        &scratch)
    {
      const P h(dt), part(1. / dim);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          P more = h * P::load(scratch.divergence + k);
          for (unsigned int d = 0; d < dim; ++d)
            more = more - P::load(scratch.l[(dim + 1) * d] + k);
          for (unsigned int d = 0; d < dim; ++d)
            {
              double *const l = scratch.l[(dim + 1) * d] + k;
              (P::load(l) + part * more).store(l);
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
      constexpr unsigned int next = BlockScratch::n_gathered;
      const P                h(dt), f(flip_part), pic(1. - flip_part);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const double *in = scratch.gathered + next * k;
          // Four doubles of four points, as four points of each.
          const auto load = [&](const unsigned int place, P *values) {
            for (unsigned int i = 0; i < 4; ++i)
              values[i] = P::load(in + next * i + place);
            transpose(values[0], values[1], values[2], values[3]);
          };
          if (update.velocity || update.position)
            {
              P v[node_size];
              for (unsigned int place = 0; place < node_size; place += 4)
                load(place, v + place);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  if (update.velocity)
                    (f * (P::load(points.v[d] + k) + v[change_of_node + d]) +
                     pic * v[d])
                      .store(points.v[d] + k);
                  if (update.position)
                    (P::load(points.x[d] + k) + h * v[d])
                      .store(points.x[d] + k);
                }
            }
          if (update.strain)
            for (unsigned int d = 0; d < dim; ++d)
              {
                P slope[4];
                load(node_size + 4 * d, slope);
                for (unsigned int c = 0; c < dim; ++c)
                  (h * slope[c]).store(scratch.l[dim * c + d] + k);
              }
        }
    }

    /** det(I + l) of four points. */
    static P
    volume_ratio(const P (&l)[dim * dim])
    {
      const P one(1.);
      if constexpr (dim == 2)
        return (one + l[0]) * (one + l[3]) - l[1] * l[2];
      else
        {
          const P xx = one + l[0], yy = one + l[4], zz = one + l[8];
          return xx * (yy * zz - l[5] * l[7]) -
                 l[1] * (l[3] * zz - l[5] * l[6]) +
                 l[2] * (l[3] * l[7] - yy * l[6]);
        }
    }

    static void
    finish(const TransferBlock &points, BlockScratch &scratch, PassSums &sums)
    {
      P work(0.), speed2(0.), strain(0.), least(1e300);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          P l[dim * dim];
          for (unsigned int i = 0; i < dim * dim; ++i)
            {
              l[i]   = P::load(scratch.l[i] + k);
              strain = max(strain, abs(l[i]));
            }
          // Nothing, unless around an axis.
          const P zz = P::load(scratch.l_zz + k);
          strain     = max(strain, abs(zz));
          const P J  = volume_ratio(l) * (P(1.) + zz);
          const P V  = P::load(points.volume + k);
          const P V1 = J * V;
          V1.store(points.volume + k);
          work += P(0.5) * (V + V1) * P::load(scratch.work + k);
          // Points without mass fill up the last block: 1e-300 keeps them quiet.
          speed2 = max(speed2,
                       P::load(scratch.wave_modulus + k) * V1 /
                         max(P::load(points.mass + k), P(1e-300)));
          least  = min(least, J);
        }
      sums.work += work.sum();
      keep_larger(sums.wave_speed2, speed2.largest());
      keep_larger(sums.strain, strain.largest());
      keep_smaller(sums.least_volume, least.least());
    }

    static void
    bound(const TransferBlock &points, PassSums &sums)
    {
      P speed2(0.), check(0.), lower[dim], upper[dim];
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = P(1e300);
          upper[d] = P(-1e300);
        }
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          P v2, sum_x;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const P x = P::load(points.x[d] + k);
              const P v = P::load(points.v[d] + k);
              v2        = d == 0 ? v * v : v2 + v * v;
              sum_x     = d == 0 ? x : sum_x + x;
              lower[d]  = min(lower[d], x);
              upper[d]  = max(upper[d], x);
            }
          speed2 = max(speed2, v2);
          check += v2 + sum_x;
        }
      keep_larger(sums.speed2, speed2.largest());
      sums.check += check.sum();
      for (unsigned int d = 0; d < dim; ++d)
        {
          keep_smaller(sums.lower[d], lower[d].least());
          keep_larger(sums.upper[d], upper[d].largest());
        }
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
      // Of the four doubles that slopes are added to, in which forces are.
      constexpr unsigned int forces = change_of_node % 4;
      for (unsigned int k = 0; k < points.n; ++k)
        {
          double      *out = scratch.given + BlockScratch::n_given * k;
          const double m   = momentum ? points.mass[k] : 0.;
          const double V   = force ? points.volume[k] : 0.;
          if constexpr (dim == 2)
            out[forces] = force ? scratch.hoop_force[k] : 0.;
          for (unsigned int c = 0; c < dim; ++c)
            {
              out[c] = m * points.v[c][k];
              for (unsigned int d = 0; d < dim; ++d)
                out[4 + 4 * d + forces + c] =
                  -V * points.s[place_of_component[c][d]][k];
            }
        }
    }

    static void
    replace_mean_stress(const TransferBlock &points, BlockScratch &scratch)
    {
      constexpr unsigned int forces = change_of_node % 4;
      for (unsigned int k = 0; k < points.n; ++k)
        {
          const double V      = points.volume[k];
          double       change = -V * scratch.mean_stress[k];
          for (unsigned int d = 0; d < dim; ++d)
            change += V * points.s[place_of_component[d][d]][k] / dim;
          double *out = scratch.given + BlockScratch::n_given * k;
          for (unsigned int d = 0; d < dim; ++d)
            out[4 + 4 * d + forces + d] += change;
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
            &Loops::find_divergence,
            &Loops::replace_divergence,
            &Loops::finish,
            &Loops::bound,
            &Loops::prepare_scatter,
            &Loops::replace_mean_stress};
  }
} // namespace geocone

#endif
