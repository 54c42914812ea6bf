// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/terms/inertia.h>
#include <geocone/terms/point_kernels.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;
  using namespace kernels;

  Inertia::Inertia(const MaterialPoints &points,
                   const Unknowns       &unknowns,
                   const Vector         &lumped_mass,
                   const double          consistent_part)
    : points(points)
    , unknowns(unknowns)
    , mass(lumped_mass)
    , consistent(consistent_part)
  {}

  void
  Inertia::begin_step(const double step, const Vector &velocity_n)
  {
    h          = step;
    velocity_L = &velocity_n;
  }

  void
  Inertia::residual(Vector &part, const Vector &v, const LocalLaw &)
  {
    if (consistent > 0.)
      {
        Vector change = v;
        change -= *velocity_L;
        change.update_ghost_values();
        apply_mass(part, change);
        part /= h;
        return;
      }
    for (unsigned int i = 0; i < part.locally_owned_size(); ++i)
      part.local_element(i) =
        mass.local_element(i) / h *
        (v.local_element(i) - velocity_L->local_element(i));
  }

  void
  Inertia::add_sizes(const Vector &part, std::vector<double> &sizes) const
  {
    Term::add_sizes(part, sizes);
    double momentum = 0.;
    for (unsigned int i = 0; i < part.locally_owned_size(); ++i)
      momentum +=
        std::pow(mass.local_element(i) / h * velocity_L->local_element(i), 2);
    sizes.push_back(1e-6 * momentum);
  }

  void
  Inertia::linearise(const JacobianPattern &pattern,
                     const double,
                     SparseMatrix &matrix) const
  {
    if (consistent > 0.)
      with_n_nodes(points.n_nodes, [&](const auto n_constant) {
        constexpr int n = n_constant;
        for (unsigned int c = 0; c < points.n_cells(); ++c)
          {
            constexpr int m_dofs             = dim * n;
            double        K[m_dofs * m_dofs] = {};
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              {
                const double *N = &points.values[n * p];
                const double  m = consistent * points.mass[p] / h;
                for (int i = 0; i < n; ++i)
                  for (int j = 0; j < n; ++j)
                    for (unsigned int d = 0; d < dim; ++d)
                      K[m_dofs * (dim * i + d) + dim * j + d] +=
                        m * N[i] * N[j];
              }
            pattern.add_cell<n>(c, K, matrix);
          }
      });
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        pattern.add_diagonal(unknowns.free_row[i],
                             (1. - consistent) * mass.local_element(i) / h,
                             matrix);
  }

  void
  Inertia::apply_tangent(Vector &dst, const Vector &dv) const
  {
    Vector change;
    change.reinit(dst, true);
    apply_mass(change, dv);
    dst.add(1. / h, change);
  }

  void
  Inertia::add_elastic_diagonal(Vector &dst) const
  {
    dst.add(1. / h, mass);
  }

  void
  Inertia::apply_mass(Vector &dst, const Vector &x) const
  {
    dst = 0.;
    if (consistent > 0.)
      {
        with_n_nodes(points.n_nodes, [&](const auto n_constant) {
          constexpr int n = n_constant;
          for (unsigned int c = 0; c < points.n_cells(); ++c)
            {
              double cell_x[dim * n], cell_f[dim * n] = {};
              gather<n>(x.begin(), &points.nodes[c * n], cell_x);
              for (unsigned int p = points.first_point[c];
                   p < points.first_point[c + 1];
                   ++p)
                {
                  const double *N      = &points.values[n * p];
                  double        x[dim] = {};
                  for (int i = 0; i < n; ++i)
                    for (unsigned int d = 0; d < dim; ++d)
                      x[d] += N[i] * cell_x[dim * i + d];
                  const double m = consistent * points.mass[p];
                  for (int i = 0; i < n; ++i)
                    for (unsigned int d = 0; d < dim; ++d)
                      cell_f[dim * i + d] += m * N[i] * x[d];
                }
              scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
            }
        });
        dst.compress(VectorOperation::add);
      }
    for (unsigned int i = 0; i < dst.locally_owned_size(); ++i)
      dst.local_element(i) +=
        (1. - consistent) * mass.local_element(i) * x.local_element(i);
  }
} // namespace geocone::GEOCONE_DIM
