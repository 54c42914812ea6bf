// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_point_functions_h
#define geocone_points_point_functions_h

#include <geocone/points/material_points.h>
#include <geocone/points/particle_transfer.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Shape functions that are nonzero at a point, with the transfer between the
   * point and its nodes (P2G, G2P). They serve implicit and explicit steps on
   * any mesh; TransferKernels is the equivalent for many points of a Cartesian
   * grid. Nodal arrays contain m values per local node, node by node.
   */
  struct PointFunctions
  {
    unsigned int        n;     ///< number of shape functions
    const unsigned int *nodes; ///< local node numbers
    const double       *N;
    /** Derivatives dN/dx, dN/dy, ... of the shape functions at the point
     *  (1/m). */
    std::array<const double *, dim> slopes;

    using Positions = std::vector<dealii::Point<dim>>; ///< of the local nodes

    /** Interpolates nodal values and, optionally, their gradients to the point
     *  (G2P). @param[out] at_point sum N_i f_i of the m values, then, with
     *  gradients, sum f_i dN_i/dx, sum f_i dN_i/dy, ...
     *  @tparam stride number of values per node, at least m */
    template <unsigned int m, bool with_gradients, unsigned int stride = m>
    void
    gather(const double *at_nodes, double *at_point) const
    {
      std::fill_n(at_point, with_gradients ? (1 + dim) * m : m, 0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double *f = at_nodes + stride * nodes[i];
          for (unsigned int c = 0; c < m; ++c)
            {
              at_point[c] += N[i] * f[c];
              if (with_gradients)
                for (unsigned int d = 0; d < dim; ++d)
                  at_point[(1 + d) * m + c] += slopes[d][i] * f[c];
            }
        }
    }

    /** Distributes values of the point to the nodes (P2G), as the transpose of
     *  gather(). The results are added to the nodal values. */
    template <unsigned int m, bool with_gradients, unsigned int stride = m>
    void
    scatter(const double *at_point, double *at_nodes) const
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          double *f = at_nodes + stride * nodes[i];
          for (unsigned int c = 0; c < m; ++c)
            {
              f[c] += N[i] * at_point[c];
              if (with_gradients)
                for (unsigned int d = 0; d < dim; ++d)
                  f[c] += slopes[d][i] * at_point[(1 + d) * m + c];
            }
        }
    }

    /** Distributes the affine momentum of the point (APIC) to the nodes (P2G).
     *  The vector mass N_i C (x_i - x) is added to the first dim of the m
     *  values of node i. */
    template <unsigned int m>
    void
    scatter_affine(const double                  mass,
                   const dealii::Tensor<2, dim> &C,
                   const dealii::Point<dim>     &x,
                   const Positions              &positions,
                   double                       *at_nodes) const
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          const dealii::Tensor<1, dim> v = C * (positions[nodes[i]] - x);
          for (unsigned int d = 0; d < dim; ++d)
            at_nodes[m * nodes[i] + d] += mass * N[i] * v[d];
        }
    }

    /** Velocity gradient C of APIC at a point x (G2P). The nodal velocities are
     *  the first dim of m nodal values.
     *  @param size of the cell (m), as in affine_velocity() */
    template <unsigned int m>
    dealii::Tensor<2, dim>
    gather_affine(const double             *at_nodes,
                  const dealii::Point<dim> &x,
                  const Positions          &positions,
                  const double              size) const
    {
      dealii::Tensor<2, dim> B, gradient;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double                *v = at_nodes + m * nodes[i];
          const dealii::Tensor<1, dim> r = positions[nodes[i]] - x;
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              {
                B[d][e] += N[i] * v[d] * r[e];
                gradient[d][e] += slopes[e][i] * v[d];
              }
        }
      return affine_velocity(B, moment(x, positions), gradient, size);
    }

    /** Second moment of the nodes about a point, D = sum_i N_i (x_i - x)(x_i -
     *  x)', for APIC (m^2). */
    dealii::Tensor<2, dim>
    moment(const dealii::Point<dim> &x, const Positions &positions) const
    {
      dealii::Tensor<2, dim> D;
      for (unsigned int i = 0; i < n; ++i)
        {
          const dealii::Tensor<1, dim> r = positions[nodes[i]] - x;
          D += N[i] * outer_product(r, r);
        }
      return D;
    }
  };

  /** Calls f(p, c, functions) for each point p of each cell c, where functions
   *  are the shape functions at p. */
  template <typename Function>
  void
  for_each_point(const MaterialPoints &points, const Function &f)
  {
    const unsigned int n = points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          PointFunctions at = {
            n, &points.nodes[n * c], &points.values[n * p], {}};
          for (unsigned int d = 0; d < dim; ++d)
            at.slopes[d] = &points.gradients[n * (dim * p + d)];
          f(p, c, at);
        }
  }
} // namespace geocone::GEOCONE_DIM

#endif
