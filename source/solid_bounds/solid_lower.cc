// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solid_bounds/solid_points.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Dofs of the lower bound's equations: of equilibrium in cells, and of tractions
     *  on facets. */
    class EquilibriumDofs
    {
    public:
      EquilibriumDofs(const Tetrahedra &tetrahedra, const unsigned int order)
        : tetrahedra(tetrahedra)
        , n_u(order == 1 ? 1 : 4)
        , n_facet(simplex_nodes::n_on_facet(order))
        , first_w(dim * n_u * tetrahedra.cells.size())
      {}

      unsigned int
      n() const
      {
        return first_w + dim * n_facet * tetrahedra.facets.size();
      }

      unsigned int
      of_cell(const unsigned int cell, const unsigned int vertex) const
      {
        return dim * (n_u * cell + (n_u == 1 ? 0 : vertex));
      }

      unsigned int
      of_facet(const unsigned int facet, const unsigned int node) const
      {
        return first_w + dim * (n_facet * facet + node);
      }

      /** Dofs of the node of a facet between two vertices of a cell, or at one of
       *  them. */
      unsigned int
      between(const unsigned int facet,
              const unsigned int a,
              const unsigned int b) const
      {
        const auto &v    = tetrahedra.facets[facet].vertices;
        const auto  find = [&](const unsigned int vertex) {
          return static_cast<unsigned int>(
            std::find(v.begin(), v.end(), vertex) - v.begin());
        };
        const auto [i, j] = std::minmax({find(a), find(b)});
        if (i == j)
          return of_facet(facet, i);
        unsigned int node = 3;
        while (simplex_nodes::edges_of_facet[node - 3][0] != i ||
               simplex_nodes::edges_of_facet[node - 3][1] != j)
          ++node;
        return of_facet(facet, node);
      }

      const Tetrahedra  &tetrahedra;
      const unsigned int n_u;     ///< equations of a cell, per component
      const unsigned int n_facet; ///< equations of a facet, per component

    private:
      const unsigned int first_w;
    };

    /** Adds the stress of a cell at the coefficient between two of its vertices. */
    void
    add_stress(const SolidScene      &bound,
               const unsigned int     order,
               const unsigned int     c,
               const unsigned int     i,
               const unsigned int     j,
               const EquilibriumDofs &equations,
               SolidPoints           &points)
    {
      const Tetrahedra            &tetrahedra = *bound.tetrahedra;
      const double                 L          = bound.units.length;
      const auto                   g          = tetrahedra.gradients(c);
      const auto                  &cell       = tetrahedra.cells[c];
      const auto                   k          = bound.strength_at_vertices(c);
      SolidPoints::Strains         B;
      std::array<unsigned int, 12> dofs;
      unsigned int                 n   = 0;
      const auto                   add = [&](const unsigned int    dof,
                           const double          factor,
                           const Tensor<1, dim> &gradient) {
        for (unsigned int d = 0; d < dim; ++d, ++n)
          {
            B.col(n) = factor * L * symmetric_product(d, gradient);
            dofs[n] = dof + d;
          }
      };
      add(equations.of_cell(c, i), order == 1 ? -4. : -20., g[j]);
      if (i != j)
        add(equations.of_cell(c, j), -20., g[i]);
      // A_f n_f = -3 V grad lambda_f.
      for (unsigned int f = 0; f < 4; ++f)
        if (f != i && f != j)
          add(equations.between(
                tetrahedra.facets_of_cell[c][f], cell[i], cell[j]),
              order == 1 ? -4. : -5.,
              g[f]);
      points.add(tetrahedra.material[c],
                 B,
                 dofs,
                 tetrahedra.volume(c) / (L * L * L) /
                   simplex_nodes::n_in_cell(order),
                 (k[i] + k[j]) / 2.);
    }

    /** Adds the given tractions and the held components of a facet. */
    void
    add_facet(const SolidScene      &bound,
              const unsigned int     f,
              const EquilibriumDofs &equations,
              ConicProblem          &problem)
    {
      const double          L    = bound.units.length;
      const double          A    = bound.tetrahedra->area(f) / (L * L);
      const FacetCondition &held = bound.facet_conditions[f];
      const auto            t    = bound.tractions(f);
      for (unsigned int i = 0; i < equations.n_facet; ++i)
        {
          const unsigned int dof = equations.of_facet(f, i);
          for (unsigned int d = 0; d < dim; ++d)
            if (held.holds(d))
              {
                problem.is_prescribed[dof + d] = true;
                problem.prescribed[dof + d]    = held.velocity[d];
              }
          if (i < 3)
            add_load(problem, dof, A / equations.n_facet * t[i]);
          else
            for (const unsigned int end : simplex_nodes::edges_of_facet[i - 3])
              add_load(problem, dof, A / equations.n_facet / 2. * t[end]);
        }
    }
  } // namespace

  ConicProblem
  lower_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra     &tetrahedra = *bound.tetrahedra;
    const double          L          = bound.units.length;
    const EquilibriumDofs equations(tetrahedra, order);
    ConicProblem          problem = ConicProblem::of_dofs(equations.n());
    problem.least_start           = bound.units.is_of_loads ? 0.1 : 0.;
    SolidPoints           points  = empty_points(bound);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      {
        for (unsigned int i = 0; i < 4; ++i)
          add_stress(bound, order, c, i, i, equations, points);
        if (order == 2)
          for (const auto &[i, j] : simplex_nodes::edges)
            add_stress(bound, order, c, i, j, equations, points);
        for (unsigned int i = 0; i < equations.n_u; ++i)
          add_load(problem,
                   equations.of_cell(c, i),
                   tetrahedra.volume(c) / (L * L * L) * bound.body_force(c));
      }
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      add_facet(bound, f, equations, problem);
    points.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
