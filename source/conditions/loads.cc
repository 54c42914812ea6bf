// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conditions/loads.h>
#include <geocone/materials/retention.h>
#include <geocone/points/quadrature_points.h>

#include <deal.II/base/quadrature_lib.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  integrate_density(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    const MaterialPoints &points,
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
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        values.reinit(points.cells[c]);
        space.cell_nodes(points.cells[c], nodes);
        const unsigned int  material = points.material[points.first_point[c]];
        std::vector<double> rho; // at quadrature points
        for (const Point<dim> &x : values.position)
          rho.push_back(scene.density(material, x));
        std::vector<double> row_sum(nodes.size(), 0.);
        std::vector<double> diagonal(nodes.size(), 0.);
        double              total = 0., trace = 0.;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            for (unsigned int q = 0; q < values.weight.size(); ++q)
              {
                const double N = values.value(i, q);
                row_sum[i] += rho[q] * N * values.weight[q];
                diagonal[i] += rho[q] * N * N * values.weight[q];
              }
            total += row_sum[i];
            trace += diagonal[i];
          }
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int dof = dim * space.local_node(nodes[i]) + d;
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
               const Space          &space,
               const MaterialPoints &points)
    : scene(scene)
  {
    if (scene.water.acts())
      {
        CellValues values(space,
                          mesh,
                          mesh.is_simplicial()
                            ? Quadrature<dim>(QWitherdenVincentSimplex<dim>(3))
                            : Quadrature<dim>(QGauss<dim>(space.degree() + 1)));
        of_water.resize(scene.water.interpolation_weights(0.).size());
        for (Vector &of_line : of_water)
          of_line.reinit(space.partitioner());
        std::vector<types::global_dof_index> nodes;
        for (const auto &cell : points.cells)
          {
            values.reinit(cell);
            space.cell_nodes(cell, nodes);
            for (unsigned int q = 0; q < values.weight.size(); ++q)
              for (unsigned int line = 0; line < of_water.size(); ++line)
                {
                  const Tensor<1, dim> f =
                    values.weight[q] *
                    scene.water.force(values.position[q], line);
                  for (unsigned int i = 0; i < nodes.size(); ++i)
                    for (unsigned int d = 0; d < dim; ++d)
                      of_water[line].local_element(
                        dim * space.local_node(nodes[i]) + d) +=
                        f[d] * values.value(i, q);
                }
          }
        if (scene.water.has_suction())
          add_suction(mesh, space, points, values);
        for (Vector &of_line : of_water)
          of_line.compress(VectorOperation::add);
      }
    const std::vector<bool> is_there = mesh.marked_cells(points.cells);
    for (unsigned int c = 0; c < scene.tractions.list.size(); ++c)
      {
        const BoundaryCondition &condition = *scene.tractions.list[c];
        const unsigned int       n_faces   = for_each_face_point(
          mesh,
          space,
          condition,
          [&](const BackgroundMesh::Cell &cell, const FacePoint &point) {
            if (is_there[cell->active_cell_index()])
              loaded.push_back({c, point});
          });
        refuse_no_face(condition,
                       n_faces,
                       mesh.triangulation().get_communicator(),
                       "this traction acts on no face");
      }
  }

  void
  Loads::add_suction(const BackgroundMesh &mesh,
                     const Space          &space,
                     const MaterialPoints &points,
                     CellValues           &values)
  {
    std::vector<types::global_dof_index> nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const Retention &soil =
          scene.materials.law(points.material[points.first_point[c]])
            .retention();
        if (!soil.adds_strength())
          continue;
        values.reinit(points.cells[c]);
        space.cell_nodes(points.cells[c], nodes);
        for (unsigned int q = 0; q < values.weight.size(); ++q)
          for (unsigned int line = 0; line < of_water.size(); ++line)
            {
              const Point<dim> &x = values.position[q];
              const double      p =
                values.weight[q] * scene.water.suction_stress(x, soil, line);
              for (unsigned int i = 0; i < nodes.size(); ++i)
                {
                  Tensor<1, dim> divergence = values.gradient(i, q);
                  if (mesh.is_axisymmetric())
                    divergence[0] += values.value(i, q) / x[0];
                  for (unsigned int d = 0; d < dim; ++d)
                    of_water[line].local_element(
                      dim * space.local_node(nodes[i]) + d) +=
                      p * divergence[d];
                }
            }
      }
  }

  void
  Loads::evaluate(Vector       &force,
                  const Vector &weight_per_g,
                  const double  t,
                  const Stage  *stage,
                  const bool    scaled) const
  {
    const auto counts = [&](const std::string &load) {
      return stage == nullptr || stage->scales(load) == scaled;
    };
    std::vector<bool> acts;
    for (const auto &condition : scene.tractions.list)
      acts.push_back(counts(condition->name));
    force = 0.;
    for (const auto &[c, point] : loaded)
      {
        if (!acts[c])
          continue;
        const Tensor<1, dim> traction =
          scene.tractions.list[c]->vector_at(point.position, point.normal, t);
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (traction[d] == 0.)
              continue;
            const double f = traction[d] * point.weight;
            for (unsigned int i = 0; i < point.nodes.size(); ++i)
              force.local_element(dim * point.nodes[i] + d) +=
                f * point.values[i];
          }
      }
    force.compress(VectorOperation::add);
    if (scene.gravity.acts())
      {
        const Tensor<1, dim> g = scene.gravity.at(t);
        if (counts("weight"))
          for (unsigned int dof = 0; dof < force.locally_owned_size(); ++dof)
            force.local_element(dof) +=
              g[dof % dim] * weight_per_g.local_element(dof);
        if (scene.water.acts() &&
            (scene.water.scales_with_weight() ? counts("weight") : !scaled))
          {
            const std::vector<double> parts =
              scene.water.interpolation_weights(t);
            for (unsigned int line = 0; line < of_water.size(); ++line)
              if (parts[line] != 0.)
                force.add(parts[line] * g[1] / scene.gravity.at(1e300)[1],
                          of_water[line]);
          }
      }
  }
} // namespace geocone::GEOCONE_DIM
