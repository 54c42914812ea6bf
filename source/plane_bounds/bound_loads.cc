// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/bounds/facet_condition.h>
#include <geocone/bounds/load_choice.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/materials/retention.h>
#include <geocone/plane_bounds/bar_rows.h>
#include <geocone/plane_bounds/bound_loads.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** The outward normal of a boundary edge. */
    Tensor<1, dim>
    outward_normal(const Triangles   &triangles,
                   const unsigned int cell,
                   const unsigned int opposite_vertex)
    {
      const Tensor<1, dim> g = triangles.gradients(cell)[opposite_vertex];
      return -1. * g / g.norm();
    }

    /** The traction of a load at x, in units. @param time at which it acts (s) */
    Tensor<1, dim>
    traction(const BoundaryCondition &load,
             const Point<dim>        &x,
             const Tensor<1, dim>    &n,
             const double             unit,
             const double             time)
    {
      return load.vector_at(x, n, time) / unit;
    }

    /** Node of a boundary edge. */
    struct EdgeNode
    {
      unsigned int dof; ///< of its x component, followed by y
      Point<dim>   of_velocity, of_traction; ///< points of evaluation
      double       part;                     ///< share of the edge's length
      std::optional<unsigned int> jump = {}; ///< axial, of a structure
    };

    /** The x dof of w at an end of an edge, in the lower problem. */
    unsigned int
    dof_at_end(const Triangles   &triangles,
               const unsigned int edge,
               const unsigned int vertex)
    {
      const unsigned int end =
        triangles.edges[edge].vertices[0] == vertex ? 0 : 1;
      return dim * (triangles.cells.size() + 2 * edge + end);
    }

    /**
     * Nodes of an edge. In the upper problem both ends and the middle: Simpson's rule is
     * exact for linear tractions. In the lower one w at both ends, the value of a linear
     * velocity at the third point next to the end; the integral of its function with a
     * linear traction equals the traction at the end. On a structure, whose middle
     * velocity is (b_0 + 2 b_1 + b_2)/4 of Bernstein's coefficients, each part is that
     * of a coefficient.
     */
    std::vector<EdgeNode>
    nodes_of(const BoundScene          &bound,
             const BoundSide            side,
             const Triangles::HeldEdge &held)
    {
      const Triangles   &triangles = bound.triangles;
      const unsigned int edge      = held.edge;
      const auto        &ends      = triangles.edges[edge].vertices;
      const Point<dim>  &a         = triangles.vertices[ends[0]],
                       &b          = triangles.vertices[ends[1]];
      if (side == BoundSide::lower)
        return {{dof_at_end(triangles, edge, ends[0]),
                 Point<dim>(a + (b - a) / 3.),
                 a,
                 1. / 2.},
                {dof_at_end(triangles, edge, ends[1]),
                 Point<dim>(b + (a - b) / 3.),
                 b,
                 1. / 2.}};
      const Point<dim>   middle(a + (b - a) / 2.);
      const PlasticBars &bars = bound.bars;
      if (const int k = bars.number_of_edge(edge); k >= 0)
        {
          const auto dof = [&](const unsigned int node) {
            return dof_of_node(bound, node);
          };
          const unsigned int first = dof(bars.node_of_vertex(
                               bars.number_of_vertex(ends[0]))),
                             last  = dof(bars.node_of_vertex(
                               bars.number_of_vertex(ends[1])));
          const auto first_jump    = dof_of_jump(bound, k, 0),
                     last_jump     = dof_of_jump(bound, k, 1);
          return {{first, a, a, 1. / 6., first_jump},
                  {last, b, b, 1. / 6., last_jump},
                  {first, a, middle, 1. / 6., first_jump},
                  {last, b, middle, 1. / 6., last_jump},
                  {dof(bars.node_of_edge(k)), middle, middle, 1. / 3.}};
        }
      const auto dof = [&](const unsigned int i) {
        return dof_of_node(bound, bars.node_of_cell(triangles, held.cell, i));
      };
      const unsigned int i = (held.opposite_vertex + 1) % 3,
                         j = (held.opposite_vertex + 2) % 3;
      const bool is_first  = triangles.cells[held.cell][i] == ends[0];
      return {{dof(is_first ? i : j), a, a, 1. / 6.},
              {dof(is_first ? j : i), b, b, 1. / 6.},
              {dof(held.opposite_vertex + 3), middle, middle, 2. / 3.}};
    }
  } // namespace

  void
  add_body_forces(BoundProblem      &problem,
                  const BoundScene  &bound,
                  const BoundSide    side,
                  const unsigned int cell)
  {
    add_force_of_cell(bound,
                      side,
                      cell,
                      weight_of_cell(bound, cell),
                      bound.loads(problem, LoadFactor::weight));
    if (bound.scene.water.acts())
      add_force_of_cell(bound,
                        side,
                        cell,
                        seepage_force_of_cell(bound, cell),
                        bound.loads(problem, factor_of_water(bound.scene)));
  }

  std::optional<std::array<double, 3>>
  suction_of_cell(const BoundScene &bound, const unsigned int cell)
  {
    const Triangles &triangles = bound.triangles;
    const Retention &soil =
      bound.scene.materials.law(triangles.material[cell]).retention();
    if (!soil.adds_strength())
      return std::nullopt;
    std::array<double, 3> p;
    for (unsigned int i = 0; i < 3; ++i)
      p[i] = bound.scene.water.initial_suction_stress(
               triangles.vertices[triangles.cells[cell][i]], soil) /
             bound.units.stress;
    return p;
  }

  void
  add_suction(BoundProblem                    &problem,
              const BoundScene                &bound,
              const double                     volume,
              const double                     p,
              const StrainMatrix              &B,
              const std::vector<unsigned int> &dofs)
  {
    Mandel one = Mandel::Zero();
    one[0] = one[1]         = 1.;
    const Eigen::VectorXd f = volume * p * B.transpose() * to_cone_axes(one);
    Eigen::VectorXd      &F = bound.loads(problem, LoadFactor::all);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      F[dofs[i]] += f[i];
  }

  void
  apply_conditions(const BoundScene &bound,
                   const BoundSide   side,
                   BoundProblem     &problem)
  {
    const Triangles &triangles = bound.triangles;
    for (const auto &condition : bound.scene.dirichlet.list)
      for (const auto &held : triangles.held_edges(*condition))
        for (const EdgeNode &node : nodes_of(bound, side, held))
          for_prescribed(
            *condition,
            node.of_velocity,
            outward_normal(triangles, held.cell, held.opposite_vertex),
            bound.units.velocity,
            [&](const unsigned int d, const double value) {
              problem.is_prescribed[node.dof + d] = true;
              problem.prescribed[node.dof + d]    = value;
            });
    for (const auto &load : bound.scene.tractions.list)
      add_tractions(
        bound, side, *load, bound.loads(problem, LoadFactor::tractions));
  }

  void
  for_prescribed(const BoundaryCondition                         &condition,
                 const Point<dim>                                &x,
                 const Tensor<1, dim>                            &n,
                 const double                                     unit,
                 const std::function<void(unsigned int, double)> &f)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (condition.components[d])
        f(d, condition.components[d]->value(x, 0.) / unit);
    if (condition.normal && is_along_axis(n)) // else there is an interface
      {
        const unsigned int d = std::abs(n[0]) > 0.5 ? 0 : 1;
        f(d, n[d] * condition.normal->value(x, 0.) / unit);
      }
  }

  Tensor<1, dim>
  weight_of_cell(const BoundScene &bound, const unsigned int cell)
  {
    // Triangles do not cross the water, whose lines are edges of the mesh.
    const Scene &scene = bound.scene;
    return scene.density(bound.triangles.material[cell],
                         bound.triangles.centre(cell)) *
           scene.gravity.at(std::numeric_limits<double>::max()) *
           bound.units.length / bound.units.stress;
  }

  Tensor<1, dim>
  seepage_force_of_cell(const BoundScene &bound, const unsigned int cell)
  {
    const Water     &water     = bound.scene.water;
    const Triangles &triangles = bound.triangles;
    const double     unit      = bound.units.length / bound.units.stress;
    if (!water.varies_in_cells())
      return water.force(triangles.centre(cell)) * unit;
    const auto     g = triangles.gradients(cell);
    Tensor<1, dim> force;
    for (unsigned int i = 0; i < 3; ++i)
      force -=
        water.pressure(triangles.vertices[triangles.cells[cell][i]]) * g[i];
    return force * unit;
  }

  void
  add_force_of_cell(const BoundScene     &bound,
                    const BoundSide       side,
                    const unsigned int    cell,
                    const Tensor<1, dim> &force,
                    Eigen::VectorXd      &F)
  {
    const Triangles &triangles = bound.triangles;
    const double     area =
      triangles.area(cell) / (bound.units.length * bound.units.length);
    for (unsigned int d = 0; d < dim; ++d)
      if (side == BoundSide::lower)
        F[dim * cell + d] += force[d] * area;
      else // the integral is zero for a vertex function and A/3 for an edge function
        for (unsigned int i = 3; i < 6; ++i)
          F[dof_of_node(bound, bound.bars.node_of_cell(triangles, cell, i)) +
            d] += force[d] * area / 3.;
  }

  void
  add_tractions(const BoundScene        &bound,
                const BoundSide          side,
                const BoundaryCondition &load,
                Eigen::VectorXd         &F,
                const double             time)
  {
    const Triangles &triangles = bound.triangles;
    for (const auto &held : triangles.held_edges(load))
      {
        const double length =
          triangles.edge_length(held.edge) / bound.units.length;
        for (const EdgeNode &node : nodes_of(bound, side, held))
          {
            const Tensor<1, dim> t = traction(
              load,
              node.of_traction,
              outward_normal(triangles, held.cell, held.opposite_vertex),
              bound.units.stress,
              time);
            for (unsigned int d = 0; d < dim; ++d)
              F[node.dof + d] += node.part * length * t[d];
            if (node.jump)
              F[*node.jump] +=
                node.part * length * (t * along_mesh(triangles, held.edge));
          }
      }
  }

  double
  largest_traction(const BoundScene &bound, const BoundaryCondition &load)
  {
    const Triangles &triangles = bound.triangles;
    double           largest   = 0.;
    for (const auto &held : triangles.held_edges(load))
      for (const unsigned int v : triangles.edges[held.edge].vertices)
        largest = std::max(
          largest,
          traction(load,
                   triangles.vertices[v],
                   outward_normal(triangles, held.cell, held.opposite_vertex),
                   1.,
                   0.)
            .norm());
    return largest;
  }

  double
  departure_of_traction(const BoundScene        &bound,
                        const BoundaryCondition &load,
                        const double             time)
  {
    const Triangles &triangles = bound.triangles;
    double           largest = 0., departure = 0.;
    for (const auto &held : triangles.held_edges(load))
      {
        const auto &ends = triangles.edges[held.edge].vertices;
        const std::array<Point<dim>, dim> places = {
          {triangles.vertices[ends[0]], triangles.vertices[ends[1]]}};
        const auto at = [&](const Point<dim> &x) {
          return traction(
            load,
            x,
            outward_normal(triangles, held.cell, held.opposite_vertex),
            1.,
            time);
        };
        for (const Point<dim> &x : places)
          largest = std::max(largest, at(x).norm());
        departure = std::max(departure, departure_from_linear(at, places));
      }
    return departure > 0. ? departure / std::max(largest, departure) : 0.;
  }
} // namespace geocone::GEOCONE_DIM
