// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_triangle_table_h
#define geocone_output_triangle_table_h

#include <geocone/mesh/triangles.h>
#include <geocone/output/field_files.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Content of a field file on a triangle mesh. Triangles do not share nodes: node
   *  p = 3 c + i is corner i of cell c. */
  struct TriangleTable : FieldTable
  {
    /** Creates a table without columns.
     *  @param triangles must outlive the table @param is_here whether this rank
     *  stores them */
    explicit TriangleTable(const Triangles &triangles,
                           const bool       is_here = true)
      : triangles(triangles)
    {
      cell      = Cell::triangle;
      n_nodes   = is_here ? 3 * triangles.cells.size() : 0;
      positions = filled(dim,
                         [&triangles](const unsigned int,
                                      const unsigned int v,
                                      const unsigned int d) {
                           return triangles.vertices[v][d];
                         });
    }

    /** Appends a column. @param value function of the node, its vertex and the
     *  component */
    template <typename Value>
    void
    add(const std::string &name,
        const unsigned int n_components,
        const Value       &value)
    {
      columns.push_back({name, n_components, filled(n_components, value)});
    }

  private:
    template <typename Value>
    Fill
    filled(const unsigned int n_components, const Value &value) const
    {
      return [&of = triangles, n_components, value](std::vector<double> &to) {
        for (std::size_t i = 0; i < to.size(); ++i)
          {
            const std::size_t p = i / n_components;
            to[i] = value(p, of.cells[p / 3][p % 3], i % n_components);
          }
      };
    }

    const Triangles &triangles;
  };
} // namespace geocone::GEOCONE_DIM

#endif
