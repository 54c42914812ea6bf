// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/discretisation/quadrature_points.h>
#include <geocone/mechanics/loads.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace geocone
{
  using namespace dealii;

  void
  integrate_density(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    Vector               &weight_per_g,
                    Vector               &lumped_mass)
  {
    // Degree 2p of N_i^2 on triangles up to P2, p of N_i for P3.
    CellValues values(space,
                      mesh,
                      mesh.is_simplicial()
                        ? Quadrature<dim>(QWitherdenVincentSimplex<dim>(3))
                        : Quadrature<dim>(QGauss<dim>(space.degree() + 1)));
    const bool scaled_diagonal = mesh.is_simplicial() && space.degree() == 2;
    weight_per_g.reinit(space.partitioner());
    lumped_mass.reinit(space.partitioner());
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        values.reinit(cell);
        space.cell_nodes(cell, nodes);
        const double rho = scene.materials[cell->material_id()].density();
        std::vector<double> row_sum(nodes.size(), 0.);
        std::vector<double> diagonal(nodes.size(), 0.);
        double              total = 0., trace = 0.;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            for (unsigned int q = 0; q < values.weight.size(); ++q)
              {
                const double N = values.value(i, q);
                row_sum[i] += rho * N * values.weight[q];
                diagonal[i] += rho * N * N * values.weight[q];
              }
            total += row_sum[i];
            trace += diagonal[i];
          }
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const unsigned int dof = dim * space.local_node(nodes[i]) + c;
              weight_per_g.local_element(dof) += row_sum[i];
              lumped_mass.local_element(dof) +=
                scaled_diagonal ? diagonal[i] * total / trace : row_sum[i];
            }
      }
    weight_per_g.compress(VectorOperation::add);
    lumped_mass.compress(VectorOperation::add);
  }

  Loads::Loads(const Scene          &scene,
               const BackgroundMesh &mesh,
               const Space          &space)
    : scene(scene)
  {
    // Unit vertices of the faces, in the numbering of the reference cells.
    const std::vector<std::array<Point<dim>, 2>> faces_triangle = {
      {{{0., 0.}, {1., 0.}}}, {{{1., 0.}, {0., 1.}}}, {{{0., 1.}, {0., 0.}}}};
    const std::vector<std::array<Point<dim>, 2>> faces_square = {
      {{{0., 0.}, {0., 1.}}},
      {{{1., 0.}, {1., 1.}}},
      {{{0., 0.}, {1., 0.}}},
      {{{0., 1.}, {1., 1.}}}};
    const QGauss<1>                      rule(space.degree() + 2);
    std::vector<types::global_dof_index> nodes;
    for (unsigned int c = 0; c < scene.tractions.list.size(); ++c)
      {
        const BoundaryCondition &condition = *scene.tractions.list[c];
        const auto               ids       = mesh.side_ids(condition);
        unsigned int             n_faces   = 0;
        for (const auto &cell : mesh.own_cells())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                ids.count(cell->face(f)->boundary_id()) > 0 &&
                condition.in_box(cell->face(f)->center()))
              {
                ++n_faces;
                space.cell_nodes(cell, nodes);
                const auto &ends =
                  mesh.is_simplicial() ? faces_triangle[f] : faces_square[f];
                const double length = cell->face(f)->measure();
                for (unsigned int q = 0; q < rule.size(); ++q)
                  {
                    const Point<dim> unit =
                      ends[0] + rule.point(q)[0] * (ends[1] - ends[0]);
                    FacePoint point;
                    point.condition = c;
                    point.position =
                      mesh.mapping().transform_unit_to_real_cell(cell, unit);
                    point.weight = rule.weight(q) * length;
                    point.values.resize(nodes.size());
                    space.evaluate(cell, unit, point.values.data(), nullptr);
                    for (const types::global_dof_index node : nodes)
                      point.nodes.push_back(space.local_node(node));
                    face_points.push_back(point);
                  }
              }
        if (Utilities::MPI::sum(n_faces,
                                mesh.triangulation().get_communicator()) == 0)
          throw InputError(condition.parameter("Box"),
                           condition.part(),
                           "a part of the boundary with at least one face",
                           "this traction acts on no face: check its sides, "
                           "its box, and the size of the cells there");
      }
  }

  void
  Loads::evaluate(Vector       &force,
                  const Vector &weight_per_g,
                  const double  t) const
  {
    force = 0.;
    for (const FacePoint &point : face_points)
      for (unsigned int c = 0; c < dim; ++c)
        if (const auto &traction =
              scene.tractions.list[point.condition]->components[c])
          {
            const double f = traction->value(point.position, t) * point.weight;
            for (unsigned int i = 0; i < point.nodes.size(); ++i)
              force.local_element(dim * point.nodes[i] + c) +=
                f * point.values[i];
          }
    force.compress(VectorOperation::add);
    if (scene.gravity.acts())
      {
        const Tensor<1, dim> g = scene.gravity.at(t);
        for (unsigned int dof = 0; dof < force.locally_owned_size(); ++dof)
          force.local_element(dof) +=
            g[dof % dim] * weight_per_g.local_element(dof);
      }
  }
} // namespace geocone
