// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/material_points.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/polynomial_space.h>

#include <Eigen/Dense>

namespace geocone
{
  namespace
  {
    /** The part of a polynomial that others leave at the points of a cell below which
     *  it counts as made of them. */
    constexpr double same_polynomial = 1e-3;
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
    points.volumetric_gradients.resize(points.n_points() * m);
    points.volumetric_degree = degree;
    const dealii::PolynomialSpace<dim> polynomials(
      dealii::Polynomials::Legendre::generate_complete_basis(degree));
    points.n_volumetric_modes = polynomials.n();
    points.volumetric_modes.assign(points.n_points() * polynomials.n(), 0.);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int first = points.first_point[c],
                           n     = points.first_point[c + 1] - first;
        if (n == 0)
          continue;
        // Polynomials of the place in the box of the points.
        const dealii::BoundingBox<dim> box(
          std::vector<dealii::Point<dim>>(points.position.begin() + first,
                                          points.position.begin() + first + n));
        Values M(n, polynomials.n());
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int k = 0; k < polynomials.n(); ++k)
            {
              dealii::Point<dim> x;
              for (unsigned int d = 0; d < dim && degree > 0; ++d)
                if (box.side_length(d) > 0.)
                  x[d] = (points.position[first + q][d] - box.lower_bound(d)) /
                         box.side_length(d);
              M(q, k) = polynomials.compute_value(k, x);
            }
        const Eigen::Map<const Eigen::VectorXd> w(&points.weight[first], n);
        const Eigen::Map<const Values> g(&points.gradients[first * m], n, m);
        for (unsigned int k = 0; k < polynomials.n(); ++k)
          {
            const double before = std::sqrt(w.dot(M.col(k).cwiseAbs2()));
            for (unsigned int twice = 0; twice < 2; ++twice)
              for (unsigned int j = 0; j < k; ++j)
                M.col(k) -= w.dot(M.col(j).cwiseProduct(M.col(k))) * M.col(j);
            const double after = std::sqrt(w.dot(M.col(k).cwiseAbs2()));
            M.col(k) *= after > same_polynomial * before ? 1. / after : 0.;
          }
        Eigen::Map<Values>(&points.volumetric_modes[first * polynomials.n()],
                           n,
                           polynomials.n()) = M;
        Eigen::Map<Values>(&points.volumetric_gradients[first * m], n, m) =
          M * (M.transpose() * (w.asDiagonal() * g));
      }
  }
} // namespace geocone
