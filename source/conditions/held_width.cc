// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/conditions/held_width.h>
#include <geocone/shapes/part_in_box.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Whether all that a condition prescribes is zero. */
    bool
    is_support(const BoundaryCondition &condition)
    {
      const auto is_zero = [](const std::optional<Expression> &value) {
        return !value || value->is_zero();
      };
      return is_zero(condition.normal) &&
             std::all_of(condition.components.begin(),
                         condition.components.end(),
                         is_zero);
    }
  } // namespace

  std::vector<std::string>
  warn_of_partial_coverage(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space)
  {
    constexpr double         noticed = 1e-3; ///< part of the width
    std::vector<std::string> warnings;
    const MPI_Comm           comm = mesh.triangulation().get_communicator();
    for (const auto &condition : scene.dirichlet.list)
      {
        if (condition->moves_with_body() || condition->has_formula())
          continue;
        const auto box = condition->box_corners();
        if (!box)
          continue;
        const auto ids = mesh.side_ids(*condition);
        // Minima of the coordinates and of their negatives: of the part of the
        // boundary in the box, and of the nodes.
        std::array<double, 4 * dim> ends;
        ends.fill(std::numeric_limits<double>::max());
        const auto extend = [&](const unsigned int first, const Point<dim> &x) {
          for (unsigned int d = 0; d < dim; ++d)
            {
              ends[first + d]       = std::min(ends[first + d], x[d]);
              ends[first + dim + d] = std::min(ends[first + dim + d], -x[d]);
            }
        };
        const auto add_edge = [&](const Point<dim> &a, const Point<dim> &b) {
          if (const auto part = part_in_box(*condition->wide_box(), a, b))
            for (const Point<dim> &end : *part)
              extend(0, end);
        };
        for (const auto &cell : mesh.own_cells())
          for (const unsigned int f : cell->face_indices())
            if (const auto face = cell->face(f);
                face->at_boundary() && ids.count(face->boundary_id()) > 0)
              {
                if constexpr (dim == 2)
                  add_edge(face->vertex(0), face->vertex(1));
                else
                  for (const unsigned int l : face->line_indices())
                    add_edge(face->line(l)->vertex(0),
                             face->line(l)->vertex(1));
              }
        for (const unsigned int node : space.nodes_on_sides(ids))
          if (condition->holds_at(space.node_positions()[node]))
            extend(2 * dim, space.node_positions()[node]);
        Utilities::MPI::min(ArrayView<const double>(ends.data(), ends.size()),
                            comm,
                            ArrayView<double>(ends.data(), ends.size()));
        double widest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          widest = std::max(widest, -ends[3 * dim + d] - ends[2 * dim + d]);
        if (widest == 0. && is_support(*condition))
          continue; // a point that is held has no width
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double asked = -ends[dim + d] - ends[d],
                         held  = -ends[3 * dim + d] - ends[2 * dim + d];
            if (std::abs(held - asked) > noticed * asked + 1e-8)
              warnings.push_back(format(
                "'%s' holds nodes from %c = %g to %g m, a width of %g m, where "
                "%g m are in its box, from %g to %g m: loads, and errors "
                "beside a reference, are those of the nodes; put nodes at the "
                "ends of the box (cell size, grading), or take smaller cells",
                condition->name.c_str(),
                coordinate[d],
                ends[2 * dim + d],
                -ends[3 * dim + d],
                held,
                asked,
                ends[d],
                -ends[dim + d]));
          }
      }
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
