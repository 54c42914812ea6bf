// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_transfer_kernels_templates_h
#define geocone_transfer_transfer_kernels_templates_h

#include <geocone/kernels/simd.h>
#include <geocone/points/particle_transfer.h>
#include <geocone/transfer/nodes_of_four.templates.h>
#include <geocone/transfer/transfer_kernels.h>

/*
 * Transfer kernels for several instruction sets: one translation unit per
 * instruction set includes this file and instantiates make_transfer_kernels().
 * A vector contains four points or the four values of a node, so that no lists
 * of points per cell are necessary. Everything in this file is a template over
 * the instruction set, or a member of a template: the linker might replace a
 * plain inline function by the version of another translation unit.
 */
namespace geocone::GEOCONE_DIM
{
  template <typename Arch>
  struct TransferLoops
  {
    using P = Pack<Arch>;

    template <int p>
    using Grid = PackedGrid<P, p>;
    template <int p>
    using Nodes = NodesOfFour<P, p>;

    /** Interpolated nodal values and gradients, as partial sums over the basis
     *  functions in the directions 0 ... d. */
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
     * Interpolates nodal values at the mth of four points. The value is the sum
     * of q N over the basis functions of the directions 0 ... d, with q four
     * doubles of a node; for the derivative in each direction N is replaced by
     * dN.
     */
    template <int p, int d, bool with_slopes>
    static Sum<d>
    sum(const GridView        &grid,
        const ValuesAtFour<p> &N,
        const ValuesAtFour<p> &dN,
        const int              m,
        const double          *node)
    {
      Sum<d> all;
      for (int i = 0; i <= p; ++i)
        {
          const double *at = node + node_size * i * grid.stride[d];
          const P       N_i(N[d][i][m]);
          P             below;
          if constexpr (d == 0)
            below = P::load(at);
          else
            {
              const auto part = sum<p, d - 1, with_slopes>(grid, N, dN, m, at);
              below           = part.value;
              if constexpr (with_slopes)
                for (int e = 0; e < d; ++e)
                  all.slope[e] += part.slope[e] * N_i;
            }
          all.value += below * N_i;
          if constexpr (with_slopes)
            all.slope[d] += below * P(dN[d][i][m]);
        }
      return all;
    }

    template <int p, bool with_slopes>
    static void
    gather(const GridView      &view,
           const TransferBlock &points,
           BlockScratch        &scratch)
    {
      const Grid<p> grid(view);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const Nodes<p> at(grid, points, k);
          double        *out = scratch.gathered + BlockScratch::n_gathered * k;
          for (int m = 0; m < 4; ++m, out += BlockScratch::n_gathered)
            {
              const double *node = at.read(grid, m);
              const auto    first =
                sum<p, dim - 1, with_slopes>(grid, at.N, at.dN, m, node);
              first.value.store(out);
              if constexpr (dim == 3)
                sum<p, dim - 1, false>(grid, at.N, at.dN, m, node + 4)
                  .value.store(out + 4);
              if constexpr (with_slopes)
                for (unsigned int d = 0; d < dim; ++d)
                  first.slope[d].store(out + node_size + 4 * d);
            }
        }
    }

    template <int p>
    static void
    gather_affine(const GridView      &view,
                  const TransferBlock &points,
                  BlockScratch &)
    {
      const Grid<p> grid(view);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const Nodes<p>  at(grid, points, k);
          ValuesAtFour<p> weights;
          for (unsigned int d = 0; d < dim; ++d)
            for (int m = 0; m < 4; ++m)
              find_moments(grid, at, d, m, points.x[d][k + m], weights);
          for (int m = 0; m < 4; ++m)
            {
              const auto all =
                sum<p, dim - 1, true>(grid, at.N, weights, m, at.read(grid, m));
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double column[4];
                  all.slope[d].store(column);
                  for (unsigned int c = 0; c < dim; ++c)
                    points.c[dim * c + d][k + m] = column[c];
                }
            }
        }
    }

    /** Computes the weights of the nodal velocities in the affine velocity
     *  matrix (APIC). The weights are N_i (x_i - x)/sum_i N_i (x_i - x)^2, or
     *  dN_i/dx if the denominator vanishes. */
    template <int p>
    static void
    find_moments(const GridView    &grid,
                 const Nodes<p>    &at,
                 const unsigned int d,
                 const int          m,
                 const double       x,
                 ValuesAtFour<p>   &weights)
    {
      const double *x_i    = grid.axes[d].greville + at.lowest[d][m];
      const double  size   = grid.axes[d].inverse_size;
      double        second = 0.;
      for (int i = 0; i <= p; ++i)
        {
          const double r   = x_i[i] - x;
          weights[d][i][m] = at.N[d][i][m] * r;
          second += weights[d][i][m] * r;
        }
      const bool vanishes = second * size * size < vanishing_moment;
      for (int i = 0; i <= p; ++i)
        weights[d][i][m] =
          vanishes ? at.dN[d][i][m] : weights[d][i][m] / second;
    }

    /**
     * Scatters the values of n consecutive points to the nodes, in nested loops
     * over the directions 0 ... d. The first of these points is the mth of four
     * points. Nodes are incremented by a N (if has_a) plus b_e dN for each
     * direction e (if has_b). Nodes common to the points are read and written
     * once.
     */
    template <int p, int d, int n, bool has_a, bool has_b>
    static void
    add(const GridView &grid,
        const Nodes<p> &at,
        const int       m,
        const P (&a)[n],
        const P (&b)[n][d + 1],
        double *node)
    {
      for (int i = 0; i <= p; ++i)
        {
          double *const to = node + node_size * i * grid.stride[d];
          if constexpr (d == 0)
            {
              P all = P::load(to);
              for (int q = 0; q < n; ++q)
                {
                  if constexpr (has_a)
                    all += a[q] * P(at.N[d][i][m + q]);
                  if constexpr (has_b)
                    all += b[q][0] * P(at.dN[d][i][m + q]);
                }
              all.store(to);
            }
          else
            {
              P next[n], slope[n][d];
              for (int q = 0; q < n; ++q)
                {
                  const P N(at.N[d][i][m + q]), dN(at.dN[d][i][m + q]);
                  if constexpr (has_a)
                    next[q] = a[q] * N;
                  if constexpr (has_a && has_b)
                    next[q] += b[q][d] * dN;
                  else if constexpr (has_b)
                    next[q] = b[q][d] * dN;
                  if constexpr (has_b)
                    for (int e = 0; e < d; ++e)
                      slope[q][e] = b[q][e] * N;
                }
              add<p, d - 1, n, has_a || has_b, has_b>(
                grid, at, m, next, slope, to);
            }
        }
    }

    template <int p, bool with_slopes>
    static void
    scatter(const GridView      &view,
            const TransferBlock &points,
            BlockScratch        &scratch)
    {
      const Grid<p> grid(view);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const Nodes<p> at(grid, points, k);
          const double  *in = scratch.scattered + BlockScratch::n_scattered * k;
          P              masses[4];
          if (grid.mass != nullptr)
            {
              // Functions of the last direction, point by point.
              for (int i = 0; i < 4; ++i)
                masses[i] =
                  i <= p ? P::load(at.N[dim - 1][i]) * P::load(points.mass + k)
                         : P(0.);
              transpose(masses[0], masses[1], masses[2], masses[3]);
            }
          for (int m = 0; m < 4;)
            if (m < 3 && at.first[m] == at.first[m + 1])
              {
                give<p, with_slopes, 2>(grid, at, m, in, masses);
                m += 2;
              }
            else
              {
                give<p, with_slopes, 1>(grid, at, m, in, masses);
                ++m;
              }
        }
    }

    /** Scatters the values and masses of n points that share the same nodes. */
    template <int p, bool with_slopes, int n>
    static void
    give(const GridView &grid,
         const Nodes<p> &at,
         const int       m,
         const double   *scattered,
         const P (&masses)[4])
    {
      P a[n], b[n][dim];
      for (int q = 0; q < n; ++q)
        {
          const double *in = scattered + BlockScratch::n_scattered * (m + q);
          a[q]             = P::load(in);
          for (unsigned int d = 0; d < dim; ++d)
            b[q][d] = P::load(in + 4 + 4 * d);
        }
      double *const node = at.write(grid, m);
      if constexpr (dim == 2)
        add<p, dim - 1, n, true, with_slopes>(grid, at, m, a, b, node);
      else
        {
          add<p, dim - 1, n, true, false>(grid, at, m, a, b, node);
          if constexpr (with_slopes)
            add<p, dim - 1, n, false, true>(grid, at, m, a, b, node + 4);
        }
      if (grid.mass != nullptr)
        {
          P mass[n];
          for (int q = 0; q < n; ++q)
            mass[q] = masses[m + q];
          add_masses<p, 0, n>(grid, at, m, mass, grid.mass + at.first[m]);
        }
    }

    /** Adds point masses to the nodes, four consecutive nodes in the last grid
     *  direction at a time (SIMD). The vectors of four nodes are padded with
     *  zeros after p + 1 nodes. */
    template <int p, int d, int n>
    static void
    add_masses(const GridView &grid,
               const Nodes<p> &at,
               const int       m,
               const P (&column)[n],
               double *mass)
    {
      if constexpr (d == dim - 1)
        {
          P all = P::load(mass);
          for (int q = 0; q < n; ++q)
            all += column[q];
          all.store(mass);
        }
      else
        for (int i = 0; i <= p; ++i)
          {
            P part[n];
            for (int q = 0; q < n; ++q)
              part[q] = column[q] * P(at.N[d][i][m + q]);
            add_masses<p, d + 1, n>(
              grid, at, m, part, mass + i * grid.stride[d]);
          }
    }

    template <int p>
    static void
    scatter_affine(const GridView      &view,
                   const TransferBlock &points,
                   BlockScratch &)
    {
      const Grid<p> grid(view);
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          const Nodes<p> at(grid, points, k);
          for (int m = 0; m < 4; ++m)
            add_affine(grid, at, points, k, m);
        }
    }

    /** Scatters the affine momentum (APIC) of the mth of four points to the
     *  nodes. */
    template <int p>
    static void
    add_affine(const GridView      &grid,
               const Nodes<p>      &at,
               const TransferBlock &points,
               const unsigned int   k,
               const int            m)
    {
      double C[dim * dim], r[dim][p + 1];
      for (unsigned int i = 0; i < dim * dim; ++i)
        C[i] = points.c[i][k + m];
      for (unsigned int d = 0; d < dim; ++d)
        for (int i = 0; i <= p; ++i)
          r[d][i] =
            grid.axes[d].greville[at.lowest[d][m] + i] - points.x[d][k + m];
      const double  mass = points.mass[k + m];
      double *const node = at.write(grid, m);
      for (int i = 0; i <= p; ++i)
        for (int j = 0; j <= p; ++j)
          {
            const double mN = mass * at.N[0][i][m] * at.N[1][j][m];
            double      *to =
              node + node_size * (i * grid.stride[0] + j * grid.stride[1]);
            if constexpr (dim == 2)
              for (unsigned int c = 0; c < dim; ++c)
                to[c] += mN * (C[dim * c] * r[0][i] + C[dim * c + 1] * r[1][j]);
            else
              for (int l = 0; l <= p; ++l, to += node_size)
                for (unsigned int c = 0; c < dim; ++c)
                  to[c] += mN * at.N[2][l][m] *
                           (C[dim * c] * r[0][i] + C[dim * c + 1] * r[1][j] +
                            C[dim * c + 2] * r[2][l]);
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
          // Four doubles of four points, as four vectors over points.
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

    /** Returns the volume ratio det(I + l) at four points, with the
     *  displacement gradient increment l. */
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
          // Zero unless axisymmetric.
          const P zz = P::load(scratch.l_zz + k);
          strain     = max(strain, abs(zz));
          const P J  = volume_ratio(l) * (P(1.) + zz);
          const P V  = P::load(points.volume + k);
          const P V1 = J * V;
          V1.store(points.volume + k);
          work += P(0.5) * (V + V1) * P::load(scratch.work + k);
          // The last block is padded by points without mass; 1e-300 avoids a
          // division by zero.
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
      // Position of forces among the four doubles to which slopes are added.
      constexpr unsigned int forces = change_of_node % 4;
      for (unsigned int k = 0; k < points.n; k += 4)
        {
          double *const out = scratch.scattered + BlockScratch::n_scattered * k;
          // Stores four doubles of each of four points.
          const auto store = [&](P(&values)[4], const unsigned int place) {
            transpose(values[0], values[1], values[2], values[3]);
            for (unsigned int m = 0; m < 4; ++m)
              values[m].store(out + BlockScratch::n_scattered * m + place);
          };
          const P m      = momentum ? P::load(points.mass + k) : P(0.);
          const P V      = force ? P(0.) - P::load(points.volume + k) : P(0.);
          P       all[4] = {P(0.), P(0.), P(0.), P(0.)};
          for (unsigned int c = 0; c < dim; ++c)
            all[c] = m * P::load(points.v[c] + k);
          if constexpr (dim == 2)
            if (force)
              all[forces] = P::load(scratch.hoop_force + k);
          store(all, 0);
          for (unsigned int d = 0; d < dim; ++d)
            {
              P slope[4] = {P(0.), P(0.), P(0.), P(0.)};
              for (unsigned int c = 0; c < dim; ++c)
                slope[forces + c] =
                  V * P::load(points.s[index_of_component[c][d]] + k);
              store(slope, 4 + 4 * d);
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
            change += V * points.s[index_of_component[d][d]][k] / dim;
          double *out = scratch.scattered + BlockScratch::n_scattered * k;
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
} // namespace geocone::GEOCONE_DIM

#endif
