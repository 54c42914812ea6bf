// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/bisection.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Trace of a plane along z. */
    using Line = std::array<Point<dim>, 2>;

    bool
    is_upright(const Line &line)
    {
      return line[0][0] == line[1][0];
    }

    /** A conforming mesh of tetrahedra that are bisected at their longest edges. */
    class BisectedMesh
    {
    public:
      BisectedMesh(const Tetrahedra          &tetrahedra,
                   const std::vector<double> &error);

      std::size_t
      n_cells() const
      {
        return cells.size();
      }

      /** Bisects the cell with the largest error. @return whether there is one that may be
       *  bisected */
      bool
      bisect_largest();

      /** Divides all cells that cross a plane along z, see divided_at().
       *  @param size of the body (m) */
      void
      divide_at(const Line &line, const double size);

      /** Divides all cells with facets that are to be apart, see divided_between(). */
      void
      divide_between(const FacetPair &are_apart);

      CoarseMesh
      mesh(
        const std::map<std::string, dealii::types::boundary_id> &sides) const;

    private:
      using Edge =
        std::array<unsigned int, 2>; ///< vertices in increasing order

      struct Cell
      {
        std::array<unsigned int, 4> vertices;
        std::array<int, 4> side; ///< of the facet opposite to a vertex, or -1
        unsigned int       material, depth;
        double             error;
        std::array<unsigned int, 4>
          facet; ///< of the given mesh, or none, opposite to a vertex
      };

      /** Position of an edge in an order by length. Ties are broken by the vertices, so
       *  that cells with a common longest edge agree on it. */
      std::tuple<double, unsigned int, unsigned int>
      rank(const Edge &edge) const
      {
        return {
          points[edge[0]].distance_square(points[edge[1]]), edge[0], edge[1]};
      }

      Edge
      longest_edge(const unsigned int cell) const;

      std::vector<unsigned int>
      cells_around(const Edge &edge) const;

      /** Bisects all cells around the longest edge of a cell, after those of them with
       *  still longer edges. */
      void
      bisect(const unsigned int cell);

      /** Divides all cells around an edge at a point on it. */
      void
      divide(const Edge &edge, const Point<dim> &at);

      /** Replaces a vertex of a cell by the new point on the edge to another one. */
      static Cell
      part_of(Cell               cell,
              const unsigned int replaced,
              const unsigned int other,
              const unsigned int point);

      void
      put(const unsigned int place, const Cell &cell);

      std::vector<Point<dim>>                points;
      std::vector<Cell>                      cells;
      std::vector<std::vector<unsigned int>> cells_at; ///< of each vertex

      /** Cells by error; entries of cells bisected since then are outdated. */
      std::priority_queue<std::tuple<double, unsigned int, unsigned int>>
        largest;
    };

    BisectedMesh::BisectedMesh(const Tetrahedra          &tetrahedra,
                               const std::vector<double> &error)
      : points(tetrahedra.vertices)
      , cells_at(points.size())
    {
      AssertThrow(error.size() == tetrahedra.cells.size(),
                  dealii::ExcDimensionMismatch(error.size(),
                                               tetrahedra.cells.size()));
      std::vector<double> mean(points.size(), 0.), n(points.size(), 0.);
      for (unsigned int c = 0; c < error.size(); ++c)
        for (const unsigned int v : tetrahedra.cells[c])
          {
            mean[v] += std::max(error[c], 0.);
            n[v] += 1.;
          }
      for (unsigned int c = 0; c < error.size(); ++c)
        {
          Cell cell = {
            tetrahedra.cells[c], {}, tetrahedra.material[c], 0, 0., {}};
          for (unsigned int i = 0; i < 4; ++i)
            {
              cell.facet[i] = tetrahedra.facets_of_cell[c][i];
              cell.side[i]  = tetrahedra.facets[cell.facet[i]].side;
              cell.error += mean[cell.vertices[i]] / n[cell.vertices[i]] / 4.;
            }
          cells.emplace_back();
          for (const unsigned int v : cell.vertices)
            cells_at[v].push_back(c);
          put(c, cell);
        }
    }

    void
    BisectedMesh::put(const unsigned int place, const Cell &cell)
    {
      cells[place] = cell;
      if (cell.depth < 4)
        largest.push({cell.error, place, cell.depth});
    }

    BisectedMesh::Edge
    BisectedMesh::longest_edge(const unsigned int cell) const
    {
      const auto &v    = cells[cell].vertices;
      Edge        edge = {{0, 0}};
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (const Edge other = {{std::min(v[i], v[j]), std::max(v[i], v[j])}};
              edge[0] == edge[1] || rank(other) > rank(edge))
            edge = other;
      return edge;
    }

    std::vector<unsigned int>
    BisectedMesh::cells_around(const Edge &edge) const
    {
      std::vector<unsigned int> around;
      for (const unsigned int c : cells_at[edge[0]])
        if (const auto &v = cells[c].vertices;
            std::find(v.begin(), v.end(), edge[1]) != v.end())
          around.push_back(c);
      return around;
    }

    void
    BisectedMesh::bisect(const unsigned int cell)
    {
      const Edge edge = longest_edge(cell);
      for (bool waits = true; waits;)
        {
          waits = false;
          for (const unsigned int c : cells_around(edge))
            if (longest_edge(c) != edge)
              {
                bisect(c); // at a longer edge
                waits = true;
                break;
              }
        }
      const auto [a, b] = edge;
      divide(edge, Point<dim>(points[a] + (points[b] - points[a]) / 2.));
    }

    BisectedMesh::Cell
    BisectedMesh::part_of(Cell               cell,
                          const unsigned int replaced,
                          const unsigned int other,
                          const unsigned int point)
    {
      for (unsigned int i = 0; i < 4; ++i)
        if (cell.vertices[i] == replaced)
          cell.vertices[i] = point;
        else if (cell.vertices[i] == other)
          {
            cell.side[i]  = -1; // the facet between the parts
            cell.facet[i] = Tetrahedra::none;
          }
      ++cell.depth;
      cell.error *= std::pow(2., -4. / 3.);
      return cell;
    }

    void
    BisectedMesh::divide(const Edge &edge, const Point<dim> &at)
    {
      const auto [a, b]        = edge;
      const unsigned int point = points.size();
      points.push_back(at);
      cells_at.emplace_back();
      for (const unsigned int c : cells_around(edge))
        {
          const Cell         whole  = cells[c];
          const unsigned int second = cells.size();
          cells.emplace_back();
          put(c, part_of(whole, b, a, point));
          put(second, part_of(whole, a, b, point));
          for (const unsigned int v : whole.vertices)
            if (v == b)
              *std::find(cells_at[v].begin(), cells_at[v].end(), c) = second;
            else if (v != a)
              cells_at[v].push_back(second);
          cells_at[point].push_back(c);
          cells_at[point].push_back(second);
        }
    }

    void
    BisectedMesh::divide_at(const Line &line, const double size)
    {
      const double         tiny  = 1e-9 * size;
      const Tensor<1, dim> along = line[1] - line[0];
      Tensor<1, dim>       normal;
      normal[0] = along[1] / along.norm();
      normal[1] = -along[0] / along.norm();
      // Edges of the divided cells, which end on the plane, do not cross it.
      std::set<Edge> edges;
      for (const Cell &cell : cells)
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < i; ++j)
            edges.insert(Edge{{std::min(cell.vertices[i], cell.vertices[j]),
                               std::max(cell.vertices[i], cell.vertices[j])}});
      for (const Edge &edge : edges)
        {
          const Point<dim> &p = points[edge[0]], &q = points[edge[1]];
          const double      above = (p - line[0]) * normal,
                       below      = (q - line[0]) * normal;
          if (above * below >= 0. ||
              std::min(std::abs(above), std::abs(below)) <= tiny)
            continue;
          const Point<dim> at(p + above / (above - below) * (q - p));
          if (is_upright(line) ||
              (at[0] >= line[0][0] - tiny && at[0] <= line[1][0] + tiny))
            divide(edge, at);
        }
    }

    void
    BisectedMesh::divide_between(const FacetPair &are_apart)
    {
      const auto vertices_to_part =
        [&](const Cell &cell) -> std::optional<Edge> {
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (cell.facet[i] != Tetrahedra::none &&
                cell.facet[j] != Tetrahedra::none &&
                are_apart(cell.facet[i], cell.facet[j]))
              return Edge{{std::min(cell.vertices[i], cell.vertices[j]),
                           std::max(cell.vertices[i], cell.vertices[j])}};
        return std::nullopt;
      };
      for (unsigned int c = 0; c < cells.size();)
        if (const std::optional<Edge> edge = vertices_to_part(cells[c]))
          {
            const auto [a, b] = *edge;
            divide(*edge, Point<dim>(points[a] + (points[b] - points[a]) / 2.));
          }
        else
          ++c;
    }

    bool
    BisectedMesh::bisect_largest()
    {
      while (!largest.empty())
        {
          const auto [error, cell, depth] = largest.top();
          largest.pop();
          if (cells[cell].depth == depth)
            {
              bisect(cell);
              return true;
            }
        }
      return false;
    }

    CoarseMesh
    BisectedMesh::mesh(
      const std::map<std::string, dealii::types::boundary_id> &sides) const
    {
      CoarseMesh mesh;
      mesh.points = points;
      mesh.sides  = sides;
      for (const Cell &cell : cells)
        {
          const auto &v = cell.vertices;
          mesh.cells.emplace_back(4);
          mesh.cells.back().vertices.assign(v.begin(), v.end());
          mesh.cells.back().material_id = cell.material;
          for (unsigned int i = 0; i < 4; ++i)
            if (cell.side[i] >= 0)
              mesh.add_boundary({{v[(i + 1) % 4],
                                  v[(i + 2) % 4],
                                  v[(i + 3) % 4],
                                  CoarseMesh::no_vertex}},
                                cell.side[i]);
        }
      return mesh;
    }
  } // namespace

  CoarseMesh
  bisected(const Tetrahedra          &tetrahedra,
           const std::vector<double> &error,
           const std::size_t          n_wanted)
  {
    BisectedMesh mesh(tetrahedra, error);
    while (mesh.n_cells() < n_wanted && mesh.bisect_largest())
      {}
    return mesh.mesh(tetrahedra.sides);
  }

  CoarseMesh
  divided_between(const Tetrahedra &tetrahedra, const FacetPair &are_apart)
  {
    BisectedMesh mesh(tetrahedra,
                      std::vector<double>(tetrahedra.cells.size(), 0.));
    mesh.divide_between(are_apart);
    return mesh.mesh(tetrahedra.sides);
  }

  CoarseMesh
  divided_at(const Tetrahedra &tetrahedra, const MeshLines &lines)
  {
    BisectedMesh                   mesh(tetrahedra,
                      std::vector<double>(tetrahedra.cells.size(), 0.));
    const dealii::BoundingBox<dim> body(tetrahedra.vertices);
    const auto [low, high] = body.get_boundary_points();
    for (const bool first :
         {true, false}) // no edge crosses two of the others then
      for (const auto &line : lines)
        if (is_upright(line) == first)
          mesh.divide_at(line, low.distance(high));
    return mesh.mesh(tetrahedra.sides);
  }
} // namespace geocone::GEOCONE_DIM
