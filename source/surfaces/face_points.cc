// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/surfaces/face_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Quadrature on the reference face, exact for degree 2p + 3. */
    template <int face_dim>
    Quadrature<face_dim>
    rule_of_face(const bool simplicial, const unsigned int p)
    {
      if constexpr (face_dim == 2)
        if (simplicial)
          return QWitherdenVincentSimplex<face_dim>(p + 2);
      return QGauss<face_dim>(p + 2);
    }

    /** A face of the reference cell: its first vertex, the edges from there,
     *  and the outward normal times dA relative to the integral of the
     *  quadrature. */
    struct UnitFace
    {
      UnitFace(const bool simplicial, const unsigned int face)
      {
        if (!simplicial)
          {
            const unsigned int d = face / 2;
            start[d]             = face % 2;
            area[d]              = face % 2 == 0 ? -1. : 1.;
            for (unsigned int c = 0, k = 0; c < dim; ++c)
              if (c != d)
                edge[k++][c] = 1.;
            return;
          }
        // Vertices as numbered in the reference cells, the first of which is
        // the origin.
        static constexpr unsigned int vertices[2][4][3] = {
          {{0, 1, 0}, {1, 2, 0}, {2, 0, 0}, {0, 0, 0}},
          {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}};
        const auto &v      = vertices[dim - 2][face];
        const auto  vertex = [](const unsigned int i) {
          Point<dim> x;
          if (i > 0)
            x[i - 1] = 1.;
          return x;
        };
        start = vertex(v[0]);
        Point<dim> sum;
        for (unsigned int k = 0; k + 1 < dim; ++k)
          edge[k] = vertex(v[k + 1]) - start;
        for (unsigned int k = 0; k < dim; ++k)
          sum += vertex(v[k]);
        // On a face through the origin one coordinate is zero.
        const bool is_oblique =
          std::all_of(v, v + dim, [](const unsigned int i) { return i > 0; });
        for (unsigned int d = 0; d < dim; ++d)
          area[d] = is_oblique ? 1. : sum[d] == 0. ? -1. : 0.;
      }

      Point<dim>
      place(const Point<dim - 1> &s) const
      {
        Point<dim> x = start;
        for (unsigned int k = 0; k + 1 < dim; ++k)
          x += s[k] * edge[k];
        return x;
      }

      Point<dim>     start;
      Tensor<1, dim> edge[dim - 1], area;
    };
  } // namespace

  std::optional<UnitPart>
  part_of_face(const BoundaryCondition    &condition,
               const BackgroundMesh       &mesh,
               const BackgroundMesh::Cell &cell,
               const unsigned int          face)
  {
    if (!condition.formula_holds(cell->face(face)->center()))
      return std::nullopt;
    const auto box = condition.wide_box();
    if (!box)
      return UnitPart::whole();
    // A smaller part of a face is rounding.
    constexpr double least = 1e-6;
    const UnitFace   unit_face(mesh.is_simplicial(), face);
    const auto       place = [&](const Point<dim - 1> &s) {
      return mesh.mapping().transform_unit_to_real_cell(cell,
                                                        unit_face.place(s));
    };
    const Point<dim>            start = place(Point<dim - 1>());
    std::vector<Tensor<1, dim>> edges;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      edges.push_back(place(Point<dim - 1>::unit_vector(k)) - start);

    UnitPart part       = UnitPart::whole();
    bool     is_oblique = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // In space, a coordinate that bounds the part may increase along one
        // edge only.
        unsigned int grows = 0, n_grow = 0;
        double       size = 0.;
        for (unsigned int k = 0; k + 1 < dim; ++k)
          size = std::max(size, edges[k].norm());
        for (unsigned int k = 0; k + 1 < dim; ++k)
          if (std::abs(edges[k][d]) > least * size)
            {
              grows = k;
              ++n_grow;
            }
        double low = start[d], high = start[d];
        for (const Tensor<1, dim> &edge : edges)
          (edge[d] < 0. ? low : high) += edge[d];
        if (low > (*box)[1][d] || high < (*box)[0][d])
          return std::nullopt;
        if (n_grow == 0 || (low >= (*box)[0][d] && high <= (*box)[1][d]))
          continue;
        is_oblique        = is_oblique || n_grow > 1;
        const double a    = ((*box)[0][d] - start[d]) / edges[grows][d],
                     b    = ((*box)[1][d] - start[d]) / edges[grows][d];
        part.lower[grows] = std::max(part.lower[grows], std::min(a, b));
        part.upper[grows] = std::min(part.upper[grows], std::max(a, b));
      }
    if (dim == 3 && (is_oblique || mesh.is_simplicial()) &&
        (part.lower.norm() > 0. ||
         part.upper.distance(UnitPart::whole().upper) > 0.))
      throw InputError(condition.parameter("Box"),
                       condition.part(),
                       "a box that does not cut the face at (" +
                         text_of_place(cell->face(face)->center()) + ")",
                       "let it end where faces end, or give the part a name "
                       "of its own in the file of the mesh");
    for (unsigned int k = 0; k + 1 < dim; ++k)
      if (part.upper[k] - part.lower[k] < least)
        return std::nullopt;
    return part;
  }

  std::vector<FacePoint>
  points_on_face(const BackgroundMesh       &mesh,
                 const Space                &space,
                 const BackgroundMesh::Cell &cell,
                 const unsigned int          face,
                 const UnitPart             &part)
  {
    double share = 1.; // of the face
    for (unsigned int k = 0; k + 1 < dim; ++k)
      share *= part.upper[k] - part.lower[k];
    const Quadrature<dim - 1> rule =
      rule_of_face<dim - 1>(mesh.is_simplicial(), space.degree());
    const UnitFace unit_face(mesh.is_simplicial(), face);

    std::vector<types::global_dof_index> nodes;
    space.cell_nodes(cell, nodes);
    std::vector<FacePoint> points(rule.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        FacePoint     &point = points[q];
        Point<dim - 1> at    = rule.point(q);
        for (unsigned int k = 0; k + 1 < dim; ++k)
          at[k] = part.lower[k] + at[k] * (part.upper[k] - part.lower[k]);
        const Point<dim> unit = unit_face.place(at);
        point.position = mesh.mapping().transform_unit_to_real_cell(cell, unit);
        // Nanson's formula, n dA = det(J) J^-T N dA_0.
        const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
        const Tensor<1, dim> area =
          transpose(inverse) * unit_face.area / std::abs(determinant(inverse));
        point.normal = area / area.norm();
        point.weight =
          rule.weight(q) * share * area.norm() * mesh.measure(point.position);
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
} // namespace geocone::GEOCONE_DIM
