// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_point_strains_h
#define geocone_limit_analysis_point_strains_h

#include <Eigen/Dense>

#include <type_traits>
#include <vector>

namespace geocone
{
  /** B of a point: a column for each of its dofs. */
  using StrainMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  /**
   * Matrices B_p of the strain rates B_p q of points, restricted to the dofs that
   * contribute: 6 of the 14 of a cell for the dual of linear stresses, 10 of 12 for
   * quadratic velocities. They are contiguous, since loops over points are limited by
   * memory bandwidth.
   */
  class PointStrains
  {
  public:
    PointStrains() = default;

    /** @param n_columns largest number of dofs of a point: 6 or 10, or with a
     *  cut-off 9 or 13 */
    explicit PointStrains(const unsigned int n_columns);

    /**
     * Adds a point. @param B a column for each of the dofs; zero columns are dropped
     */
    void
    add(const StrainMatrix &B, const std::vector<unsigned int> &dofs);

    /** Excludes a point from all sums. */
    void
    remove(const unsigned int point);

    /** Whether a point is excluded. */
    bool
    is_removed(const unsigned int point) const;

    /** Divides the normal-strain row of a point. */
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

    /** Forces sum_p V_p B_p' s_p of the points from first_point on, in n_dofs dofs. */
    Eigen::VectorXd
    forces(const std::vector<double>          &volume,
           const std::vector<Eigen::Vector3d> &s,
           const unsigned int                  n_dofs,
           const unsigned int                  first_point = 0) const;

    /** Calls f with the number of dofs per point as a compile-time constant. */
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

    /** Dofs of a point, n_columns of them; for fewer, some are repeated with zeros in
     *  B. */
    const unsigned int *
    dofs_of(const unsigned int point) const
    {
      return &dofs[n_columns * point];
    }

  private:
    unsigned int              n_columns = 0;
    std::vector<double>       values; ///< order: points, rows, columns
    std::vector<unsigned int> dofs;   ///< order: points, columns
  };
} // namespace geocone

#endif
