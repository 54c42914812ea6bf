// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/bounds/held_bodies.h>
#include <geocone/solid_bounds/jump_points.h>

#include <map>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Returns whether soil may fail beside an obstacle before the interface does. */
    bool
    may_crack_beside(const SolidScene  &bound,
                     const unsigned int order,
                     const unsigned int f)
    {
      const FacetCondition &held = bound.facet_conditions[f];
      if (held.kind != FacetCondition::Kind::interface)
        return false;
      for (const auto &soil : strength_of_cracks(bound, order, f))
        if (soil && !bound.interfaces[held.obstacle].is_weaker_than(*soil))
          return true;
      return false;
    }

    /** Dofs of the velocities of cells and of the bodies that hold facets. */
    class VelocityDofs
    {
    public:
      VelocityDofs(const SolidScene &bound, const unsigned int order)
        : n_nodes(simplex_nodes::n_in_cell(order))
        , bodies(dim * n_nodes * bound.tetrahedra->cells.size())
      {
        for (const FacetCondition &held : bound.facet_conditions)
          bodies.add(held);
        n_dofs = bodies.n_dofs();
        for (unsigned int f = 0; f < bound.facet_conditions.size(); ++f)
          if (may_crack_beside(bound, order, f))
            {
              first_of_crack[f] = n_dofs;
              n_dofs += dim * simplex_nodes::n_on_facet(order);
            }
      }

      unsigned int
      of_node(const unsigned int cell, const unsigned int node) const
      {
        return dim * (n_nodes * cell + node);
      }

      const unsigned int n_nodes;
      HeldBodies         bodies;
      unsigned int       n_dofs; ///< with those between cracks and obstacles

      /** First dof of the soil between an obstacle and a crack beside it, of the facets
       *  that have one. */
      std::map<unsigned int, unsigned int> first_of_crack;
    };

    /** Tractions of a facet of the dead or the live load. */
    std::array<Tensor<1, dim>, 3>
    part_of(const std::array<SolidScene::Load, 3> &tractions, const bool live)
    {
      std::array<Tensor<1, dim>, 3> part;
      for (unsigned int i = 0; i < 3; ++i)
        part[i] = live ? tractions[i].live : tractions[i].dead;
      return part;
    }

    /** Adds the strain rates of a cell, and its weight. */
    void
    add_rates(const SolidScene   &bound,
              const unsigned int  order,
              const unsigned int  cell,
              const VelocityDofs &velocities,
              SolidPoints        &points,
              ConicProblem       &problem)
    {
      const Tetrahedra  &tetrahedra = *bound.tetrahedra;
      const double       L          = bound.units.length;
      const unsigned int n_nodes    = simplex_nodes::n_in_cell(order);
      const auto         g          = tetrahedra.gradients(cell);
      const double       V          = tetrahedra.volume(cell) / (L * L * L);
      const auto         k          = strength_of_rates(bound, order, cell);
      for (unsigned int i = 0; i < k.size(); ++i)
        {
          // The gradient at vertex i is 2 sum_j v_ij x g_j.
          SolidPoints::Strains         B;
          std::array<unsigned int, 12> dofs;
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int d = 0; d < dim; ++d)
              {
                B.col(dim * j + d) = order * L * symmetric_product(d, g[j]);
                dofs[dim * j + d] =
                  velocities.of_node(
                    cell, order == 1 ? j : simplex_nodes::node(i, j)) +
                  d;
              }
          points.add(tetrahedra.material[cell], B, dofs, V / k.size(), k[i]);
        }
      for (unsigned int i = 0; i < n_nodes; ++i)
        add_load(problem,
                 velocities.of_node(cell, i),
                 V / n_nodes * bound.body_force(cell));
    }

    /** Adds the jumps at an inner or a held facet; prescribes velocities at a plane
     *  that soil without tensile strength cannot leave. */
    void
    add_jumps(const SolidScene   &bound,
              const unsigned int  order,
              const unsigned int  f,
              const VelocityDofs &velocities,
              JumpPoints         &jumps,
              ConicProblem       &problem)
    {
      const Tetrahedra     &tetrahedra = *bound.tetrahedra;
      const auto           &facet      = tetrahedra.facets[f];
      const FacetCondition &held       = bound.facet_conditions[f];
      const bool            is_inner   = facet.cells[1] != Tetrahedra::none,
                 is_plane = held.kind == FacetCondition::Kind::plane;
      if (!is_inner && held.kind == FacetCondition::Kind::free)
        return;
      const double L      = bound.units.length;
      const auto   axes   = axes_of_facet(tetrahedra, f);
      const auto   first  = nodes_in_cell(tetrahedra, order, f, 0);
      const auto   second = is_inner ? nodes_in_cell(tetrahedra, order, f, 1)
                                     : std::vector<unsigned int>();
      const unsigned int material = tetrahedra.material[cell_of_jump(bound, f)];
      const SpatialStrength &one  = bound.strengths[material];
      const auto             k    = strength_of_jumps(bound, order, f);
      const double           mu   = one.face_friction(),
                   weight         = tetrahedra.area(f) / (L * L) / first.size();
      for (unsigned int i = 0; i < first.size(); ++i)
        {
          const unsigned int a = velocities.of_node(facet.cells[0], first[i]),
                             b = is_inner ? velocities.of_node(facet.cells[1],
                                                               second[i])
                                          : velocities.bodies.dof_of(held);
          const bool is_closed = is_plane && mu == 0. && !one.is_cut();
          if (is_closed && !held.is_oblique())
            {
              problem.is_prescribed[a + held.axis] = true;
              problem.prescribed[a + held.axis]    = held.velocity[held.axis];
              continue;
            }
          if (held.kind == FacetCondition::Kind::interface)
            {
              const auto   crack = velocities.first_of_crack.find(f);
              unsigned int soil  = a;
              if (crack != velocities.first_of_crack.end())
                {
                  soil = crack->second + dim * i;
                  jumps.add_in_soil(
                    material, axes, dofs_of_both(a, soil), weight, k[i]);
                }
              jumps.add_at_obstacle(held.obstacle,
                                    axes,
                                    dofs_of_both(soil, b),
                                    weight,
                                    global_axes());
              continue;
            }
          const JumpPoints::Dofs dofs = dofs_of_both(a, b);
          if (is_closed)
            jumps.add_closed(axes[0], dofs, weight);
          else if (is_plane)
            jumps.add_opening(
              axes[0], dofs, weight, one.is_cut() ? one.tension : k[i] / mu);
          else
            jumps.add_in_soil(material, axes, dofs, weight, k[i]);
        }
    }

    /** Adds the tractions of a boundary facet to the forces of the velocities. */
    void
    add_tractions(const SolidScene   &bound,
                  const unsigned int  order,
                  const unsigned int  f,
                  const VelocityDofs &velocities,
                  ConicProblem       &problem)
    {
      const Tetrahedra &tetrahedra = *bound.tetrahedra;
      const double L = bound.units.length, A = tetrahedra.area(f) / (L * L);
      const auto   nodes      = nodes_in_cell(tetrahedra, order, f, 0);
      const unsigned int cell = tetrahedra.facets[f].cells[0];
      for (const bool is_live : {false, true})
        {
          auto      &load = is_live ? problem.live : problem.dead;
          const auto forces =
            forces_of_traction(order, part_of(bound.tractions(f), is_live));
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              load[velocities.of_node(cell, nodes[i]) + d] += A * forces[i][d];
        }
    }
  } // namespace

  ConicProblem
  upper_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const VelocityDofs velocities(bound, order);
    ConicProblem       problem = ConicProblem::of_dofs(velocities.n_dofs);
    problem.least_start        = least_start(bound);
    velocities.bodies.prescribe(problem);
    SolidPoints points = empty_points(bound);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      add_rates(bound, order, c, velocities, points, problem);
    JumpPoints jumps(bound);
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        add_jumps(bound, order, f, velocities, jumps, problem);
        if (tetrahedra.facets[f].cells[1] == Tetrahedra::none)
          add_tractions(bound, order, f, velocities, problem);
      }
    points.move_to(problem);
    jumps.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
