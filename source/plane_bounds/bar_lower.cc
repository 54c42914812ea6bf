// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/bar_problem.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** The functional over the length of an edge. */
    Functional
    over_length(Functional rate, const Step &step)
    {
      for (auto &[dof, factor] : rate.entries)
        factor /= step.length;
      return rate;
    }

    /** Dofs of the lower bound and the state of the vertices of structures. */
    class LowerBars
    {
    public:
      LowerBars(const BoundScene &bound, const BoundProblem &problem)
        : bound(bound)
        , bars(bound.bars)
        , first(first_dof_of_bars(bound, BoundSide::lower))
        , frame(bars.vertices.size())
        , n_edges(bars.vertices.size(), 0)
        , is_tied(bars.vertices.size(), false)
        , problem(problem)
      {
        unsigned int next = first + bars.n_more_lower_dofs();
        for (const BarChain &chain : bars.chains)
          {
            first_cubic.push_back(next);
            next += n_cubic_dofs(chain);
          }
        for (const BarChain &chain : bars.chains)
          for (unsigned int i = 0; i < chain.edges.size(); ++i)
            {
              const Step step(bound, chain, i);
              for (const unsigned int v : step.vertices)
                {
                  const unsigned int k = bars.number_of_vertex(v);
                  if (n_edges[k]++ == 0)
                    frame[k] = step.t;
                }
            }
        for (unsigned int k = 0; k < frame.size(); ++k)
          if (is_held(k, 0) || is_held(k, 1))
            frame[k] = Point<dim>::unit_vector(0);
        for (const PlasticBars::Tie &tie : bars.ties)
          for (const int v : tie.vertices)
            if (v >= 0)
              is_tied[bars.number_of_vertex(v)] = true;
      }

      /** Adds the force f on a vertex. */
      void
      add_at_vertex(const unsigned int    vertex,
                    const Tensor<1, dim> &f,
                    Functional           &rate) const
      {
        const unsigned int    k     = bars.number_of_vertex(vertex);
        const Tensor<1, dim> &t     = frame[k];
        const double          along = f * t, across = t[0] * f[1] - t[1] * f[0];
        // Forces along a straight chain have no component across it but by rounding.
        if (std::abs(along) > 1e-9 * f.norm())
          rate.add(first + bars.dof_of_vertex(k), along);
        if (std::abs(across) > 1e-9 * f.norm())
          rate.add(first + bars.dof_of_vertex(k) + 1, across);
      }

      /** Adds the force f on the structure at an end of an edge. */
      void
      add_at_end(const Step           &step,
                 const unsigned int    end,
                 const Tensor<1, dim> &f,
                 Functional           &rate) const
      {
        rate.add(dim * (bound.triangles.cells.size() +
                        2 * bars.edges[step.number].edge + step.ends[end]),
                 f);
      }

      void
      add_rotation(const unsigned int chain,
                   const unsigned int i,
                   const double       factor,
                   Functional        &rate) const
      {
        rate.add(first + bars.dof_of_rotation(chain, i), factor);
      }

      bool
      has_no_force(const unsigned int dof) const
      {
        return problem.has_no_force[dof];
      }

      /** Whether the axial force is zero at an end of a chain. */
      bool
      is_free_end(const BarChain &chain, const unsigned int i) const
      {
        if (i > 0 && i + 1 < chain.vertices.size())
          return false;
        const unsigned int k = bars.number_of_vertex(chain.vertices[i]);
        if (n_edges[k] > 1 || is_tied[k])
          return false;
        const Step step(bound, chain, i == 0 ? 0 : i - 1);
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(step.t[d]) > 1e-9 && !is_held(k, d))
            return true;
        return false;
      }

      /** Virtual power of the coefficient j of the axial force of an edge. */
      Functional
      axial(const BarChain    &chain,
            const unsigned int i,
            const unsigned int j) const
      {
        const Step step(bound, chain, i);
        Functional rate;
        if (j < 2)
          add_at_end(step, 0, (j == 0 ? 1. : -1.) * step.t, rate);
        if (j > 0)
          add_at_end(step, 1, (j == 1 ? 1. : -1.) * step.t, rate);
        if (j == 0)
          add_at_vertex(step.vertices[0], -1. * step.t, rate);
        if (j == 2)
          add_at_vertex(step.vertices[1], step.t, rate);
        return rate;
      }

      /** Virtual power of the coefficient j of the axial force of an edge in the basis of
       *  degree three, with the condition that its degree is two. */
      Functional
      cubic_axial(const unsigned int c,
                  const unsigned int i,
                  const unsigned int j) const
      {
        constexpr double third[4] = {1., -3., 3., -1.};
        const Step       step(bound, bars.chains[c], i);
        Functional       rate;
        add_at_end(step, j / 2, (j % 2 == 0 ? 1.5 : -1.5) * step.t, rate);
        if (j == 0)
          add_at_vertex(step.vertices[0], -1. * step.t, rate);
        if (j == 3)
          add_at_vertex(step.vertices[1], step.t, rate);
        rate.add(first_cubic[c] + i, third[j]);
        return rate;
      }

      /** Virtual power of the coefficient j of the moment of an edge of a plate. */
      Functional
      moment(const unsigned int c,
             const unsigned int i,
             const unsigned int j) const
      {
        const BarChain  &chain = bars.chains[c];
        const Step       step(bound, chain, i);
        const double     by           = 3. / step.length;
        constexpr double second[2][4] = {{1., -2., 1., 0.}, {0., 1., -2., 1.}};
        Functional       rate;
        for (unsigned int end = 0; end < 2; ++end)
          if (second[end][j] != 0.)
            add_at_end(step, end, by * second[end][j] * step.n, rate);
        if (j < 2) // shear force at the beginning
          add_at_vertex(step.vertices[0], (j == 1 ? by : -by) * step.n, rate);
        else // and at the end
          add_at_vertex(step.vertices[1], (j == 2 ? by : -by) * step.n, rate);
        if (j == 0)
          add_rotation(c, i, -1., rate);
        if (j == 3)
          add_rotation(c, i + 1, 1., rate);
        return rate;
      }

      const BoundScene  &bound;
      const PlasticBars &bars;
      const unsigned int first;

    private:
      bool
      is_held(const unsigned int k, const unsigned int d) const
      {
        return problem.is_prescribed[first + bars.dof_of_vertex(k) + d];
      }

      std::vector<unsigned int>   first_cubic; ///< dof of each chain
      std::vector<Tensor<1, dim>> frame;       ///< first axis of each vertex
      std::vector<unsigned int>   n_edges;     ///< at each vertex
      std::vector<bool>           is_tied;
      const BoundProblem         &problem;
    };

    /** Adds the tractions on interfaces that are weaker than the soil. */
    void
    add_lower_interfaces(const LowerBars &lower, BarCells &cells)
    {
      const BoundScene &bound     = lower.bound;
      const Triangles  &triangles = bound.triangles;
      for (unsigned int k = 0; k < bound.bars.edges.size(); ++k)
        if (bound.bars.has_weak_interface(k))
          for (const int cell : bound.bars.edges[k].cells)
            if (cell >= 0)
              {
                const BarEdge &edge   = bound.bars.edges[k];
                const auto    &ends   = triangles.edges[edge.edge].vertices;
                const double   length =
                  triangles.edge_length(edge.edge) / bound.units.length;
                for (unsigned int end = 0; end < 2; ++end)
                  {
                    const unsigned int soil =
                      dof_at_end_of_cell(bound, cell, edge.edge, ends[end]);
                    if (lower.has_no_force(soil))
                      {
                        cells.skip(); // soil at its apex
                        continue;
                      }
                    PassingVelocity    passing;
                    const unsigned int bar =
                      dim * (triangles.cells.size() + 2 * edge.edge + end);
                    for (unsigned int d = 0; d < dim; ++d)
                      {
                        passing.add(soil + d, Point<dim>::unit_vector(d));
                        passing.add(bar + d, -1. * Point<dim>::unit_vector(d));
                      }
                    cells.add(
                      interface_cone(
                        bound, BoundSide::lower, edge, cell, ends[end]),
                      passing.strains(coulomb,
                                      normal_into(triangles, cell, edge.edge)),
                      passing.dofs,
                      length / 2.);
                  }
                cells.end_cell(cell);
              }
    }
  } // namespace

  void
  add_lower_bars(const BoundScene   &bound,
                 const BoundProblem &problem,
                 BarCells           &cells)
  {
    const LowerBars lower(bound, problem);
    add_lower_interfaces(lower, cells);
    for (unsigned int c = 0; c < bound.bars.chains.size(); ++c)
      {
        const BarChain &chain = bound.bars.chains[c];
        const Interval  axial = axial_interval(*chain.structure,
                                              bound.units,
                                              BoundSide::lower,
                                              chain.ends_are_held),
                       moment = moment_interval(
                         *chain.structure, bound.units, BoundSide::lower);
        const auto [least, most] = chain.structure->axial_strength();
        const auto parts =
          strength_parts(*chain.structure, bound.units, BoundSide::lower);
        for (unsigned int i = 0; i < chain.edges.size(); ++i)
          {
            const Step step(bound, chain, i);
            for (unsigned int j = 0; j < 4 && !parts.empty(); ++j)
              cells.add(parts,
                        over_length(lower.cubic_axial(c, i, j), step),
                        over_length(lower.moment(c, i, j), step),
                        step.length,
                        owner_of(bound, step));
            if (!parts.empty())
              continue;
            for (unsigned int j = 0; j < 3; ++j)
              if (j != 1 && (least == 0. || most == 0.) &&
                  lower.is_free_end(chain, j == 0 ? i : i + 1))
                cells.skip(); // zero, at the end of the interval
              else
                cells.add(axial,
                          over_length(lower.axial(chain, i, j), step),
                          step.length);
            cells.end_cell(owner_of(bound, step));
            if (!chain.structure->is_plate())
              continue;
            for (unsigned int j = 0; j < 4; ++j)
              {
                cells.add(moment,
                          over_length(lower.moment(c, i, j), step),
                          step.length);
                if (j > 1)
                  cells.end_cell(owner_of(bound, step));
              }
          }
      }
    for (const PlasticBars::Tie &tie : bound.bars.ties)
      {
        cells.add(axial_interval(*tie.structure, bound.units, BoundSide::lower),
                  rate_of_tie(
                    tie,
                    [&](const unsigned int    v,
                        const Tensor<1, dim> &f,
                        Functional &rate) { lower.add_at_vertex(v, f, rate); }),
                  1.);
        cells.end_cell(owner_of(bound, tie));
      }
  }
} // namespace geocone::GEOCONE_DIM
