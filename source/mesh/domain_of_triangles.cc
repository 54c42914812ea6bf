// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/domain_of_triangles.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Whether b lies between a and c on the line through them. */
    bool
    is_on_way(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c)
    {
      const Tensor<1, dim> to = b - a, on = c - b;
      return to * on > 0. && std::abs(to[0] * on[1] - to[1] * on[0]) <=
                               1e-9 * to.norm() * on.norm();
    }

    /** Edges between materials, and their number at each vertex. */
    class BorderEdges
    {
    public:
      explicit BorderEdges(const Triangles &triangles)
        : edges(triangles.edges_between_materials())
        , at_vertex(triangles.vertices.size())
      {
        for (unsigned int e = 0; e < edges.size(); ++e)
          for (const unsigned int v : edges[e])
            at_vertex[v].push_back(e);
      }

      /** Straight lines along which materials meet. @param stays vertices that
       *  end one */
      MeshLines
      lines(const std::vector<Point<dim>> &x,
            const std::set<unsigned int>  &stays)
      {
        MeshLines         all;
        std::vector<bool> used(edges.size(), false);
        for (unsigned int e = 0; e < edges.size(); ++e)
          {
            if (used[e])
              continue;
            used[e]                          = true;
            std::array<unsigned int, 2> ends = edges[e];
            for (const unsigned int end : {0, 1})
              {
                unsigned int before = edges[e][1 - end];
                while (at_vertex[ends[end]].size() == 2 &&
                       stays.count(ends[end]) == 0)
                  {
                    const auto        &both = at_vertex[ends[end]];
                    const unsigned int next = used[both[0]] ? both[1] : both[0];
                    const unsigned int to =
                      edges[next][edges[next][0] == ends[end] ? 1 : 0];
                    if (used[next] ||
                        !is_on_way(x[before], x[ends[end]], x[to]))
                      break;
                    used[next] = true;
                    before     = ends[end];
                    ends[end]  = to;
                  }
              }
            all.push_back({{x[ends[0]], x[ends[1]]}});
          }
        return all;
      }

      bool
      meet_at(const unsigned int vertex) const
      {
        return !at_vertex[vertex].empty();
      }

    private:
      std::vector<std::array<unsigned int, 2>> edges;
      std::vector<std::vector<unsigned int>>   at_vertex;
    };

    /** Materials by place. */
    class MaterialPlaces
    {
    public:
      explicit MaterialPlaces(const Triangles &triangles)
        : triangles(triangles)
      {
        std::vector<std::pair<Box, unsigned int>> boxes;
        for (unsigned int c = 0; c < triangles.cells.size(); ++c)
          {
            std::vector<Point<dim>> corners;
            for (const unsigned int v : triangles.cells[c])
              corners.push_back(triangles.vertices[v]);
            Box box(corners);
            box.extend(1e-9 * box.side_length(0));
            boxes.emplace_back(box, c);
          }
        tree = dealii::pack_rtree(boxes);
      }

      /** The material of the triangle at x. */
      unsigned int
      at(const Point<dim> &x) const
      {
        namespace index = boost::geometry::index;
        std::vector<std::pair<Box, unsigned int>> around;
        tree.query(index::intersects(x), std::back_inserter(around));
        if (around.empty())
          tree.query(index::nearest(x, 1), std::back_inserter(around));
        double       most     = -std::numeric_limits<double>::max();
        unsigned int material = 0;
        for (const auto &[box, c] : around)
          {
            // Negative outside.
            double least = 1.;
            for (unsigned int i = 0; i < 3; ++i)
              {
                const auto &v = triangles.cells[c];
                const auto &a = triangles.vertices[v[i]],
                           &b = triangles.vertices[v[(i + 1) % 3]];
                least         = std::min(least,
                                 ((b[0] - a[0]) * (x[1] - a[1]) -
                                  (b[1] - a[1]) * (x[0] - a[0])) /
                                   triangles.area(c));
              }
            if (least > most)
              {
                most     = least;
                material = triangles.material[c];
              }
          }
        return material;
      }

    private:
      using Box = dealii::BoundingBox<dim>;

      const Triangles                            &triangles;
      dealii::RTree<std::pair<Box, unsigned int>> tree;
    };

    /** Boundary edges by their first vertex, with the body to the left. */
    struct EdgeFrom
    {
      unsigned int to;
      int          side;
    };
    using Boundary = std::map<unsigned int, EdgeFrom>;

    /** @return whether no two edges begin at the same vertex */
    bool
    find_boundary(const Triangles &triangles, Boundary &boundary)
    {
      std::vector<unsigned int> n_cells(triangles.edges.size(), 0);
      for (const auto &edges : triangles.edges_of_cell)
        for (const unsigned int e : edges)
          ++n_cells[e];
      bool is_simple = true;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          if (const unsigned int e = triangles.edges_of_cell[c][i];
              n_cells[e] == 1)
            is_simple = boundary
                          .emplace(triangles.cells[c][(i + 1) % 3],
                                   EdgeFrom{triangles.cells[c][(i + 2) % 3],
                                            triangles.edges[e].side})
                          .second &&
                        is_simple;
      return is_simple;
    }
  } // namespace

  DomainOfTriangles::DomainOfTriangles(
    const Triangles                               &triangles,
    const std::function<bool(const Point<dim> &)> &is_end)
    : triangles(triangles)
  {
    const auto &x = triangles.vertices;
    Boundary    boundary;
    if (!find_boundary(triangles, boundary))
      {
        why_not = "parts of the body touch in a point";
        return;
      }
    for (const auto &[from, edge] : boundary)
      if (edge.side >= 0)
        sides.push_back(
          {{{x[from], x[edge.to]}}, dealii::types::boundary_id(edge.side)});
    BorderEdges            border(triangles);
    std::set<unsigned int> on_boundary;
    while (!boundary.empty())
      {
        std::vector<unsigned int> vertices;
        std::vector<int>          ids;
        for (auto edge = boundary.begin(); edge != boundary.end();)
          {
            vertices.push_back(edge->first);
            ids.push_back(edge->second.side);
            const unsigned int to = edge->second.to;
            boundary.erase(edge);
            edge = boundary.find(to);
          }
        on_boundary.insert(vertices.begin(), vertices.end());
        Polygon           loop;
        const std::size_t n = vertices.size();
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::size_t before = (i + n - 1) % n;
            const auto       &here   = x[vertices[i]];
            if (ids[before] != ids[i] || border.meet_at(vertices[i]) ||
                is_end(here) ||
                !is_on_way(x[vertices[before]], here, x[vertices[(i + 1) % n]]))
              loop.push_back(here);
          }
        if (signed_area(loop) < 0.)
          domain.holes.push_back(loop);
        else if (domain.outline.empty())
          domain.outline = loop;
        else
          why_not = "the body has several parts";
      }
    borders = border.lines(x, on_boundary);
  }

  CoarseMesh
  DomainOfTriangles::mesh(const CellSizes &sizes,
                          MeshLines        lines,
                          const int        algorithm,
                          const MPI_Comm   comm) const
  {
    MeshDomain by_gmsh = domain;
    by_gmsh.algorithm  = algorithm;
    lines.insert(lines.end(), borders.begin(), borders.end());
    CoarseMesh mesh = mesh_with_sizes(by_gmsh, Regions({}), lines, sizes, comm);
    const MaterialPlaces places(triangles);
    for (auto &cell : mesh.cells)
      cell.material_id = places.at(mesh.centre(cell));
    for (const CoarseMesh::Face &face : mesh.outer_faces())
      {
        const Point<dim> middle  = mesh.centre(face);
        const Side      *nearest = nullptr;
        double           least =
          1e-6 * mesh.points[face[0]].distance(mesh.points[face[1]]);
        for (const Side &side : sides)
          if (const double d =
                distance_to_segment(middle, side.ends[0], side.ends[1]);
              d <= least)
            {
              least   = d;
              nearest = &side;
            }
        if (nearest != nullptr)
          mesh.add_boundary(face, nearest->id);
      }
    mesh.sides = triangles.sides;
    return mesh;
  }

  DomainOfTriangles
  domain_of_file(const Triangles &triangles, const Scene &scene)
  {
    return DomainOfTriangles(triangles, [&](const Point<dim> &x) {
      for (const BoundaryConditions *const conditions :
           {&scene.dirichlet, &scene.tractions})
        for (const auto &condition : conditions->list)
          if (const auto box = condition->wide_box())
            for (unsigned int d = 0; d < dim; ++d)
              {
                // The box is enlarged by rounding.
                const double rounding =
                  3. * ((*condition->box_corners())[0][d] - (*box)[0][d]);
                if (std::abs(x[d] - (*box)[0][d]) < rounding ||
                    std::abs(x[d] - (*box)[1][d]) < rounding)
                  return true;
              }
      return false;
    });
  }
} // namespace geocone::GEOCONE_DIM
