// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_simplex_table_h
#define geocone_output_simplex_table_h

#include <geocone/output/field_files.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Content of a field file on a mesh of triangles or tetrahedra. Cells do not share
   *  nodes: node p = n c + i is corner i of the n corners of cell c.
   *  @tparam Mesh Triangles or Tetrahedra */
  template <typename Mesh>
  struct SimplexTable : FieldTable
  {
    /** Number of corners of a cell. */
    static constexpr std::size_t corners =
      std::tuple_size_v<typename decltype(Mesh::cells)::value_type>;

    /** Creates a table without columns.
     *  @param mesh must outlive the table @param is_here whether this rank
     *  stores it */
    explicit SimplexTable(const Mesh &mesh, const bool is_here = true)
      : mesh(mesh)
    {
      cell    = corners == 3 ? Cell::triangle : Cell::tetrahedron;
      n_nodes = is_here ? corners * mesh.cells.size() : 0;
      positions =
        filled(dim,
               [&mesh](const unsigned int,
                       const unsigned int v,
                       const unsigned int d) { return mesh.vertices[v][d]; });
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

    /** Appends the values of the cells as a column. */
    void
    add_of_cells(const std::string &name, std::vector<double> values)
    {
      add(name,
          1,
          [values = std::move(values)](
            const std::size_t p, const unsigned int, const unsigned int) {
            return values[p / corners];
          });
    }

    /** Appends the contributions of the cells to the gap between two bounds, over
     *  their mean. @param gap by cell; empty: unknown */
    void
    add_parts_of_gap(std::vector<double> gap)
    {
      double total = 0.;
      for (const double part : gap)
        total += std::max(part, 0.);
      gap.resize(mesh.cells.size(), 0.);
      for (double &part : gap)
        part = total > 0. ? part / total * gap.size() : 0.;
      add_of_cells("part_of_gap", std::move(gap));
    }

    void
    add_materials()
    {
      add_of_cells("material", {mesh.material.begin(), mesh.material.end()});
    }

  private:
    template <typename Value>
    Fill
    filled(const unsigned int n_components, const Value &value) const
    {
      return [&of = mesh, n_components, value](std::vector<double> &to) {
        for (std::size_t i = 0; i < to.size(); ++i)
          {
            const std::size_t p = i / n_components;
            to[i] =
              value(p, of.cells[p / corners][p % corners], i % n_components);
          }
      };
    }

    const Mesh &mesh;
  };
} // namespace geocone::GEOCONE_DIM

#endif
