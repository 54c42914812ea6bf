// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/divided_at_chords.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Numbers of triangles that each vertex of the outline needs; zero elsewhere. */
    std::vector<unsigned int>
    needed_triangles(const CoarseMesh &mesh)
    {
      std::map<unsigned int, std::vector<unsigned int>> neighbours;
      for (const auto &[a, b] : mesh.outer_faces())
        {
          neighbours[a].push_back(b);
          neighbours[b].push_back(a);
        }
      constexpr double          rounding = 1e-9, slight = 0.5; // sines
      std::vector<unsigned int> needed(mesh.points.size(), 0);
      for (const auto &[v, others] : neighbours)
        {
          if (others.size() != 2)
            continue;
          const auto a        = mesh.points[v] - mesh.points[others[0]],
                     b        = mesh.points[others[1]] - mesh.points[v];
          const double size   = a.norm() * b.norm(),
                       sine   = std::abs(a[0] * b[1] - a[1] * b[0]) / size,
                       cosine = a * b / size;
          if (cosine > 0. && sine < slight)
            needed[v] = sine > rounding ? 3 : 0;
          else
            needed[v] = std::abs(cosine) > rounding ? 2 : 0;
        }
      return needed;
    }
  } // namespace

  CoarseMesh
  divided_at_chords(CoarseMesh mesh)
  {
    const std::vector<unsigned int> needed = needed_triangles(mesh);
    std::vector<unsigned int>       n_cells(mesh.points.size(), 0);
    for (const auto &cell : mesh.cells)
      for (const unsigned int v : cell.vertices)
        ++n_cells[v];
    const std::size_t n_before = mesh.cells.size();
    for (std::size_t c = 0; c < n_before; ++c)
      {
        const std::vector<unsigned int> v = mesh.cells[c].vertices;
        if (std::none_of(v.begin(), v.end(), [&](const unsigned int i) {
              return n_cells[i] < needed[i];
            }))
          continue;
        const unsigned int middle = mesh.points.size();
        mesh.points.push_back(mesh.centre(mesh.cells[c]));
        dealii::CellData<dim> part = mesh.cells[c];
        part.vertices              = {v[0], v[1], middle};
        mesh.cells[c]              = part;
        for (const auto &[i, j] : {std::pair(v[1], v[2]), {v[2], v[0]}})
          {
            part.vertices = {i, j, middle};
            mesh.cells.push_back(part);
          }
      }
    return mesh;
  }
} // namespace geocone::GEOCONE_DIM
