// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/contact.h>

#include <cmath>

namespace geocone
{
  using dealii::Tensor;

  namespace
  {
    /** A support's free direction counts as the normal up to here (10 degrees). */
    const double along = std::cos(radians(10.));
  } // namespace

  unsigned int
  Contact::free_direction(const unsigned int node) const
  {
    const bool x = unknowns.is_free(dim * node),
               y = unknowns.is_free(dim * node + 1);
    return x && y ? 2 : x ? 0 : y ? 1 : 3;
  }

  void
  Contact::begin_step(std::vector<ContactNode> nodes)
  {
    list.clear();
    for (ContactNode &node : nodes)
      {
        const unsigned int direction = free_direction(node.node);
        if (direction == 3 ||
            (direction < 2 && std::abs(node.normal[direction]) < along))
          continue;
        if (direction < 2)
          {
            const double sign      = node.normal[direction] > 0. ? 1. : -1.;
            node.normal            = Tensor<1, dim>();
            node.normal[direction] = sign;
            node.friction          = 0.;
            node.adhesion          = 0.;
          }
        list.push_back(node);
      }
  }

  void
  Contact::replace(Vector &residual, const Vector &v, const Vector &scale)
  {
    touch.assign(list.size(), Touch());
    B.assign(list.size(), Matrix());
    for (Vector &row : row_A)
      if (row.size() == 0)
        row.reinit(residual);
      else
        row.zero_out_ghost_values();
    const unsigned int n_owned = residual.locally_owned_size() / dim;
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const ContactNode &c = list[i];
        if (c.node >= n_owned)
          continue;
        const unsigned int direction = free_direction(c.node);
        Tensor<1, dim>     r, u;
        double             rho = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          if (direction == 2 || direction == d)
            {
              r[d] = residual.local_element(dim * c.node + d);
              u[d] = v.local_element(dim * c.node + d) - c.velocity[d];
              rho += scale.local_element(dim * c.node + d) /
                     (direction == 2 ? 2. : 1.);
            }
        const Tensor<1, dim> &n = c.normal;
        const Tensor<1, dim>  t({-n[1], n[0]});
        const double          w = u * n - c.least, p = r * n - rho * w;
        // Along n and t: F, and the rows of A and B.
        double F_n = r * n, F_t = r * t;
        double A_n[] = {1., 0.}, A_t[] = {0., 1.};
        double B_n[] = {0., 0.}, B_t[] = {0., 0.};
        // What rests without a force is held: it may have no other support.
        if (p >= 0.)
          {
            F_n                = rho * w;
            A_n[0]             = 0.;
            B_n[0]             = rho;
            const double bound = c.friction * p + c.adhesion;
            const double pull  = r * t - rho * (u * t);
            if (bound > 0. && std::abs(pull) <= bound)
              {
                touch[i].state = State::stick;
                F_t            = rho * (u * t);
                A_t[1]         = 0.;
                B_t[1]         = rho;
              }
            else
              {
                touch[i].state  = State::slip;
                const double mu = std::copysign(c.friction, pull);
                F_t             = r * t - std::copysign(bound, pull);
                A_t[0]          = -mu;
                B_t[0]          = mu * rho;
              }
          }
        const Tensor<1, dim> F = F_n * n + F_t * t;
        touch[i].force         = r;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            {
              row_A[a].local_element(dim * c.node + b) =
                n[a] * (A_n[0] * n[b] + A_n[1] * t[b]) +
                t[a] * (A_t[0] * n[b] + A_t[1] * t[b]);
              B[i][a][b] = n[a] * (B_n[0] * n[b] + B_n[1] * t[b]) +
                           t[a] * (B_t[0] * n[b] + B_t[1] * t[b]);
            }
        for (unsigned int d = 0; d < dim; ++d)
          if (direction == 2 || direction == d)
            {
              residual.local_element(dim * c.node + d) = F[d];
              touch[i].error = std::hypot(touch[i].error, F[d]);
            }
      }
    for (Vector &row : row_A)
      row.update_ghost_values();
  }

  void
  Contact::linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const
  {
    const unsigned int n_owned =
      list.empty() ? 0 : row_A[0].locally_owned_size() / dim;
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const unsigned int node = list[i].node;
        const int         *row  = &unknowns.free_row[dim * node];
        const auto         A = [&](const unsigned int a, const unsigned int b) {
          return row_A[a].local_element(dim * node + b);
        };
        // Both rows have the same columns.
        if (row[0] >= 0 && row[1] >= 0)
          {
            double *x = &matrix.value[matrix.row_start[row[0]]],
                   *y = &matrix.value[matrix.row_start[row[1]]];
            const int n =
              matrix.row_start[row[0] + 1] - matrix.row_start[row[0]];
            for (int k = 0; k < n; ++k)
              {
                const double old = x[k];
                x[k]             = A(0, 0) * old + A(0, 1) * y[k];
                y[k]             = A(1, 0) * old + A(1, 1) * y[k];
              }
          }
        else
          for (unsigned int d = 0; d < dim; ++d)
            if (row[d] >= 0)
              for (int k = matrix.row_start[row[d]];
                   k < matrix.row_start[row[d] + 1];
                   ++k)
                matrix.value[k] *= A(d, d);
        if (node < n_owned)
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              if (row[a] >= 0 && row[b] >= 0)
                pattern.add_entry(row[a], row[b], B[i][a][b], matrix);
      }
  }

  void
  Contact::apply_tangent(Vector &dst, const Vector &dv) const
  {
    const unsigned int n_owned = dst.locally_owned_size() / dim;
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const unsigned int node = list[i].node;
        if (node >= n_owned)
          continue;
        const double old[] = {dst.local_element(dim * node),
                              dst.local_element(dim * node + 1)};
        for (unsigned int a = 0; a < dim; ++a)
          if (unknowns.is_free(dim * node + a))
            {
              double sum = 0.;
              for (unsigned int b = 0; b < dim; ++b)
                if (unknowns.is_free(dim * node + b))
                  sum += row_A[a].local_element(dim * node + b) * old[b] +
                         B[i][a][b] * dv.local_element(dim * node + b);
              dst.local_element(dim * node + a) = sum;
            }
      }
  }
} // namespace geocone
