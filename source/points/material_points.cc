// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/points/material_points.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/polynomial.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Relative remainder below which a polynomial at the points of a cell
     *  counts as linearly dependent on others. */
    constexpr double same_polynomial = 1e-3;

    /** Side of the box of a cell's points, relative to the longest one, below
     *  which it counts as zero. */
    constexpr double same_place = 1e-6;

    /** Exponents of the coordinates in polynomials of a degree, lowest sums
     *  first. */
    std::vector<std::array<unsigned int, dim>>
    powers_up_to(const unsigned int degree)
    {
      std::vector<std::array<unsigned int, dim>> result;
      for (unsigned int sum = 0; sum <= degree; ++sum)
        for (unsigned int i = 0; i <= sum; ++i)
          for (unsigned int j = dim == 3 ? 0 : sum - i; i + j <= sum; ++j)
            {
              std::array<unsigned int, dim> powers{{i, j}};
              if (dim == 3)
                powers.back() = sum - i - j;
              result.push_back(powers);
            }
      return result;
    }
  } // namespace

  void
  MaterialPoints::use(const bool moving, const unsigned int n_history)
  {
    history.width = n_history;
    start.width   = 0;
    mass.width = velocity.width = displacement.width = affine.width = moving;
    id.width = held_by.width = cell.width = unit.width = moving;
  }

  void
  MaterialPoints::append(const double *row)
  {
    const unsigned int n = n_points();
    set_size(n + 1);
    set(n, row);
  }

  void
  project_gradients(const unsigned int degree, MaterialPoints &points)
  {
    const unsigned int m = dim * points.n_nodes; // values per point
    using Values =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const std::vector<dealii::Polynomials::Polynomial<double>> legendre =
      dealii::Polynomials::Legendre::generate_complete_basis(degree);
    const auto         powers  = powers_up_to(degree);
    const unsigned int n_modes = powers.size();
    points.n_volumetric_modes  = n_modes;
    points.volumetric_modes.assign(points.n_points() * n_modes, 0.);
    points.volumetric_gradients.resize(points.n_points() * m);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int first = points.first_point[c],
                           n     = points.first_point[c + 1] - first;
        if (n == 0)
          continue;
        // Polynomials of the position in the bounding box of the points.
        const dealii::BoundingBox<dim> box(
          std::vector<dealii::Point<dim>>(points.position.begin() + first,
                                          points.position.begin() + first + n));
        double longest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          longest = std::max(longest, box.side_length(d));
        Values M = Values::Ones(n, n_modes);
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double side = box.side_length(d);
              const double x =
                side > same_place * longest
                  ? (points.position[first + q][d] - box.lower_bound(d)) / side
                  : 0.;
              for (unsigned int j = 0; j < n_modes; ++j)
                M(q, j) *= legendre[powers[j][d]].value(x);
            }
        // Gram-Schmidt orthogonalisation, twice.
        const Eigen::Map<const Eigen::VectorXd> w(&points.weight[first], n);
        for (unsigned int j = 0; j < n_modes; ++j)
          {
            const double before = std::sqrt(w.dot(M.col(j).cwiseAbs2()));
            for (unsigned int twice = 0; twice < 2; ++twice)
              for (unsigned int i = 0; i < j; ++i)
                M.col(j) -= w.dot(M.col(i).cwiseProduct(M.col(j))) * M.col(i);
            const double after = std::sqrt(w.dot(M.col(j).cwiseAbs2()));
            M.col(j) *= after > same_polynomial * before ? 1. / after : 0.;
          }
        Values g = Eigen::Map<const Values>(&points.gradients[first * m], n, m);
        if (!points.hoop.empty())
          g.leftCols(points.n_nodes) += Eigen::Map<const Values>(
            &points.hoop[first * points.n_nodes], n, points.n_nodes);
        Eigen::Map<Values>(
          &points.volumetric_modes[first * n_modes], n, n_modes) = M;
        Eigen::Map<Values>(&points.volumetric_gradients[first * m], n, m) =
          M * (M.transpose() * (w.asDiagonal() * g));
      }
  }
} // namespace geocone::GEOCONE_DIM
