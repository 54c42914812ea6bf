// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_point_strains_h
#define geocone_plane_bounds_point_strains_h

#include <Eigen/Dense>

#include <type_traits>
#include <vector>

namespace geocone
{
  /** Strain-displacement matrix B of a point, with a column for each dof of the point. */
  using StrainMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  /**
   * Strain-displacement matrices B_p of all points, which yield the strain rates B_p q.
   * Only dofs with nonzero columns are stored: 6 of 14 dofs of a cell for the dual of
   * linear stresses, 10 of 12 for quadratic velocities. The matrices are stored
   * contiguously, since loops over points are limited by memory bandwidth.
   */
  class PointStrains
  {
  public:
    PointStrains() = default;

    /** Creates an empty list of points.
     *  @param n_columns maximum number of dofs of a point: 6 or 10, or with a cut-off 9
     *  or 13 */
    explicit PointStrains(const unsigned int n_columns);

    /**
     * Appends a point. @param B a column for each of the dofs; zero columns are omitted
     */
    void
    add(const StrainMatrix &B, const std::vector<unsigned int> &dofs);

    /** Excludes a point from all sums over the points. */
    void
    remove(const unsigned int point);

    /** Returns true if a point is excluded from the sums over the points. */
    bool
    is_removed(const unsigned int point) const;

    unsigned int
    n_points() const
    {
      return n_columns == 0 ? 0 : dofs.size() / n_columns;
    }

    /** Computes the strain rates B_p q of all points from the dof values q. */
    std::vector<Eigen::Vector3d>
    rates(const Eigen::VectorXd &q) const;

    /** Computes the internal forces sum_p V_p B_p' s_p at all dofs from the
     *  stresses s_p and volumes V_p of the points. The sum begins with the
     *  point @p first_point. */
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

    /** Returns the strain-displacement matrix B of a point. */
    template <int n>
    Eigen::Map<const Eigen::Matrix<double, 3, n, Eigen::RowMajor>>
    matrix(const unsigned int point) const
    {
      return Eigen::Map<const Eigen::Matrix<double, 3, n, Eigen::RowMajor>>(
        &values[3 * n * point]);
    }

    /** Returns the dofs of a point as an array of n_columns entries. For a
     *  point with fewer dofs, some dofs are repeated with zero columns of B. */
    const unsigned int *
    dofs_of(const unsigned int point) const
    {
      return &dofs[n_columns * point];
    }

  private:
    unsigned int              n_columns = 0;
    std::vector<double>       values; ///< all B_p: point, row, column
    std::vector<unsigned int> dofs;   ///< of all points: point, column
  };
} // namespace geocone

#endif
