// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/mechanics/face_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <array>

namespace geocone
{
  using namespace dealii;

  std::vector<FacePoint>
  points_on_face(const BackgroundMesh       &mesh,
                 const Space                &space,
                 const BackgroundMesh::Cell &cell,
                 const unsigned int          face)
  {
    // Unit vertices of the faces, in the numbering of the reference cells.
    using Ends                   = std::array<Point<dim>, 2>;
    static const Ends triangle[] = {
      {{{0., 0.}, {1., 0.}}}, {{{1., 0.}, {0., 1.}}}, {{{0., 1.}, {0., 0.}}}};
    static const Ends square[] = {{{{0., 0.}, {0., 1.}}},
                                  {{{1., 0.}, {1., 1.}}},
                                  {{{0., 0.}, {1., 0.}}},
                                  {{{0., 1.}, {1., 1.}}}};
    const Ends  &ends   = mesh.is_simplicial() ? triangle[face] : square[face];
    const auto   side   = cell->face(face);
    const double length = side->measure();

    const Tensor<1, dim> along = side->vertex(1) - side->vertex(0);
    Tensor<1, dim>       normal({along[1], -along[0]});
    normal /= normal.norm();
    if (normal * (side->center() - cell->center()) < 0.)
      normal *= -1.;

    std::vector<types::global_dof_index> nodes;
    space.cell_nodes(cell, nodes);
    const QGauss<1>        rule(space.degree() + 2);
    std::vector<FacePoint> points(rule.size());
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        FacePoint       &point = points[q];
        const Point<dim> unit =
          ends[0] + rule.point(q)[0] * (ends[1] - ends[0]);
        point.position = mesh.mapping().transform_unit_to_real_cell(cell, unit);
        point.normal   = normal;
        point.weight   = rule.weight(q) * length * mesh.measure(point.position);
        point.values.resize(nodes.size());
        space.evaluate(cell, unit, point.values.data(), nullptr);
        for (const types::global_dof_index node : nodes)
          point.nodes.push_back(space.local_node(node));
      }
    return points;
  }

  void
  refuse_no_face(const BoundaryCondition &condition,
                 const unsigned int       n_faces,
                 const MPI_Comm           comm,
                 const std::string       &what)
  {
    if (Utilities::MPI::sum(n_faces, comm) == 0)
      throw InputError(condition.parameter("Box"),
                       condition.part(),
                       "a part of the boundary with at least one face",
                       what + ": check its sides, its box, and the size of the "
                              "cells there");
  }
} // namespace geocone
