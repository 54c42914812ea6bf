// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/fitted_mesh.h>
#include <geocone/limit_analysis/bound_problem.h>
#include <geocone/materials/second_order_cone.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace geocone
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** The part of the edge from a to b that is in the box of a condition; all or
     *  nothing if it is but for a rounding. */
    double
    part_in_box(const BoundaryCondition &condition,
                const Point<dim>        &a,
                const Point<dim>        &b)
    {
      const auto corners = condition.box_corners();
      if (!corners)
        return 1.;
      double       from = 0., to = 1.;
      const double tolerance =
        1e-9 * (1. + (*corners)[0].distance((*corners)[1]));
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double low   = (*corners)[0][d] - tolerance - a[d],
                       high  = (*corners)[1][d] + tolerance - a[d],
                       along = b[d] - a[d];
          if (std::abs(along) < tolerance)
            {
              if (low > 0. || high < 0.)
                return 0.;
              continue;
            }
          from = std::max(from, std::min(low / along, high / along));
          to   = std::min(to, std::max(low / along, high / along));
        }
      const double part     = std::max(0., to - from);
      const double rounding = 1e-6 + 3. * tolerance / a.distance(b);
      return part < rounding ? 0. : part > 1. - rounding ? 1. : part;
    }
  } // namespace

  Triangles::Triangles(const CoarseMesh &mesh)
    : vertices(mesh.points)
    , sides(mesh.sides)
  {
    std::map<std::array<unsigned int, 2>, unsigned int> number;
    const auto sorted = [](const unsigned int a, const unsigned int b) {
      return std::array<unsigned int, 2>{{std::min(a, b), std::max(a, b)}};
    };
    for (const auto &cell : mesh.cells)
      {
        cells.push_back(
          {{cell.vertices[0], cell.vertices[1], cell.vertices[2]}});
        if (area(cells.size() - 1) < 0.)
          std::swap(cells.back()[1], cells.back()[2]);
        material.push_back(cell.material_id);
        edges_of_cell.emplace_back();
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto ends =
              sorted(cells.back()[(i + 1) % 3], cells.back()[(i + 2) % 3]);
            const auto [entry, is_new] = number.emplace(ends, edges.size());
            if (is_new)
              edges.push_back({ends, -1});
            edges_of_cell.back()[i] = entry->second;
          }
      }
    for (const auto &line : mesh.boundary.boundary_lines)
      edges[number.at(sorted(line.vertices[0], line.vertices[1]))].side =
        line.boundary_id;
  }

  std::vector<Triangles::HeldEdge>
  Triangles::held_edges(const BoundaryCondition &condition) const
  {
    std::set<dealii::types::boundary_id> all;
    for (const Edge &edge : edges)
      if (edge.side >= 0)
        all.insert(edge.side);
    const auto ids = side_ids(condition, sides, {all.begin(), all.end()});
    std::vector<HeldEdge> held;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Edge &edge = edges[edges_of_cell[c][i]];
          if (edge.side < 0 || ids.count(edge.side) == 0)
            continue;
          const Point<dim> &a = vertices[edge.vertices[0]],
                           &b = vertices[edge.vertices[1]];
          const double part   = part_in_box(condition, a, b);
          if (part == 0.)
            continue;
          if (part < 1.)
            throw InputError(
              condition.parameter("Box"),
              condition.part(),
              "a box that ends at vertices of the mesh",
              format("the edge from (%g, %g) to (%g, %g) is partly in it, "
                     "but a bound needs the exact part; add the ends of the "
                     "box to 'Mesh/Grading points'",
                     a[0],
                     a[1],
                     b[0],
                     b[1]));
          held.push_back({edges_of_cell[c][i], c, i});
        }
    condition.check_selection(held.size());
    return held;
  }

  double
  Triangles::area(const unsigned int cell) const
  {
    const auto &[i, j, k]  = cells[cell];
    const Tensor<1, dim> a = vertices[j] - vertices[i],
                         b = vertices[k] - vertices[i];
    return (a[0] * b[1] - a[1] * b[0]) / 2.;
  }

  std::array<Tensor<1, dim>, 3>
  Triangles::gradients(const unsigned int cell) const
  {
    std::array<Tensor<1, dim>, 3> g;
    const double                  twice = 2. * area(cell);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Tensor<1, dim> along = vertices[cells[cell][(i + 2) % 3]] -
                                     vertices[cells[cell][(i + 1) % 3]];
        g[i] = Tensor<1, dim>({-along[1], along[0]}) / twice;
      }
    return g;
  }

  unsigned int
  BoundProblem::n_unknowns() const
  {
    return std::count(is_prescribed.begin(), is_prescribed.end(), false);
  }

  namespace
  {
    /** sym(b x g) of the unit vector b along a component, in cone axes. */
    Mandel
    symmetric_part(const unsigned int component, const Tensor<1, dim> &g)
    {
      Mandel e     = Mandel::Zero();
      e[component] = g[component];
      e[2]         = g[1 - component] / sqrt2;
      return to_cone_axes(e);
    }

    /** What all spaces share: points, cones, and room for n dofs. */
    BoundProblem
    begin_problem(const BoundScene  &bound,
                  const unsigned int n_local,
                  const unsigned int n_dofs)
    {
      const Triangles &triangles = bound.triangles;
      const double     L         = bound.units.length;
      BoundProblem     problem;
      problem.n_local = n_local;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          {
            problem.volume.push_back(triangles.area(c) / 3. / (L * L));
            problem.cone.push_back(bound.cones[triangles.material[c]]);
          }
      problem.is_prescribed.assign(n_dofs, false);
      problem.prescribed.setZero(n_dofs);
      problem.dead.setZero(n_dofs);
      problem.live.setZero(n_dofs);
      return problem;
    }

    /** The vector to which tractions or weight are added. */
    Eigen::VectorXd &
    loads(BoundProblem &problem, const BoundScene &bound, const LoadFactor kind)
    {
      return bound.factor == kind ? problem.live : problem.dead;
    }

    /** Weight per area of a cell, in units. */
    Tensor<1, dim>
    weight(const BoundScene &bound, const unsigned int cell)
    {
      const Scene &scene = bound.scene;
      return scene.materials.law(bound.triangles.material[cell]).density() *
             scene.gravity.at(std::numeric_limits<double>::max()) *
             bound.units.length / bound.units.stress;
    }

    /** The outward normal of a boundary edge. */
    Tensor<1, dim>
    outward_normal(const Triangles   &triangles,
                   const unsigned int cell,
                   const unsigned int opposite_vertex)
    {
      const Tensor<1, dim> g = triangles.gradients(cell)[opposite_vertex];
      return -1. * g / g.norm();
    }

    /** The component along which a normal is. @throws InputError if oblique */
    unsigned int
    axis_of(const Tensor<1, dim> &n, const BoundaryCondition &condition)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(n[1 - d]) < 1e-9)
          return d;
      throw InputError(condition.parameter("Velocity normal"),
                       condition.formula(dim),
                       "sides along x or y with 'Analysis/Kind' = limit load",
                       "prescribe both components, or turn the scene");
    }

    /** Calls f(condition, edge, its cell, the vertex opposite to it) for all
     *  edges that conditions of a list hold, in its order. */
    template <typename Function>
    void
    for_each_held_edge(const BoundaryConditions &conditions,
                       const Triangles          &triangles,
                       const Function           &f)
    {
      for (const auto &condition : conditions.list)
        for (const auto &held : triangles.held_edges(*condition))
          f(*condition, held.edge, held.cell, held.opposite_vertex);
    }

    /** Calls f(component, value) for what a condition prescribes at x. */
    template <typename Function>
    void
    prescribe(const BoundaryCondition &condition,
              const Point<dim>        &x,
              const Tensor<1, dim>    &n,
              const double             unit,
              const Function          &f)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (condition.components[d])
          f(d, condition.components[d]->value(x, 0.) / unit);
      if (condition.normal)
        {
          const unsigned int d = axis_of(n, condition);
          f(d, n[d] * condition.normal->value(x, 0.) / unit);
        }
    }

    /** The traction of a load at x, in units. */
    Tensor<1, dim>
    traction(const BoundaryCondition &load,
             const Point<dim>        &x,
             const Tensor<1, dim>    &n,
             const double             unit)
    {
      Tensor<1, dim> t = load.vector_on_side(x, n, 0.);
      for (unsigned int d = 0; d < dim; ++d)
        if (load.components[d])
          t[d] += load.components[d]->value(x, 0.);
      return t / unit;
    }
  } // namespace

  BoundProblem::Strains
  strains_of_quadratic(const Triangles &triangles, const unsigned int cell)
  {
    const auto            g = triangles.gradients(cell);
    BoundProblem::Strains B = BoundProblem::Strains::Zero(9, 12);
    for (unsigned int i = 0; i < 3; ++i) // at vertex i
      for (unsigned int f = 0; f < 6; ++f)
        {
          // Of the function of vertex f, or of the edge opposite to vertex f - 3.
          Tensor<1, dim> gradient;
          if (f < 3)
            gradient = f == i ? 3. * g[f] : -1. * g[f];
          else
            {
              const unsigned int j = (f - 3 + 1) % 3, k = (f - 3 + 2) % 3;
              if (i == j)
                gradient = 4. * g[k];
              else if (i == k)
                gradient = 4. * g[j];
            }
          for (unsigned int d = 0; d < dim; ++d)
            B.block<3, 1>(3 * i, dim * f + d) = symmetric_part(d, gradient);
        }
    return B;
  }

  BoundProblem
  upper_problem(const BoundScene &bound)
  {
    const Triangles   &triangles  = bound.triangles;
    const double       L          = bound.units.length;
    const unsigned int n_vertices = triangles.vertices.size();
    BoundProblem       problem =
      begin_problem(bound, 12, dim * (n_vertices + triangles.edges.size()));
    std::vector<bool> is_used(n_vertices, false);
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        problem.B.push_back(L * strains_of_quadratic(triangles, c));
        for (unsigned int f = 0; f < 6; ++f)
          for (unsigned int d = 0; d < dim; ++d)
            problem.dofs.push_back(
              dim * (f < 3 ? triangles.cells[c][f]
                           : n_vertices + triangles.edges_of_cell[c][f - 3]) +
              d);
        for (const unsigned int v : triangles.cells[c])
          is_used[v] = true;
        // The integral of a vertex function is zero, of an edge function A/3.
        Eigen::VectorXd     &F = loads(problem, bound, LoadFactor::weight);
        const Tensor<1, dim> w = weight(bound, c);
        for (unsigned int f = 3; f < 6; ++f)
          for (unsigned int d = 0; d < dim; ++d)
            F[problem.dofs[12 * c + dim * f + d]] +=
              w[d] * problem.volume[3 * c];
      }
    for (unsigned int v = 0; v < n_vertices; ++v)
      if (!is_used[v]) // of another mesh level
        for (unsigned int d = 0; d < dim; ++d)
          problem.is_prescribed[dim * v + d] = true;

    const auto on_edge = [&](const unsigned int e, const auto &f) {
      const auto       &ends = triangles.edges[e].vertices;
      const Point<dim> &a    = triangles.vertices[ends[0]],
                       &b    = triangles.vertices[ends[1]];
      f(ends[0], a, 1. / 6.);
      f(ends[1], b, 1. / 6.);
      f(n_vertices + e, Point<dim>(a + (b - a) / 2.), 2. / 3.);
    };
    for_each_held_edge(
      bound.scene.dirichlet,
      triangles,
      [&](const BoundaryCondition &condition,
          const unsigned int       e,
          const unsigned int       c,
          const unsigned int       i) {
        const Tensor<1, dim> n = outward_normal(triangles, c, i);
        on_edge(
          e, [&](const unsigned int node, const Point<dim> &x, const double) {
            prescribe(condition,
                      x,
                      n,
                      bound.units.velocity,
                      [&](const unsigned int d, const double value) {
                        problem.is_prescribed[dim * node + d] = true;
                        problem.prescribed[dim * node + d]    = value;
                      });
          });
      });
    // Simpson's rule is exact for linear tractions.
    for_each_held_edge(
      bound.scene.tractions,
      triangles,
      [&](const BoundaryCondition &load,
          const unsigned int       e,
          const unsigned int       c,
          const unsigned int       i) {
        const Tensor<1, dim> n    = outward_normal(triangles, c, i);
        const auto          &ends = triangles.edges[e].vertices;
        const double         length =
          triangles.vertices[ends[0]].distance(triangles.vertices[ends[1]]) / L;
        Eigen::VectorXd &F = loads(problem, bound, LoadFactor::tractions);
        on_edge(
          e,
          [&](const unsigned int node, const Point<dim> &x, const double part) {
            const Tensor<1, dim> t = traction(load, x, n, bound.units.stress);
            for (unsigned int d = 0; d < dim; ++d)
              F[dim * node + d] += part * length * t[d];
          });
      });
    return problem;
  }

  BoundProblem
  lower_problem(const BoundScene &bound)
  {
    const Triangles   &triangles = bound.triangles;
    const double       L         = bound.units.length;
    const unsigned int n_cells   = triangles.cells.size();
    BoundProblem       problem =
      begin_problem(bound, 14, dim * (n_cells + 2 * triangles.edges.size()));
    const auto end_dof = [&](const unsigned int edge,
                             const unsigned int vertex,
                             const unsigned int component) {
      const unsigned int end =
        triangles.edges[edge].vertices[0] == vertex ? 0 : 1;
      return dim * (n_cells + 2 * edge + end) + component;
    };
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto            g = triangles.gradients(c);
        BoundProblem::Strains B = BoundProblem::Strains::Zero(9, 14);
        for (unsigned int d = 0; d < dim; ++d)
          {
            problem.dofs.push_back(dim * c + d);
            for (unsigned int i = 0; i < 3; ++i)
              B.block<3, 1>(3 * i, d) = -3. * symmetric_part(d, g[i]);
          }
        // Edge e, opposite to vertex e: L_e n_e = -2 A grad lambda_e.
        for (unsigned int e = 0; e < 3; ++e)
          for (unsigned int end = 0; end < 2; ++end)
            {
              const unsigned int i = (e + 1 + end) % 3;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  B.block<3, 1>(3 * i, 2 + 4 * e + 2 * end + d) =
                    -3. * symmetric_part(d, g[e]);
                  problem.dofs.push_back(end_dof(
                    triangles.edges_of_cell[c][e], triangles.cells[c][i], d));
                }
            }
        problem.B.push_back(L * B);
        Eigen::VectorXd     &F = loads(problem, bound, LoadFactor::weight);
        const Tensor<1, dim> w = weight(bound, c);
        for (unsigned int d = 0; d < dim; ++d)
          F[dim * c + d] += w[d] * 3. * problem.volume[3 * c];
      }

    for_each_held_edge(
      bound.scene.dirichlet,
      triangles,
      [&](const BoundaryCondition &condition,
          const unsigned int       e,
          const unsigned int       c,
          const unsigned int       i) {
        const auto &ends = triangles.edges[e].vertices;
        for (const unsigned int v : ends)
          {
            // w is the value at the third point of a linear velocity.
            const Point<dim> &a = triangles.vertices[v],
                             &b = triangles.vertices[ends[0] + ends[1] - v];
            prescribe(condition,
                      Point<dim>(a + (b - a) / 3.),
                      outward_normal(triangles, c, i),
                      bound.units.velocity,
                      [&](const unsigned int d, const double value) {
                        problem.is_prescribed[end_dof(e, v, d)] = true;
                        problem.prescribed[end_dof(e, v, d)]    = value;
                      });
          }
      });
    for_each_held_edge(
      bound.scene.tractions,
      triangles,
      [&](const BoundaryCondition &load,
          const unsigned int       e,
          const unsigned int       c,
          const unsigned int       i) {
        const auto  &ends = triangles.edges[e].vertices;
        const double length =
          triangles.vertices[ends[0]].distance(triangles.vertices[ends[1]]) / L;
        Eigen::VectorXd &F = loads(problem, bound, LoadFactor::tractions);
        for (const unsigned int v : ends)
          {
            const Tensor<1, dim> t = traction(load,
                                              triangles.vertices[v],
                                              outward_normal(triangles, c, i),
                                              bound.units.stress);
            for (unsigned int d = 0; d < dim; ++d)
              F[end_dof(e, v, d)] += length / 2. * t[d];
          }
      });
    return problem;
  }
} // namespace geocone
