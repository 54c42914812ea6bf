// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conditions/jacobian_pattern.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Sorted local nodes that share a cell, a group or a link with each local
     *  node. */
    std::vector<std::vector<unsigned int>>
    nodes_that_meet(const MaterialPoints                         &points,
                    const unsigned int                            n_local_nodes,
                    const std::vector<std::vector<unsigned int>> &groups,
                    const std::vector<std::vector<unsigned int>> &links)
    {
      // First the cells of each node, then the nodes of these cells.
      const unsigned int                     n = points.n_nodes;
      std::vector<std::vector<unsigned int>> neighbours(n_local_nodes);
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int i = 0; i < n; ++i)
          {
            auto &list = neighbours[points.nodes[c * n + i]];
            list.insert(
              list.end(), &points.nodes[c * n], &points.nodes[c * n] + n);
          }
      for (const auto &group : groups)
        for (const unsigned int node : group)
          neighbours[node].insert(
            neighbours[node].end(), group.begin(), group.end());
      for (unsigned int node = 0; node < n_local_nodes; ++node)
        // All points of an owned node may be on other ranks.
        neighbours[node].push_back(node);
      for (const auto &link : links)
        for (auto other = link.begin() + 1; other != link.end(); ++other)
          {
            const auto &of_node = neighbours[link.front()];
            auto       &list    = neighbours[*other];
            list.insert(list.end(), of_node.begin(), of_node.end());
            list.insert(list.end(), link.begin(), link.end());
          }
      for (const auto &link : links)
        neighbours[link.front()].insert(
          neighbours[link.front()].end(), link.begin(), link.end());
      for (auto &list : neighbours)
        {
          std::sort(list.begin(), list.end());
          list.erase(std::unique(list.begin(), list.end()), list.end());
        }
      return neighbours;
    }
  } // namespace

  JacobianPattern::JacobianPattern(
    const MaterialPoints                         &points,
    const Unknowns                               &unknowns,
    const MPI_Comm                                comm,
    const std::vector<std::vector<unsigned int>> &groups,
    const std::vector<std::vector<unsigned int>> &links,
    const bool                                    one_triangle,
    const bool                                    shares_columns,
    SparseMatrix                                 &matrix)
    : one_triangle(one_triangle)
  {
    const unsigned int      n      = points.n_nodes;
    const std::vector<int> &row_of = unknowns.free_row;

    matrix              = SparseMatrix();
    matrix.comm         = comm;
    matrix.symmetric    = one_triangle;
    matrix.n_global     = unknowns.n_rows;
    matrix.n_owned      = unknowns.n_owned_rows;
    matrix.global_index = unknowns.global_row;

    const unsigned int n_local_nodes = row_of.size() / dim;
    const auto         neighbours =
      nodes_that_meet(points, n_local_nodes, groups, links);
    for (unsigned int node = 0; node < n_local_nodes; ++node)
      {
        std::size_t start    = 0; // of the columns
        bool        is_first = true;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const int row = row_of[dim * node + c];
            if (row < 0)
              continue;
            if (is_first || !shares_columns)
              {
                start = matrix.column.size();
                for (const unsigned int other : neighbours[node])
                  for (unsigned int d = 0; d < dim; ++d)
                    if (const int column = row_of[dim * other + d];
                        column >= 0 && (!one_triangle || column <= row))
                      matrix.column.push_back(column);
              }
            else if (one_triangle) // one more than the row above
              matrix.column.push_back(row);
            matrix.row_start.push_back(matrix.row_start.back() +
                                       (matrix.column.size() - start));
            if (shares_columns)
              matrix.column_start.push_back(start);
            is_first = false;
          }
      }
    matrix.column.shrink_to_fit();
    matrix.value.assign(matrix.row_start.back(), 0.);

    // The columns of a node's components are adjacent, and so are its rows.
    const auto first_row = [&](const unsigned int node) {
      int row = -1;
      for (unsigned int d = dim; d-- > 0;)
        row = row_of[dim * node + d] >= 0 ? row_of[dim * node + d] : row;
      return row;
    };
    const auto distance = [&](const int row, const int column) {
      return row < 0 || column < 0
               ? 0
               : matrix.entry(row, column) - matrix.row_start[row];
    };
    pairs_of_cell = std::size_t(n) * (one_triangle ? n + 1 : 2 * n) / 2;
    rows.reserve(points.n_cells() * dim * n);
    offsets.reserve(points.n_cells() * pairs_of_cell);
    std::vector<int> first(n);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int node = points.nodes[c * n + i];
            first[i]                = first_row(node);
            for (unsigned int d = 0; d < dim; ++d)
              rows.push_back(row_of[dim * node + d]);
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = one_triangle ? i : 0; j < n; ++j)
            offsets.push_back(one_triangle && first[i] < first[j]
                                ? -1 - distance(first[j], first[i])
                                : distance(first[i], first[j]));
      }
    diagonal.resize(matrix.n_rows());
    for (int row = 0; row < matrix.n_rows(); ++row)
      diagonal[row] = matrix.entry(row, row);
  }
} // namespace geocone::GEOCONE_DIM
