// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_axisymmetric_bounds_axisymmetric_points_h
#define geocone_axisymmetric_bounds_axisymmetric_points_h

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/axisymmetric_bounds/axisymmetric_strength.h>
#include <geocone/bounds/cell_points.h>
#include <geocone/plane_bounds/certified_side.h>

#include <algorithm>
#include <array>
#include <vector>

/** Points, forces and matrices of both problems of axisymmetric bodies. */
namespace geocone::GEOCONE_DIM
{
  /** @name Problems with their dofs and forces, and without points */
  /** @{ */
  ConicProblem
  upper_forces(const AxisymmetricScene &scene);
  ConicProblem
  lower_forces(const AxisymmetricScene &scene);
  /** @} */

  /** @name Velocities of the upper bound */
  /** @{ */
  /** Strain rates of a cell: the coefficients of their polynomials. */
  std::vector<Eigen::Matrix3d>
  rates_of_cell(const AxisymmetricScene &scene,
                const Eigen::VectorXd   &q,
                const unsigned int       number);

  /** Velocity of a cell on an edge: the coefficients of its polynomial. */
  std::vector<dealii::Tensor<1, dim>>
  velocity_on_edge(const AxisymmetricScene &scene,
                   const Eigen::VectorXd   &q,
                   const unsigned int       number,
                   const unsigned int       cell);

  /** Jump of the velocity at an edge, from its first cell outwards. */
  std::vector<dealii::Tensor<1, dim>>
  jump_at(const AxisymmetricScene &scene,
          const Eigen::VectorXd   &q,
          const unsigned int       number);

  /** Returns true if an edge dissipates by jumps. */
  bool
  resists_jump(const AxisymmetricScene::Edge &edge);
  /** @} */

  /** @name Powers of the strengths of solved problems, by material */
  /** @{ */
  /** @param q velocities, whose dissipation is certified */
  std::vector<StrengthPower>
  powers_of_upper(const AxisymmetricScene &scene,
                  const ConicProblem      &solved,
                  const Eigen::VectorXd   &q);
  /** @param q multipliers of equilibrium */
  std::vector<StrengthPower>
  powers_of_lower(const AxisymmetricScene &scene,
                  const ConicProblem      &solved,
                  const Eigen::VectorXd   &q);
  /** @} */

  /** Adds the power of the strength at a point of a cell.
   *  @param dissipation power of the point
   *  @param k strength of the point @param constant part of it that does not grow
   *  @param stress (s_rr, s_zz, sqrt2 s_rz, s_tt) */
  void
  add_power_of_point(const SpatialStrength &strength,
                     const double           dissipation,
                     const double           k,
                     const double           constant,
                     const Eigen::Vector4d &stress,
                     StrengthPower         &power);

  /** Forces F0 and f of a problem. */
  struct Forces
  {
    ConicProblem &problem;

    void
    add(const unsigned int dof, const double dead, const double live) const
    {
      problem.dead[dof] += dead;
      problem.live[dof] += live;
    }
  };

  /** Columns of a matrix of rates by dofs, each of which occurs once. */
  template <int n_rows, int n_columns>
  class Columns
  {
  public:
    using Vector = Eigen::Matrix<double, n_rows, 1>;

    void
    add(const unsigned int dof, const Vector &rate)
    {
      const auto end   = dofs.begin() + n;
      const auto found = std::find(dofs.begin(), end, dof);
      if (found == end)
        {
          AssertThrow(n < n_columns, dealii::ExcInternalError());
          dofs[n++] = dof;
        }
      B.col(found - dofs.begin()) += rate;
    }

    /** Completes unused columns by zeros. */
    void
    finish()
    {
      std::fill(dofs.begin() + n, dofs.end(), dofs[0]);
    }

    /** Number of columns that are not completed by zeros. */
    unsigned int
    n_used() const
    {
      return n;
    }

    Eigen::Matrix<double, n_rows, n_columns> B =
      Eigen::Matrix<double, n_rows, n_columns>::Zero();
    std::array<unsigned int, n_columns> dofs;

  private:
    unsigned int n = 0;
  };

  /** Local index of the vertices of an edge in a cell. */
  inline std::array<unsigned int, 2>
  ends_in_cell(const Triangles   &triangles,
               const unsigned int edge,
               const unsigned int cell)
  {
    std::array<unsigned int, 2> ends;
    for (unsigned int i = 0; i < 2; ++i)
      ends[i] = std::find(triangles.cells[cell].begin(),
                          triangles.cells[cell].end(),
                          triangles.edges[edge].vertices[i]) -
                triangles.cells[cell].begin();
    return ends;
  }

  /** Groups of the points of cells, without points. */
  template <int n_columns>
  CellPoints<n_columns, AxisymmetricMohrCoulomb, CircularConeOf<4>>
  empty_axisymmetric_points(const std::vector<SpatialStrength> &strengths)
  {
    return CellPoints<n_columns, AxisymmetricMohrCoulomb, CircularConeOf<4>>(
      strengths,
      [](const auto &one) { return axisymmetric_mohr_coulomb(one.a); },
      [](const auto &one) { return circular_cone<4>(one.a); });
  }
} // namespace geocone::GEOCONE_DIM

#endif
