// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/point_strains.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace geocone
{
  PointStrains::PointStrains(const unsigned int n_columns)
    : n_columns(n_columns)
  {
    Assert(n_columns == 6 || n_columns == 9 || n_columns == 10 ||
             n_columns == 13,
           dealii::ExcInternalError());
  }

  void
  PointStrains::add(const StrainMatrix              &B,
                    const std::vector<unsigned int> &dofs_of_B)
  {
    const std::size_t first = dofs.size();
    values.resize(values.size() + 3 * n_columns, 0.);
    unsigned int k = 0;
    for (unsigned int j = 0; j < dofs_of_B.size(); ++j)
      {
        if (B.col(j).isZero(0.))
          continue;
        AssertThrow(k < n_columns, dealii::ExcInternalError());
        for (unsigned int i = 0; i < 3; ++i)
          values[3 * first + i * n_columns + k] = B(i, j);
        dofs.push_back(dofs_of_B[j]);
        ++k;
      }
    dofs.resize(first + n_columns, k > 0 ? dofs[first] : 0);
  }

  void
  PointStrains::remove(const unsigned int point)
  {
    std::fill_n(&values[3 * n_columns * point], 3 * n_columns, 0.);
    std::fill_n(&dofs[n_columns * point], n_columns, dofs[n_columns * point]);
  }

  bool
  PointStrains::is_removed(const unsigned int point) const
  {
    const double *const first = &values[3 * n_columns * point];
    return std::all_of(first, first + 3 * n_columns, [](const double value) {
      return value == 0.;
    });
  }

  std::vector<Eigen::Vector3d>
  PointStrains::rates(const Eigen::VectorXd &q) const
  {
    std::vector<Eigen::Vector3d> all(n_points());
    with_n_columns([&](const auto size) {
      constexpr int               n = decltype(size)::value;
      Eigen::Matrix<double, 1, n> own;
      for (unsigned int p = 0; p < all.size(); ++p)
        {
          const unsigned int *const of = dofs_of(p);
          for (int k = 0; k < n; ++k)
            own[k] = q[of[k]];
          const auto B = matrix<n>(p);
          for (int i = 0; i < 3; ++i)
            all[p][i] = B.row(i).dot(own);
        }
    });
    return all;
  }

  Eigen::VectorXd
  PointStrains::forces(const std::vector<double>          &volume,
                       const std::vector<Eigen::Vector3d> &s,
                       const unsigned int                  n_dofs,
                       const unsigned int                  first_point) const
  {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(n_dofs);
    with_n_columns([&](const auto size) {
      constexpr int n = decltype(size)::value;
      for (unsigned int p = first_point; p < s.size(); ++p)
        {
          const Eigen::Vector3d             weighted = volume[p] * s[p];
          const auto                        B        = matrix<n>(p);
          const Eigen::Matrix<double, 1, n> own      = weighted[0] * B.row(0) +
                                                  weighted[1] * B.row(1) +
                                                  weighted[2] * B.row(2);
          const unsigned int *const of = dofs_of(p);
          for (int k = 0; k < n; ++k)
            f[of[k]] += own[k];
        }
    });
    return f;
  }
} // namespace geocone
