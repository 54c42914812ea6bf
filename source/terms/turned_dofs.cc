// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/types.h>
#include <geocone/conditions/vector_at.h>
#include <geocone/terms/turned_dofs.h>

#include <map>

namespace geocone::GEOCONE_DIM
{
  TurnedDofs::TurnedDofs(const MaterialPoints &points, const Unknowns &unknowns)
  {
    if (unknowns.turned_nodes.empty())
      return;
    std::map<unsigned int, const Unknowns::TurnedNode *> turned;
    for (const Unknowns::TurnedNode &node : unknowns.turned_nodes)
      turned[node.node] = &node;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        first_turn.push_back(turns.size());
        for (unsigned int i = 0; i < points.n_nodes; ++i)
          if (const auto found =
                turned.find(points.nodes[c * points.n_nodes + i]);
              found != turned.end())
            turns.push_back({i, found->second->axes});
      }
    first_turn.push_back(turns.size());
  }

  const TurnedDofs::Turn *
  TurnedDofs::turn_of(const unsigned int c, const unsigned int i) const
  {
    if (!turns.empty())
      for (unsigned int k = first_turn[c]; k < first_turn[c + 1]; ++k)
        if (turns[k].node == i)
          return &turns[k];
    return nullptr;
  }

  void
  TurnedDofs::turn_velocities(const unsigned int c, double *cell_v) const
  {
    for (unsigned int i = first_turn[c]; i < first_turn[c + 1]; ++i)
      {
        double *v = cell_v + dim * turns[i].node;
        put(transpose(turns[i].axes) * taken(v), v);
      }
  }

  void
  TurnedDofs::turn_forces(const unsigned int c, double *cell_f) const
  {
    for (unsigned int i = first_turn[c]; i < first_turn[c + 1]; ++i)
      {
        double *f = cell_f + dim * turns[i].node;
        put(turns[i].axes * taken(f), f);
      }
  }

  void
  TurnedDofs::matrix_to_dofs(const unsigned int c,
                             const unsigned int n_dofs,
                             const bool         upper,
                             double            *K) const
  {
    if (turns.empty() || first_turn[c] == first_turn[c + 1])
      return;
    if (upper)
      for (unsigned int i = 0; i < n_dofs; ++i)
        for (unsigned int j = 0; j < i; ++j)
          K[n_dofs * i + j] = K[n_dofs * j + i];
    std::vector<double> column(n_dofs);
    for (unsigned int j = 0; j < n_dofs; ++j)
      {
        for (unsigned int i = 0; i < n_dofs; ++i)
          column[i] = K[n_dofs * i + j];
        forces_to_dofs(c, column.data());
        for (unsigned int i = 0; i < n_dofs; ++i)
          K[n_dofs * i + j] = column[i];
      }
    for (unsigned int i = 0; i < n_dofs; ++i)
      forces_to_dofs(c, K + n_dofs * i);
  }
} // namespace geocone::GEOCONE_DIM
