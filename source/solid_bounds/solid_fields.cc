// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solid_bounds/solid_fields.h>
#include <geocone/solid_bounds/solid_gap.h>

#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Power dissipated in each cell per volume, over the mean of the body. */
    std::vector<double>
    relative_dissipation(const Tetrahedra &tetrahedra, const SolidBound &upper)
    {
      std::vector<double> density = dissipation_around_cells(tetrahedra, upper);
      const double total  = std::accumulate(density.begin(), density.end(), 0.);
      double       volume = 0.;
      for (unsigned int c = 0; c < density.size(); ++c)
        {
          volume += tetrahedra.volume(c);
          density[c] /= tetrahedra.volume(c);
        }
      if (total > 0.)
        for (double &one : density)
          one *= volume / total;
      return density;
    }
  } // namespace

  SimplexTable<Tetrahedra>
  table_of_bounds(const Tetrahedra          &tetrahedra,
                  const BoundUnits          &units,
                  const SolidBound          &upper,
                  const SolidBound          &lower,
                  const std::vector<double> &gap)
  {
    SimplexTable table(tetrahedra);
    using Index             = unsigned int;
    const Index n_cells     = tetrahedra.cells.size(),
                n_of_rates  = upper.velocity.size() / n_cells,
                n_of_stress = lower.stress.size() / n_cells;
    table.add("velocity",
              dim,
              [&, n_of_rates](const Index p, const Index, const Index d) {
                return upper.velocity[p / 4 * n_of_rates + p % 4][d];
              });
    for (Index i = 0; i < dim; ++i)
      for (Index j = i; j < dim; ++j)
        table.add(
          std::string("stress_") + "xyz"[i] + "xyz"[j],
          1,
          [&, i, j, n_of_stress](const Index p, const Index, const Index) {
            return units.stress / (i == j ? 1. : sqrt2) *
                   lower.stress[p / 4 * n_of_stress + p % 4]
                               [index_of_component[i][j]];
          });
    table.add_of_cells("dissipation", relative_dissipation(tetrahedra, upper));
    table.add_parts_of_gap(gap);
    table.add_materials();
    return table;
  }
} // namespace geocone::GEOCONE_DIM
