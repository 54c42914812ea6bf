// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/clipped.h>
#include <geocone/surfaces/side_points.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Half-spaces of the faces of a cell. */
    std::vector<SideOfPlane>
    planes_of(const BackgroundMesh::Cell &cell)
    {
      std::vector<SideOfPlane> planes;
      const Point<dim>   middle = cell->center();
      for (const unsigned int f : cell->face_indices())
        {
          SidePart part;
          for (unsigned int k = 0; k < dim; ++k)
            part.corners.push_back(cell->face(f)->vertex(k));
          const Point<dim>    &on   = part.corners[0];
          const Tensor<1, dim> into = area_of(part);
          planes.push_back({on, (middle - on) * into < 0. ? -into : into});
        }
      return planes;
    }

    /** Range of the line from a to b inside all planes. */
    std::pair<double, double>
    part_between(const std::vector<SideOfPlane> &planes,
                 const Point<dim>               &a,
                 const Point<dim>               &b)
    {
      std::vector<std::pair<double, double>> conditions;
      for (const auto &[on, into] : planes)
        conditions.push_back({(a - on) * into, (b - a) * into});
      return part_of_line(conditions);
    }
  } // namespace

  std::pair<double, double>
  part_of_line(const std::vector<std::pair<double, double>> &conditions)
  {
    double from = 0., to = 1.;
    for (const auto &[c, d] : conditions)
      if (d > 0.)
        from = std::max(from, -c / d);
      else if (d < 0.)
        to = std::min(to, -c / d);
      else if (c < 0.)
        to = from - 1.;
    return {from, to};
  }

  bool
  keep_nodes_with_mass(const Space                                &space,
                       const NodesWithMass                        &has_mass,
                       const std::vector<types::global_dof_index> &nodes,
                       std::vector<double>                        &values)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        if (!has_mass(space.local_node(nodes[i])))
          values[i] = 0.;
        sum += values[i];
      }
    if (!(sum > 1e-12))
      return false;
    for (double &value : values)
      value /= sum;
    return true;
  }

  std::vector<SidePart>
  pieces_between(const std::vector<SideOfPlane> &planes, const SidePart &facet)
  {
    SidePart rest = facet;
    if (dim == 2)
      {
        const Point<dim> &a = facet.corners[0], &b = facet.corners[1];
        const auto [from, to] = part_between(planes, a, b);
        if (!(to > from))
          return {};
        rest.corners = {a + from * (b - a), a + to * (b - a)};
      }
    else
      for (const auto &[on, into] : planes)
        rest.corners = clipped(rest.corners, on, into);
    return rest.simplices();
  }

  Quadrature<dim - 1>
  rule_of_facets()
  {
    if constexpr (dim == 2)
      return QGauss<dim - 1>(5);
    else
      {
        const QWitherdenVincentSimplex<dim - 1> of_triangle(4);
        std::vector<double>                     weights;
        for (const double weight : of_triangle.get_weights())
          weights.push_back(2. * weight);
        return Quadrature<dim - 1>(of_triangle.get_points(), weights);
      }
  }

  double
  longest_part_in_cell(const BackgroundMesh &mesh,
                       const Point<dim>     &a,
                       const Point<dim>     &b)
  {
    double longest = 0.;
    for (const auto &cell : mesh.own_cells())
      {
        const auto [from, to] = part_between(planes_of(cell), a, b);
        longest               = std::max(longest, to - from);
      }
    return a.distance(b) * Utilities::MPI::max(
                             longest, mesh.triangulation().get_communicator());
  }

  std::vector<double>
  for_each_point(
    const BackgroundMesh                                                &mesh,
    const Space                                                         &space,
    const std::vector<SidePart>                                         &facets,
    const std::function<void(const std::size_t, const BoundaryPoint &)> &f)
  {
    const Quadrature<dim - 1> rule = rule_of_facets();
    std::vector<double>       parts(facets.size(), 0.);
    // Bounding boxes select candidate cells. On a boundary of cells, a shift
    // into the body decides.
    std::vector<BoundingBox<dim>> boxes;
    std::vector<SidePart>         shifted = facets;
    for (SidePart &facet : shifted)
      {
        const Tensor<1, dim> area = area_of(facet);
        const double size = std::pow(area.norm(), 1. / (dim - 1)); // its length
        for (Point<dim> &corner : facet.corners)
          corner -= 1e-9 * size / area.norm() * area;
        boxes.emplace_back(facet.corners);
      }
    BoundaryPoint point;
    for (const auto &cell : mesh.own_cells())
      {
        const auto         box = cell->bounding_box();
        std::vector<SideOfPlane> planes;
        for (std::size_t t = 0; t < facets.size(); ++t)
          {
            bool meets = true;
            for (unsigned int d = 0; d < dim; ++d)
              meets = meets && boxes[t].lower_bound(d) <= box.upper_bound(d) &&
                      boxes[t].upper_bound(d) >= box.lower_bound(d);
            if (!meets)
              continue;
            if (planes.empty())
              {
                planes = planes_of(cell);
                space.cell_nodes(cell, point.nodes);
              }
            const double whole = area_of(shifted[t]).norm();
            for (const SidePart &piece : pieces_between(planes, shifted[t]))
              {
                const double share = area_of(piece).norm() / whole;
                if (!(share > 1e-12))
                  continue;
                parts[t] += share;
                for (unsigned int q = 0; q < rule.size(); ++q)
                  {
                    point.position  = piece.at(rule.point(q));
                    point.weight    = rule.weight(q) * share;
                    const auto unit = mesh.unit_point(cell, point.position);
                    if (!unit)
                      continue;
                    point.values.resize(space.nodes_per_cell());
                    space.evaluate(cell, *unit, point.values.data(), nullptr);
                    f(t, point);
                  }
              }
          }
      }
    return parts;
  }

  std::vector<BoundaryPoint>
  points_on(const BackgroundMesh &mesh,
            const Space          &space,
            const SidePart       &part)
  {
    const std::vector<SidePart> facets = part.simplices();
    std::vector<BoundaryPoint>  points;
    for_each_point(
      mesh, space, facets, [&](const std::size_t, const BoundaryPoint &point) {
        points.push_back(point);
        points.back().weight /= facets.size();
      });
    return points;
  }
} // namespace geocone::GEOCONE_DIM
