// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_point_strains_h
#define geocone_limit_analysis_point_strains_h

#include <Eigen/Dense>

#include <type_traits>
#include <vector>

namespace geocone
{
  /**
   * The matrices B_p of the strain rates B_p q of points, each with those dofs only
   * that the point knows: of the linear stresses' dual 6 of the 14 of a cell, of
   * quadratic velocities 10 of 12. They are in a row in memory, which is what loops
   * over points wait for.
   */
  class PointStrains
  {
  public:
    PointStrains() = default;

    /** @param n_columns the most dofs that a point knows: 6 or 10, or with a cut-off 9 or
     *  13 */
    explicit PointStrains(const unsigned int n_columns);

    /** Adds a point. @param B a column for each of the dofs; those that are zero are
     *  left out */
    void
    add(const Eigen::Matrix<double, 3, Eigen::Dynamic> &B,
        const std::vector<unsigned int>                &dofs);

    /** Takes a point out of everything. */
    void
    remove(const unsigned int point);

    /** Whether a point has no part in anything. */
    bool
    is_removed(const unsigned int point) const;

    /** Divides the row of the normal strain of a point. */
    void
    divide_normal(const unsigned int point, const double by);

    unsigned int
    n_points() const
    {
      return n_columns == 0 ? 0 : dofs.size() / n_columns;
    }

    /** B_p q of all points. */
    std::vector<Eigen::Vector3d>
    rates(const Eigen::VectorXd &q) const;

    /** sum_p V_p B_p' s_p from a point on, in as many dofs as asked. */
    Eigen::VectorXd
    forces(const std::vector<double>          &volume,
           const std::vector<Eigen::Vector3d> &s,
           const unsigned int                  n_dofs,
           const unsigned int                  first_point = 0) const;

    /** Calls f with the number of dofs of a point as a constant. */
    template <typename Function>
    void
    with_n_columns(const Function &f) const
    {
      if (n_columns == 6)
        f(std::integral_constant<int, 6>());
      else if (n_columns == 9)
        f(std::integral_constant<int, 9>());
      else if (n_columns == 10)
        f(std::integral_constant<int, 10>());
      else if (n_columns == 13)
        f(std::integral_constant<int, 13>());
    }

    /** B of a point. */
    template <int n>
    Eigen::Map<const Eigen::Matrix<double, 3, n, Eigen::RowMajor>>
    matrix(const unsigned int point) const
    {
      return Eigen::Map<const Eigen::Matrix<double, 3, n, Eigen::RowMajor>>(
        &values[3 * n * point]);
    }

    /** Its dofs, n_columns of them; where it knows fewer, some are there twice, with
     *  zeros in B. */
    const unsigned int *
    dofs_of(const unsigned int point) const
    {
      return &dofs[n_columns * point];
    }

  private:
    unsigned int              n_columns = 0;
    std::vector<double>       values; ///< by points, rows, columns
    std::vector<unsigned int> dofs;   ///< by points, columns
  };
} // namespace geocone

#endif
