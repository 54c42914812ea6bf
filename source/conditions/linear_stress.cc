// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conditions/linear_stress.h>
#include <geocone/points/quadrature_points.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Part of its volume by which a cell that is filled may differ from it. */
    constexpr double largest_gap = 0.1;

    /** Least ratio of the second moments of points along two axes that determine
     *  a slope. */
    constexpr double least_ratio = 1e-6;

    /** Positions of the points of a cell: of its quadrature points if they are
     *  fixed, otherwise x = sum N_i x_i. */
    std::vector<Point<dim>>
    positions_of(const MaterialPoints &points,
                 const unsigned int    c,
                 const BackgroundMesh &mesh,
                 const Space          &space)
    {
      if (points.values.empty())
        {
          CellValues at(space, mesh, stress_quadrature(space, mesh));
          at.reinit(points.cells[c]);
          return at.position;
        }
      std::vector<Point<dim>> positions;
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          Point<dim> x;
          for (unsigned int i = 0; i < points.n_nodes; ++i)
            x += points.values[p * points.n_nodes + i] *
                 space.node_positions()[points.nodes[c * points.n_nodes + i]];
          positions.push_back(x);
        }
      return positions;
    }

    /** Component of sigma n. */
    double
    traction(const unsigned int    component,
             const Mandel         &stress,
             const Tensor<1, dim> &n)
    {
      double sum = stress[index_of_normal[component]] * n[component];
      for (int k = 0; k < n_shears; ++k)
        {
          const auto [place, a, b] = shears[k];
          if (static_cast<int>(component) == a)
            sum += stress[place] / sqrt2 * n[b];
          else if (static_cast<int>(component) == b)
            sum += stress[place] / sqrt2 * n[a];
        }
      return sum;
    }
  } // namespace

  LinearStress::LinearStress(const MaterialPoints      &points,
                             const unsigned int         c,
                             const BackgroundMesh      &mesh,
                             const Space               &space,
                             const std::vector<Mandel> &stress)
    : at_centre(Mandel::Zero())
  {
    slope.fill(Mandel::Zero());
    const auto                   &cell   = points.cells[c];
    const unsigned int            first  = points.first_point[c];
    const std::vector<Point<dim>> x      = positions_of(points, c, mesh, space);
    double                        weight = 0.;
    Point<dim>                    middle;
    for (unsigned int q = 0; q < x.size(); ++q)
      {
        const double w = points.weight[first + q];
        weight += w;
        middle += w * x[q];
        at_centre += w * stress[first + q];
      }
    const double volume = cell->measure() * mesh.measure(cell->center());
    at_centre /= volume;
    if (std::abs(weight / volume - 1.) > largest_gap)
      return;

    middle /= weight;
    using Matrix   = Eigen::Matrix<double, dim, dim>;
    Matrix moments = Matrix::Zero();
    Eigen::Matrix<double, Mandel::SizeAtCompileTime, dim> products;
    products.setZero();
    for (unsigned int q = 0; q < x.size(); ++q)
      {
        const Tensor<1, dim>                arm = x[q] - middle;
        const Eigen::Matrix<double, dim, 1> a(
          Eigen::Map<const Eigen::Matrix<double, dim, 1>>(arm.begin_raw()));
        moments += points.weight[first + q] * a * a.transpose();
        products +=
          points.weight[first + q] * stress[first + q] * a.transpose();
      }
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(moments);
    if (!(eigen.eigenvalues()[0] > least_ratio * eigen.eigenvalues()[dim - 1]))
      return;
    const auto slopes = (products * moments.inverse()).eval();
    for (unsigned int k = 0; k < dim; ++k)
      {
        slope[k] = slopes.col(k);
        at_centre += (cell->center()[k] - middle[k]) * slope[k];
      }
  }

  double
  LinearStress::force(const unsigned int component,
                      const FaceMoments &faces) const
  {
    double sum = traction(component, at_centre, faces.normal);
    for (unsigned int k = 0; k < dim; ++k)
      sum += traction(component, slope[k], faces.along[k]);
    return sum;
  }
} // namespace geocone::GEOCONE_DIM
