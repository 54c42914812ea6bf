// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/material_points.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/polynomial_space.h>

#include <Eigen/Dense>

namespace geocone
{
  void
  MaterialPoints::state(const unsigned int p, StateRow &row)
  {
    row(stress[p],
        plastic_strain[p],
        cumulative_plastic_strain[p],
        plastic_strain_rate[p]);
    for (unsigned int k = 0; k < n_history; ++k)
      row(history[n_history * p + k]);
    if (!id.empty())
      row(material[p],
          mass[p],
          weight[p],
          velocity[p],
          displacement[p],
          affine[p],
          held_by[p]);
  }

  void
  MaterialPoints::resize(const unsigned int n, const bool moving)
  {
    position.resize(n);
    material.resize(n, 0);
    weight.resize(n, 0.);
    stress.resize(n, Mandel::Zero());
    plastic_strain.resize(n, Mandel::Zero());
    cumulative_plastic_strain.resize(n, 0.);
    plastic_strain_rate.resize(n, 0.);
    history.resize(n_history * n, 0.);
    if (!moving)
      return;
    id.resize(n, 0);
    mass.resize(n, 0.);
    velocity.resize(n);
    displacement.resize(n);
    affine.resize(n);
    held_by.resize(n, 0);
  }

  void
  project_gradients(const unsigned int degree, MaterialPoints &points)
  {
    const unsigned int m = dim * points.n_nodes; // values per point
    using Values =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    points.volumetric_gradients.resize(points.n_points() * m);
    const dealii::PolynomialSpace<dim> polynomials(
      dealii::Polynomials::Legendre::generate_complete_basis(degree));
    std::vector<double> values(polynomials.n());
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
        Values M(n, values.size());
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int k = 0; k < values.size(); ++k)
            {
              dealii::Point<dim> x;
              for (unsigned int d = 0; d < dim && degree > 0; ++d)
                x[d] = (points.position[first + q][d] - box.lower_bound(d)) /
                       box.side_length(d);
              M(q, k) = polynomials.compute_value(k, x);
            }
        const Eigen::Map<const Eigen::VectorXd> w(&points.weight[first], n);
        const Eigen::Map<const Values> g(&points.gradients[first * m], n, m);
        const Values                   WM = w.asDiagonal() * M;
        Eigen::Map<Values>(&points.volumetric_gradients[first * m], n, m) =
          M * (M.transpose() * WM).ldlt().solve(WM.transpose() * g);
      }
  }
} // namespace geocone
