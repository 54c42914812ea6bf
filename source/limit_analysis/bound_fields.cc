// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/bound_fields.h>

namespace geocone::GEOCONE_DIM
{
  SimplexTable<Triangles>
  table_of_bounds(const Triangles           &triangles,
                  const BoundUnits          &units,
                  const Bound               &upper,
                  const Bound               &lower,
                  const std::vector<double> &gap)
  {
    SimplexTable table(triangles);
    using Index = unsigned int;
    table.add("velocity", dim, [&](const Index, const Index v, const Index d) {
      return upper.q.size() > 0 ? upper.q[dim * v + d] : 0.;
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
        return units.stress * (i == 2 ? s[2] / sqrt2 : s[i]);
      });
    table.add_parts_of_gap(gap);
    table.add_materials();
    return table;
  }
} // namespace geocone::GEOCONE_DIM
