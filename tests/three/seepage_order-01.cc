// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, seepage in three dimensions would converge to another flow, or too slowly. The
// head exp(sqrt(2) x) cos(y) cos(z) is that of a flow through the unit cube. It is prescribed on
// the boundary; errors within on two grids of cubes, each six tetrahedra, show the orders. The
// nonlinear equations (solve_flow) must find the saturated flow, too.

#include <geocone/functions/simplex_field.h>
#include <geocone/seepage/confined_flow.h>
#include <geocone/seepage/flow_solution.h>

#include "../test.h"

#include <cmath>
#include <functional>
#include <iostream>

namespace three_seepage_order_01
{
  using namespace geocone;
  using namespace geocone::dim3;
  using dealii::Point;
  using dealii::Tensor;

  CoarseMesh
  cube(const unsigned int n)
  {
    CoarseMesh mesh;
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        mesh.grid[d].push_back(double(i) / n);
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          mesh.points.emplace_back(
            mesh.grid[0][i], mesh.grid[1][j], mesh.grid[2][k]);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            mesh.cells.emplace_back();
            for (unsigned int corner = 0; corner < 8; ++corner)
              mesh.cells.back().vertices[corner] =
                i + corner % 2 +
                (n + 1) * (j + corner / 2 % 2 + (n + 1) * (k + corner / 4));
          }
    return mesh;
  }

  double
  head(const Point<3> &x)
  {
    return 20. +
           std::exp(std::sqrt(2.) * x[0]) * std::cos(x[1]) * std::cos(x[2]) -
           x[1];
  }

  Tensor<1, 3>
  gradient(const Point<3> &x)
  {
    const double e = std::exp(std::sqrt(2.) * x[0]);
    return Tensor<1, 3>({std::sqrt(2.) * e * std::cos(x[1]) * std::cos(x[2]),
                         -e * std::sin(x[1]) * std::cos(x[2]) - 1.,
                         -e * std::cos(x[1]) * std::sin(x[2])});
  }

  bool
  is_on_boundary(const Point<3> &x)
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (x[d] < 1e-12 || x[d] > 1. - 1e-12)
        return true;
    return false;
  }

  /** Largest errors of pressure head and its gradient at points within. */
  std::array<double, 2>
  errors(const SimplexField &field)
  {
    std::array<double, 2>  largest = {{0., 0.}};
    constexpr unsigned int n       = 23;
    for (unsigned int i = 0; i < n * n * n; ++i)
      {
        const Point<3> x(
          (i % n + 0.47) / n, (i / n % n + 0.52) / n, (i / n / n + 0.41) / n);
        largest[0] = std::max(largest[0], std::abs(field.value(x) - head(x)));
        largest[1] =
          std::max(largest[1], (field.gradient(x) - gradient(x)).norm());
      }
    return largest;
  }

  const std::vector<dealii::SymmetricTensor<2, 3>> permeability = {
    dealii::unit_symmetric_tensor<3>()};

  SimplexField
  by_degree(const unsigned int n, const unsigned int degree)
  {
    const FlowMesh                     mesh(cube(n));
    ConfinedFlow                       flow(mesh, degree);
    std::vector<std::optional<double>> prescribed;
    for (const Point<3> &x : flow.nodes())
      prescribed.push_back(is_on_boundary(x) ? std::optional(head(x))
                                             : std::nullopt);
    flow.solve(permeability, Geometry::Symmetry::plane_strain, prescribed);
    double sum = 0., size = 0.;
    for (const double inflow : flow.inflow)
      {
        sum += inflow;
        size += std::abs(inflow);
      }
    std::cout << "degree " << degree << ": inflows sum to zero: "
              << (std::abs(sum) < 1e-12 * size && flow.error < 1e-10 ? "yes"
                                                                     : "no")
              << std::endl;
    return {
      mesh.vertices, mesh.cells, degree, flow.nodes_of_cells(), flow.head};
  }

  SimplexField
  by_balances(const unsigned int n)
  {
    const FlowMesh     mesh(cube(n));
    const unsigned int n_vertices = mesh.vertices.size();
    FlowConditions     conditions;
    conditions.kind.assign(n_vertices, FlowConditions::Kind::none);
    conditions.head.assign(n_vertices, 0.);
    conditions.rain.assign(n_vertices, 0.);
    for (unsigned int v = 0; v < n_vertices; ++v)
      if (is_on_boundary(mesh.vertices[v]))
        {
          conditions.kind[v] = FlowConditions::Kind::head;
          conditions.head[v] = head(mesh.vertices[v]);
        }
    const FlowSolution flow =
      solve_flow(mesh,
                 permeability,
                 std::vector<double>(mesh.cells.size(), 1.),
                 conditions,
                 std::vector<double>(n_vertices, -0.5));
    return {mesh.vertices, mesh.cells, flow.head};
  }

  void
  show(const std::string                                     &name,
       const unsigned int                                     n,
       const unsigned int                                     degree,
       const std::function<SimplexField(const unsigned int)> &flow)
  {
    const auto coarse = errors(flow(n)), fine = errors(flow(2 * n));
    const auto order = [&](const unsigned int i) {
      return std::log2(coarse[i] / fine[i]);
    };
    const bool holds = order(0) > degree + 0.7 && order(1) > degree - 0.3;
    std::cout << name << ": orders of head and gradient: ";
    if (holds)
      std::cout << "at least " << degree + 0.7 << " and " << degree - 0.3
                << std::endl;
    else
      std::cout << order(0) << " and " << order(1) << std::endl;
  }

  void
  test()
  {
    show("balances", 6, 1, by_balances);
    for (const unsigned int degree : {1, 2, 3})
      show("degree " + std::to_string(degree),
           degree == 1 ? 6 : 3,
           degree,
           [=](const unsigned int n) { return by_degree(n, degree); });
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace three_seepage_order_01
