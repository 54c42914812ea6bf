// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Consistent integration over particles anywhere: weights fill the cells, constant
// stress is in balance wherever no function reaches the border, gradients of linear
// velocities remain exact, below a limit or a loaded side that cuts cells constant
// stress gives the forces of its traction, and Gauss points are left as they are.

#include <geocone/surfaces/side_points.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace particles_consistent_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;
  using dealii::Tensor;

  struct Body : Setup
  {
    explicit Body(const std::string &layout)
      : Setup("particles/seeding.prm",
              {"Discretisation/Element = B-spline 3",
               "Discretisation/B-bar = true",
               "Particles/Layout = " + layout,
               layout == "random" ? "Particles/Number = 2400"
                                  : "Particles/Points per direction = 3"})
    {
      prepare();
      particles.prepare(scene, mesh, space, points);
    }

    /** sum_p w_p g_p,i at the nodes. */
    Vector
    forces() const
    {
      Vector f(space.partitioner());
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < points.n_nodes; ++i)
              f.local_element(dim * points.nodes[c * points.n_nodes + i] + d) +=
                points.weight[p] *
                points.gradients[(p * dim + d) * points.n_nodes + i];
      f.compress(dealii::VectorOperation::add);
      return f;
    }

    /** The largest error of the gradient of the velocity (2 x - y, x + 3 y). */
    double
    gradient_error() const
    {
      const double A[2][2] = {{2., -1.}, {1., 3.}};
      double       error   = 0.;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int d = 0; d < dim; ++d)
              {
                double sum = 0.;
                for (unsigned int i = 0; i < points.n_nodes; ++i)
                  {
                    const Point<dim> &x =
                      space
                        .node_positions()[points.nodes[c * points.n_nodes + i]];
                    sum += (A[k][0] * x[0] + A[k][1] * x[1]) *
                           points.gradients[(p * dim + d) * points.n_nodes + i];
                  }
                error = std::max(error, std::abs(sum - A[k][d]));
              }
      return error;
    }

    MaterialPoints points;
  };

  /** The largest of the forces of owned nodes in a box, less a given one. */
  template <typename Given>
  double
  largest_force(const Body      &body,
                const Point<dim> lower,
                const Point<dim> upper,
                const Given     &given)
  {
    const Vector f       = body.forces();
    double       largest = 0.;
    for (unsigned int i = 0; i < body.space.n_owned_nodes(); ++i)
      {
        const Point<dim> &x = body.space.node_positions()[i];
        if (x[0] > lower[0] && x[0] < upper[0] && x[1] > lower[1] &&
            x[1] < upper[1])
          for (unsigned int d = 0; d < dim; ++d)
            largest = std::max(largest,
                               std::abs(f.local_element(dim * i + d) -
                                        given.local_element(dim * i + d)));
      }
    return largest;
  }

  /** The integrals of N_i over the line at height y, as forces along y. */
  Vector
  line_forces(const Body &body, const double y)
  {
    Vector                  f(body.space.partitioner());
    const dealii::QGauss<1> gauss(3);
    const unsigned int      n = body.space.nodes_per_cell();
    std::vector<double>     N(n);
    std::vector<dealii::types::global_dof_index> nodes;
    for (const auto &cell : body.mesh.own_cells())
      if (cell->vertex(0)[1] < y && y < cell->vertex(3)[1])
        {
          body.space.cell_nodes(cell, nodes);
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              body.space.evaluate(
                cell,
                {gauss.point(q)[0],
                 (y - cell->vertex(0)[1]) / cell->extent_in_direction(1)},
                N.data(),
                nullptr);
              for (unsigned int i = 0; i < n; ++i)
                f.local_element(dim * body.space.local_node(nodes[i]) + 1) +=
                  gauss.weight(q) * cell->extent_in_direction(0) * N[i];
            }
        }
    f.compress(dealii::VectorOperation::add);
    return f;
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize init(argc, argv, 1);
    {
      Body         body("random");
      const Vector none(body.space.partitioner());
      if (speaks())
        std::printf("particles anywhere\n");
      print("volumes as weights: constant stress is out of balance",
            mpi::max(largest_force(body, {0.25, 0.25}, {0.95, 0.55}, none),
                     comm) > 1e-3);
      body.particles.prepare_integration(true, {}, body.points);
      double fill = 0.;
      for (unsigned int c = 0; c < body.points.n_cells(); ++c)
        if (const Point<dim> x = body.points.cells[c]->center();
            x[0] > 0.1 && x[0] < 1.1 && x[1] > 0.1 && x[1] < 0.7)
          {
            double sum = 0.;
            for (unsigned int p = body.points.first_point[c];
                 p < body.points.first_point[c + 1];
                 ++p)
              sum += body.points.weight[p];
            fill = std::max(
              fill, std::abs(sum / body.points.cells[c]->measure() - 1.));
          }
      print("weights fill inner cells", fill < 1e-13);
      print("constant stress is in balance",
            largest_force(body, {0.25, 0.25}, {0.95, 0.55}, none) < 1e-15);
      print("linear velocities have their gradient",
            body.gradient_error() < 1e-12);
      const double before = body.points.weight[0];
      body.particles.prepare_integration(true, {}, body.points);
      print("and again the same",
            std::abs(body.points.weight[0] - before) < 1e-17);
    }
    {
      Body            body("random");
      const double    y     = 0.77;
      const SoilLimit limit = {
        1,
        y,
        true,
        dealii::BoundingBox<dim>({Point<dim>(-1., y), Point<dim>(2., y)})};
      body.particles.prepare_integration(true, {{limit}, {}}, body.points);
      if (speaks())
        std::printf("below a limit at 0.77\n");
      print("constant stress gives the forces of its traction",
            largest_force(
              body, {0.25, 0.25}, {0.95, 1.}, line_forces(body, y)) < 1e-15);
      print("linear velocities have their gradient",
            body.gradient_error() < 1e-12);
    }
    {
      Body                        body("random");
      const std::vector<SidePart> loaded = {
        {{Point<dim>(1.2, 0.76), Point<dim>(0.55, 0.79)}},
        {{Point<dim>(0.55, 0.79), Point<dim>(0., 0.72)}}};
      body.particles.prepare_integration(true, {{}, loaded}, body.points);
      Vector pressure(body.space.partitioner());
      for_each_point(body.mesh,
                     body.space,
                     loaded,
                     [&](const std::size_t facet, const BoundaryPoint &point) {
                       const Tensor<1, dim> f =
                         point.weight * area_of(loaded[facet]);
                       for (unsigned int i = 0; i < point.nodes.size(); ++i)
                         for (unsigned int d = 0; d < dim; ++d)
                           pressure.local_element(
                             dim * body.space.local_node(point.nodes[i]) + d) +=
                             point.values[i] * f[d];
                     });
      pressure.compress(dealii::VectorOperation::add);
      if (speaks())
        std::printf("below a loaded side with a kink\n");
      // for_each_point() shifts facets by 1e-9 of their length.
      print("constant stress gives the forces of its traction",
            largest_force(body, {0.25, 0.25}, {0.95, 1.}, pressure) < 1e-9);
      print("linear velocities have their gradient",
            body.gradient_error() < 1e-12);
    }
    {
      Body                      body("Gauss");
      const std::vector<double> weight = body.points.weight,
                                g      = body.points.gradients;
      body.particles.prepare_integration(true, {}, body.points);
      double change = 0.;
      for (unsigned int p = 0; p < weight.size(); ++p)
        change =
          std::max(change, std::abs(body.points.weight[p] / weight[p] - 1.));
      for (unsigned int j = 0; j < g.size(); ++j)
        change =
          std::max(change, std::abs(body.points.gradients[j] - g[j]) / 30.);
      if (speaks())
        std::printf("Gauss points\n");
      print("nothing changes", change < 1e-13);
    }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace particles_consistent_01
