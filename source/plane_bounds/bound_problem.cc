// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/plane_bounds/bar_rows.h>
#include <geocone/plane_bounds/bound_loads.h>
#include <geocone/plane_bounds/interface_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  void
  BoundScene::change(const unsigned int material,
                     const double       tan_phi,
                     const double       k_factor,
                     const double       tension_factor)
  {
    const double cos_phi = 1. / std::sqrt(1. + tan_phi * tan_phi);
    PointCone   &cone    = cones[material];
    cone.a               = tan_phi * cos_phi;
    cone.k *= k_factor * cos_phi;
    cone.cut_off *= tension_factor;
    growth[material].slope *= k_factor * cos_phi;
    if (enclosed.has(material))
      enclosed.k_per_cohesion[material] *= k_factor * cos_phi;
  }

  void
  BoundScene::add_steeper(PointCone &cone, const double b)
  {
    const double cos_phi = std::sqrt(1. - cone.a * cone.a);
    if (!cone.is_cut())
      {
        cone.cut_aperture = b;
        cone.cut_off      = cone.k * std::sqrt(1. - b * b) / cos_phi;
        return;
      }
    const double crossing =
      cone.k / cos_phi * std::tan((std::asin(cone.a) + std::asin(b)) / 2.);
    cone.cut_off = std::min(cone.cut_off, cone.k - (1. - cone.a) * crossing);
  }

  Eigen::VectorXd &
  BoundScene::loads(BoundProblem &problem, const LoadFactor kind) const
  {
    return factor == kind || factor == LoadFactor::all ? problem.live
                                                       : problem.dead;
  }

  bool
  BoundProblem::has_incompressible() const
  {
    return std::any_of(cone.begin(), cone.end(), [](const PointCone &one) {
      return one.is_incompressible();
    });
  }

  bool
  BoundProblem::can_be_scaled() const
  {
    return dead.squaredNorm() == 0. &&
           std::all_of(cone.begin(), cone.end(), [](const PointCone &one) {
             return one.k > 0. && one.ellipse.offset == 0.;
           });
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

    /** Finds the triangles where a cut-off reduces the cone of a point, and removes the
     *  cut-off of the others. */
    std::vector<unsigned int>
    cut_triangles(std::vector<PointCone> &cone)
    {
      std::vector<unsigned int> all;
      for (unsigned int c = 0; 3 * c < cone.size(); ++c)
        {
          PointCone *const own = &cone[3 * c];
          if (std::any_of(own, own + 3, [](const PointCone &one) {
                return one.is_cut() &&
                       one.a * one.cut_off < one.cut_aperture * one.k;
              }))
            all.push_back(c);
          else
            for (unsigned int i = 0; i < 3; ++i)
              own[i].cut_off = infinite_tension;
        }
      return all;
    }

    /** Problem with points, cones and zero vectors, and dofs for the cut-offs.
     *  @param n_columns largest number of dofs of a point, without its cut-off
     *  @param n_dofs without cut-offs */
    BoundProblem
    begin_problem(const BoundScene &bound,
                  const BoundSide   side,
                  unsigned int      n_columns,
                  unsigned int      n_dofs)
    {
      const Triangles &triangles = bound.triangles;
      const double     L         = bound.units.length;
      BoundProblem     problem;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          {
            problem.volume.push_back(triangles.area(c) / 3. / (L * L));
            problem.cone.push_back(bound.cone_at(side, c, i));
          }
      problem.n_triangles   = triangles.cells.size();
      problem.first_cut_dof = n_dofs;
      problem.cut           = cut_triangles(problem.cone);
      if (!problem.cut.empty())
        n_columns += 3;
      n_dofs += 9 * problem.cut.size();
      problem.B = PointStrains(n_columns);
      problem.is_prescribed.assign(n_dofs, false);
      problem.has_no_force.assign(n_dofs, false);
      problem.prescribed.setZero(n_dofs);
      problem.dead.setZero(n_dofs);
      problem.live.setZero(n_dofs);
      return problem;
    }

    /** Dofs of the rate w of a point of a cut-off. @param c index in
     *  BoundProblem::cut */
    std::vector<unsigned int>
    cut_dofs(const BoundProblem &problem,
             const unsigned int  c,
             const unsigned int  i)
    {
      const unsigned int first = problem.first_cut_dof + 9 * c + 3 * i;
      return {first, first + 1, first + 2};
    }

    /** Adds point i of a triangle, with its rates B q - w. */
    void
    add_point_of_triangle(BoundProblem             &problem,
                          const unsigned int        triangle,
                          const unsigned int        i,
                          StrainMatrix              B,
                          std::vector<unsigned int> dofs)
    {
      const auto cut =
        std::lower_bound(problem.cut.begin(), problem.cut.end(), triangle);
      if (cut != problem.cut.end() && *cut == triangle)
        {
          const auto w = cut_dofs(problem, cut - problem.cut.begin(), i);
          dofs.insert(dofs.end(), w.begin(), w.end());
          B.conservativeResize(3, B.cols() + 3);
          B.rightCols<3>() = -Eigen::Matrix3d::Identity();
        }
      problem.B.add(B, dofs);
    }

    /** Adds the cut-offs as the last cells. */
    void
    add_cut_offs(BoundProblem &problem)
    {
      for (unsigned int c = 0; c < problem.cut.size(); ++c)
        {
          const unsigned int triangle = problem.cut[c];
          problem.owner.push_back(triangle);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const PointCone own = problem.cone[3 * triangle + i];
              problem.volume.push_back(problem.volume[3 * triangle + i]);
              problem.cone.push_back({own.cut_aperture, own.cut_off});
              problem.B.add(Eigen::Matrix3d::Identity(),
                            cut_dofs(problem, c, i));
            }
        }
    }

    /** StrainMatrix at vertex i of a cell of quadratic velocities, in cone axes.
     *  @param g gradients of its barycentric coordinates */
    StrainMatrix
    strains_of_quadratic(const std::array<Tensor<1, dim>, 3> &g,
                         const unsigned int                   i)
    {
      StrainMatrix B = StrainMatrix::Zero(3, 12);
      for (unsigned int f = 0; f < 6; ++f)
        {
          // Gradient of the function of vertex f, or of the edge opposite to vertex f -
          // 3.
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
            B.col(dim * f + d) = symmetric_part(d, gradient);
        }
      return B;
    }

    /**
     * Upper estimate of the dissipation: for linear strength and a convex function D of
     * linear rates, the integrand is at most sum_ij l_i l_j k_i D(e_j), l_i the
     * barycentric coordinates, whose integral is A/3 sum_j D(e_j) (k_j + sum_i k_i)/4.
     * With a cut-off, D has the factor k - a cut_off, which must not be negative: where
     * the cone is smaller than the cut-off, it is enlarged to it.
     */
    void
    bound_dissipation_from_above(BoundProblem &problem)
    {
      for (unsigned int c = 0; c < problem.n_triangles; ++c)
        {
          PointCone *const cone = &problem.cone[3 * c];
          if (cone[0].k == cone[1].k && cone[1].k == cone[2].k)
            continue;
          double k[3];
          for (unsigned int i = 0; i < 3; ++i)
            k[i] = cone[i].is_cut()
                     ? std::max(cone[i].k, cone[i].a * cone[i].cut_off)
                     : cone[i].k;
          for (unsigned int i = 0; i < 3; ++i)
            cone[i].k = (k[i] + k[0] + k[1] + k[2]) / 4.;
        }
    }

    /** Excludes stress-free points of cohesionless soil at free surfaces.
     *  @param end_dof (cell, edge, vertex) -> its x dof */
    template <typename EndDof>
    void
    free_surfaces_without_cohesion(const BoundScene &bound,
                                   const EndDof     &end_dof,
                                   BoundProblem     &problem)
    {
      const Triangles       &triangles = bound.triangles;
      const PlasticBars     &bars      = bound.bars;
      std::vector<bool>      is_apex(bars.n_sectors(triangles), false);
      std::set<unsigned int> slides;
      for (const Interface &interface : bound.interfaces)
        slides.insert(interface.held.edge);
      for (const PlasticBars::BarEdge &bar : bars.edges)
        slides.insert(bar.edge);
      for (const auto &outer : triangles.outer_edges())
        if (slides.count(outer.edge) == 0)
          for (const unsigned int i : {(outer.opposite_vertex + 1) % 3,
                                       (outer.opposite_vertex + 2) % 3})
            {
              const unsigned int v       = triangles.cells[outer.cell][i];
              bool               is_free = true;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const unsigned int dof =
                    end_dof(outer.cell, outer.edge, v) + d;
                  is_free = is_free && !problem.is_prescribed[dof] &&
                            problem.dead[dof] == 0. && problem.live[dof] == 0.;
                }
              if (is_free)
                is_apex[bars.sector(triangles, outer.cell, i)] = true;
            }
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          if (problem.cone[3 * c + i].k > 0.)
            is_apex[bars.sector(triangles, c, i)] = false;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          if (is_apex[bars.sector(triangles, c, i)])
            {
              const unsigned int v    = triangles.cells[c][i];
              problem.cone[3 * c + i] = inactive_cone;
              problem.B.remove(3 * c + i);
              for (const unsigned int e : {(i + 1) % 3, (i + 2) % 3})
                {
                  const unsigned int edge = triangles.edges_of_cell[c][e];
                  const int          bar  = bars.number_of_edge(edge);
                  if (bar >= 0 && !bars.has_weak_interface(bar))
                    continue; // the structure is loaded from its other side
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      const unsigned int dof     = end_dof(c, edge, v) + d;
                      problem.has_no_force[dof]  = true;
                      problem.is_prescribed[dof] = true;
                      problem.prescribed[dof]    = 0.;
                    }
                }
            }
    }

    /** Adds the cells of the lower bound, with velocities of the cell and of both ends
     *  of each edge. @param end_dof (cell, edge, vertex) -> its x dof */
    template <typename EndDof>
    void
    add_linear_cells(const BoundScene &bound,
                     const EndDof     &end_dof,
                     BoundProblem     &problem)
    {
      const Triangles &triangles = bound.triangles;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        {
          const auto g       = triangles.gradients(c);
          const auto suction = suction_of_cell(bound, c);
          for (unsigned int i = 0; i < 3; ++i)
            {
              // The translation, and the ends at this vertex of both edges e, opposite
              // to vertex e: L_e n_e = -2 A grad lambda_e.
              StrainMatrix              B(3, 6);
              std::vector<unsigned int> dofs;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  B.col(d) = -3. * symmetric_part(d, g[i]);
                  dofs.push_back(dim * c + d);
                }
              for (const unsigned int e : {(i + 1) % 3, (i + 2) % 3})
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    B.col(dofs.size()) = -3. * symmetric_part(d, g[e]);
                    dofs.push_back(end_dof(c,
                                           triangles.edges_of_cell[c][e],
                                           triangles.cells[c][i]) +
                                   d);
                  }
              B *= bound.units.length;
              add_point_of_triangle(problem, c, i, B, dofs);
              if (suction) // linear stresses: the balance is exact
                add_suction(problem,
                            bound,
                            problem.volume[3 * c + i],
                            (*suction)[i],
                            B,
                            dofs);
            }
          add_body_forces(problem, bound, BoundSide::lower, c);
        }
    }
  } // namespace

  BoundProblem
  upper_problem(const BoundScene &bound)
  {
    const Triangles   &triangles  = bound.triangles;
    const double       L          = bound.units.length;
    const unsigned int n_vertices = triangles.vertices.size();
    const unsigned int n_nodes    = n_vertices + triangles.edges.size();
    BoundProblem       problem =
      begin_problem(bound,
                    BoundSide::upper,
                    10,
                    dim * n_nodes + n_dofs_of_interfaces(bound) +
                      n_dofs_of_bars(bound, BoundSide::upper));
    bound_dissipation_from_above(problem);
    std::vector<bool> is_used(n_vertices, false);
    const auto        dof = [&](const unsigned int c, const unsigned int i) {
      return dof_of_node(bound, bound.bars.node_of_cell(triangles, c, i));
    };
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        std::vector<unsigned int> dofs;
        for (unsigned int f = 0; f < 6; ++f)
          for (unsigned int d = 0; d < dim; ++d)
            dofs.push_back(dof(c, f) + d);
        const auto g       = triangles.gradients(c);
        const auto suction = suction_of_cell(bound, c);
        for (unsigned int i = 0; i < 3; ++i)
          {
            const StrainMatrix B = L * strains_of_quadratic(g, i);
            add_point_of_triangle(problem, c, i, B, dofs);
            if (suction) // the integral of linear p and div v is exact
              add_suction(problem,
                          bound,
                          problem.volume[3 * c + i],
                          ((*suction)[i] + (*suction)[0] + (*suction)[1] +
                           (*suction)[2]) /
                            4.,
                          B,
                          dofs);
          }
        for (unsigned int i = 0; i < 3; ++i)
          if (const unsigned int v = bound.bars.node_of_cell(triangles, c, i);
              v < n_vertices)
            is_used[v] = true;
        add_body_forces(problem, bound, BoundSide::upper, c);
      }
    for (unsigned int v = 0; v < n_vertices; ++v)
      if (!is_used[v]) // gmsh keeps outline points without cells
        for (unsigned int d = 0; d < dim; ++d)
          problem.is_prescribed[dim * v + d] = true;

    apply_conditions(bound, BoundSide::upper, problem);
    add_interfaces(
      bound,
      [&](const Triangles::HeldEdge &held) {
        const auto        &ends     = triangles.edges[held.edge].vertices;
        const unsigned int i        = (held.opposite_vertex + 1) % 3,
                           j        = (held.opposite_vertex + 2) % 3;
        const bool         is_first = triangles.cells[held.cell][i] == ends[0];
        const unsigned int a        = dof(held.cell, is_first ? i : j),
                           b        = dof(held.cell, is_first ? j : i),
                           m        = dof(held.cell, held.opposite_vertex + 3);
        const Point<dim> &x  = triangles.vertices[ends[0]],
                         &y  = triangles.vertices[ends[1]];
        return std::array<InterfacePoint, 3>{{{1. / 3., {{a, 1.}}, x},
                                              {1. / 3.,
                                               {{m, 2.}, {a, -0.5}, {b, -0.5}},
                                               Point<dim>(x + (y - x) / 2.)},
                                              {1. / 3., {{b, 1.}}, y}}};
      },
      dim * n_nodes,
      problem);
    add_bars(bound, BoundSide::upper, problem);
    add_cut_offs(problem);
    return problem;
  }

  BoundProblem
  lower_problem(const BoundScene &bound)
  {
    const Triangles   &triangles = bound.triangles;
    const unsigned int n_cells   = triangles.cells.size();
    const unsigned int n_nodes   = n_cells + 2 * triangles.edges.size();
    BoundProblem       problem =
      begin_problem(bound,
                    BoundSide::lower,
                    n_lower_columns(bound),
                    dim * n_nodes + n_dofs_of_interfaces(bound) +
                      n_dofs_of_bars(bound, BoundSide::lower));
    const auto end_dof = [&](const unsigned int cell,
                             const unsigned int edge,
                             const unsigned int vertex) {
      return dof_at_end_of_cell(bound, cell, edge, vertex);
    };
    add_linear_cells(bound, end_dof, problem);

    apply_conditions(bound, BoundSide::lower, problem);
    free_surfaces_without_cohesion(bound, end_dof, problem);
    add_interfaces(
      bound,
      [&](const Triangles::HeldEdge &held) {
        const unsigned int edge = held.edge, cell = held.cell;
        const auto        &ends = triangles.edges[edge].vertices;
        // Third points, as for w.
        const Point<dim>    &x     = triangles.vertices[ends[0]];
        const Tensor<1, dim> third = (triangles.vertices[ends[1]] - x) / 3.;
        return std::array<InterfacePoint, 3>{
          {{1. / 2., {{end_dof(cell, edge, ends[0]), 1.}}, x + third},
           {1. / 2., {{end_dof(cell, edge, ends[1]), 1.}}, x + 2. * third},
           {1. / 2., {}, x}}};
      },
      dim * n_nodes,
      problem);
    add_bars(bound, BoundSide::lower, problem);
    add_cut_offs(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
