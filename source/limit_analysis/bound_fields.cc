// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_certificate.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/bound_fields.h>
#include <geocone/plane_bounds/bar_cells.h>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Index = unsigned int;

    void
    add_plane_fields(SimplexTable<Triangles> &table,
                     const BoundScene        &bound,
                     const Bound             &upper,
                     const Bound             &lower)
    {
      table.add(
        "velocity", dim, [&](const Index p, const Index, const Index d) {
          return upper.q.size() > 0
                   ? upper.q[dof_of_node(bound,
                                         bound.bars.node_of_cell(
                                           bound.triangles, p / 3, p % 3)) +
                             d]
                   : 0.;
        });
      // Translation of each triangle, from the dual of the lower bound.
      table.add(
        "velocity_lower", dim, [&](const Index p, const Index, const Index d) {
          return lower.q.size() > 0 ? lower.q[dim * (p / 3) + d] : 0.;
        });
      const char *const names[] = {"stress_xx", "stress_yy", "stress_xy"};
      for (Index i = 0; i < 3; ++i)
        table.add(names[i], 1, [&, i](const Index p, const Index, const Index) {
          const Mandel s = from_cone_axes(Mandel(lower.s[p]));
          return bound.units.stress * (i == 2 ? s[2] / sqrt2 : s[i]);
        });
    }

    void
    add_axisymmetric_fields(SimplexTable<Triangles> &table,
                            const BoundScene        &bound,
                            const Bound             &upper,
                            const Bound             &lower)
    {
      table.add(
        "velocity", dim, [&](const Index p, const Index v, const Index d) {
          return velocity_at_vertex(upper.q,
                                    p / 3,
                                    p % 3,
                                    bound.triangles.vertices[v][0] /
                                      bound.units.length)[d];
        });
      // Multipliers of equilibrium at the vertices of each triangle.
      table.add(
        "velocity_lower", dim, [&](const Index p, const Index, const Index d) {
          return multiplier_at_vertex(lower.q, p / 3, p % 3)[d];
        });
      const char *const names[] = {
        "stress_xx", "stress_yy", "stress_xy", "stress_zz"};
      for (Index i = 0; i < 4; ++i)
        table.add(names[i], 1, [&, i](const Index p, const Index, const Index) {
          return bound.units.stress / (i == 2 ? sqrt2 : 1.) *
                 stress_at_vertex(bound, lower, p / 3, p % 3)[i];
        });
    }
  } // namespace

  SimplexTable<Triangles>
  table_of_bounds(const BoundScene          &bound,
                  const Bound               &upper,
                  const Bound               &lower,
                  const std::vector<double> &gap)
  {
    SimplexTable table(bound.triangles);
    if (bound.is_axisymmetric())
      add_axisymmetric_fields(table, bound, upper, lower);
    else
      add_plane_fields(table, bound, upper, lower);
    table.add_parts_of_gap(gap);
    table.add_materials();
    return table;
  }
} // namespace geocone::GEOCONE_DIM
