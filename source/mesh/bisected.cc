// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/bisected.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Ends   = std::array<unsigned int, 2>;
    using Corner = std::array<unsigned int, 3>;

    Ends
    ends_of(const unsigned int a, const unsigned int b)
    {
      return {{std::min(a, b), std::max(a, b)}};
    }

    /** Vertices of each triangle, its longest edge from the second to the third. */
    std::vector<Corner>
    corners_of_longest_edges(const CoarseMesh &mesh)
    {
      const auto order = [&](const unsigned int a, const unsigned int b) {
        const Ends ends = ends_of(a, b);
        return std::make_tuple(
          mesh.points[a].distance_square(mesh.points[b]), ends[0], ends[1]);
      };
      std::vector<Corner> corners;
      for (const auto &cell : mesh.cells)
        {
          Corner v = {{cell.vertices[0], cell.vertices[1], cell.vertices[2]}};
          while (order(v[1], v[2]) < order(v[0], v[1]) ||
                 order(v[1], v[2]) < order(v[0], v[2]))
            std::rotate(v.begin(), v.begin() + 1, v.end());
          corners.push_back(v);
        }
      return corners;
    }
  } // namespace

  NestedMesh::NestedMesh(const CoarseMesh &first)
    : mesh(first)
    , parent(first.cells.size())
  {
    std::iota(parent.begin(), parent.end(), 0U);
  }

  namespace
  {
    /** Mesh with the marked triangles bisected, made conforming. */
    NestedMesh
    with_bisected(const NestedMesh &nested, const std::vector<bool> &marked)
    {
      const CoarseMesh         &mesh    = nested.mesh;
      const std::vector<Corner> corners = corners_of_longest_edges(mesh);
      CoarseMesh                next;
      next.points = mesh.points;
      next.sides  = mesh.sides;
      std::map<Ends, unsigned int> middles;
      const auto                   divide = [&](const Corner &v) {
        const auto [entry, is_new] =
          middles.emplace(ends_of(v[1], v[2]), next.points.size());
        if (is_new)
          next.points.push_back(
            dealii::Point<dim>((mesh.points[v[1]] + mesh.points[v[2]]) / 2.));
        return is_new;
      };
      for (unsigned int c = 0; c < corners.size(); ++c)
        if (marked[c])
          divide(corners[c]);
      const auto is_divided = [&](const unsigned int a, const unsigned int b) {
        return middles.count(ends_of(a, b)) > 0;
      };
      for (bool grows = true; grows;)
        {
          grows = false;
          for (const Corner &v : corners)
            if (is_divided(v[0], v[1]) || is_divided(v[0], v[2]))
              grows = divide(v) || grows;
        }
      NestedMesh result((CoarseMesh()));
      for (unsigned int c = 0; c < corners.size(); ++c)
        {
          const auto add = [&](const unsigned int i,
                               const unsigned int j,
                               const unsigned int k) {
            dealii::CellData<dim> part(3);
            part.vertices    = {i, j, k};
            part.material_id = mesh.cells[c].material_id;
            next.cells.push_back(part);
            result.parent.push_back(nested.parent[c]);
          };
          const auto [a, b, d] = corners[c];
          if (!is_divided(b, d))
            {
              add(a, b, d);
              continue;
            }
          const unsigned int m = middles.at(ends_of(b, d));
          for (const auto &[i, j] : {Ends{{a, b}}, Ends{{d, a}}})
            if (!is_divided(i, j))
              add(i, j, m);
            else
              {
                const unsigned int n = middles.at(ends_of(i, j));
                add(i, n, m);
                add(n, j, m);
              }
        }
      for (const auto &line : mesh.boundary.boundary_lines)
        {
          const unsigned int a = line.vertices[0], b = line.vertices[1];
          if (!is_divided(a, b))
            {
              next.add_boundary(ends_of(a, b), line.boundary_id);
              continue;
            }
          const unsigned int m = middles.at(ends_of(a, b));
          next.add_boundary(ends_of(a, m), line.boundary_id);
          next.add_boundary(ends_of(b, m), line.boundary_id);
        }
      result.mesh = std::move(next);
      return result;
    }

    /** Marks the triangles with most of an error measure, a third of all at most. */
    std::vector<bool>
    largest(const std::vector<double> &error, const std::size_t most)
    {
      constexpr double          part = 0.8;
      std::vector<unsigned int> order(error.size());
      std::iota(order.begin(), order.end(), 0U);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
        return error[a] > error[b];
      });
      const double      total = std::accumulate(error.begin(), error.end(), 0.);
      std::vector<bool> marked(error.size(), false);
      double            sum = 0.;
      for (std::size_t i = 0;
           i <= std::min(order.size() / 3, most) && sum <= part * total;
           ++i)
        {
          marked[order[i]] = true;
          sum += error[order[i]];
        }
      return marked;
    }
  } // namespace

  NestedMesh
  bisected(NestedMesh          nested,
           std::vector<double> error,
           const std::size_t   n_wanted)
  {
    // Triangles added per marked one, and (1/2)^(3/2).
    constexpr double added = 1.7, of_half = 0.35355339059327373;
    while (nested.mesh.cells.size() < n_wanted &&
           std::any_of(error.begin(), error.end(), [](const double of_cell) {
             return of_cell > 0.;
           }))
      {
        const std::size_t most = (n_wanted - nested.mesh.cells.size()) / added;
        // Of this mesh, not of the first one.
        NestedMesh next =
          with_bisected(NestedMesh(nested.mesh), largest(error, most));
        std::vector<unsigned int> n_parts(error.size(), 0);
        for (const unsigned int c : next.parent)
          ++n_parts[c];
        std::vector<double> of_parts;
        for (unsigned int &c : next.parent)
          {
            of_parts.push_back(error[c] * (n_parts[c] == 1 ? 1.
                                           : n_parts[c] == 2
                                             ? of_half
                                             : of_half * of_half));
            c = nested.parent[c];
          }
        error  = std::move(of_parts);
        nested = std::move(next);
      }
    return nested;
  }
} // namespace geocone::GEOCONE_DIM
