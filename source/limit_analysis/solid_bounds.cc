// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/solid_bounds.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  unsigned int
  simplex_nodes::node(const unsigned int i, const unsigned int j)
  {
    if (i == j)
      return i;
    for (unsigned int e = 0; e < 6; ++e)
      if (edges[e][0] == std::min(i, j) && edges[e][1] == std::max(i, j))
        return 4 + e;
    return 0;
  }

  std::vector<unsigned int>
  nodes_in_cell(const Tetrahedra  &tetrahedra,
                const unsigned int order,
                const unsigned int facet,
                const unsigned int side)
  {
    const auto               &own = tetrahedra.facets[facet];
    std::vector<unsigned int> nodes;
    for (const unsigned int v : own.vertices)
      nodes.push_back(tetrahedra.index_in_cell(own.cells[side], v));
    if (order == 2)
      for (const auto &[i, j] : simplex_nodes::edges_of_facet)
        nodes.push_back(simplex_nodes::node(nodes[i], nodes[j]));
    return nodes;
  }

  std::array<Tensor<1, dim>, 3>
  axes_of_facet(const Tetrahedra &tetrahedra, const unsigned int facet)
  {
    const Tensor<1, dim> n = tetrahedra.normal(facet);
    const auto          &v = tetrahedra.facets[facet].vertices;
    Tensor<1, dim> t = tetrahedra.vertices[v[1]] - tetrahedra.vertices[v[0]];
    t -= (t * n) * n;
    t /= t.norm();
    return {{n, t, cross_product_3d(n, t)}};
  }

  unsigned int
  cell_of_jump(const SolidScene &bound, const unsigned int facet)
  {
    const auto &cells    = bound.tetrahedra->facets[facet].cells;
    const auto  cohesion = [&](const unsigned int cell) {
      const SpatialStrength &one =
        bound.strengths[bound.tetrahedra->material[cell]];
      return one.face_cohesion_per_k() * one.k;
    };
    return cells[1] != Tetrahedra::none &&
               cohesion(cells[1]) < cohesion(cells[0])
             ? cells[1]
             : cells[0];
  }

  std::vector<double>
  strength_of_rates(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int cell)
  {
    // For a convex D of linear rates the integrand is at most sum_ij l_i l_j k_i D(e_j).
    const auto   k   = bound.strength_at_vertices(cell);
    const double sum = k[0] + k[1] + k[2] + k[3];
    if (order == 1)
      return {sum / 4.};
    std::vector<double> all;
    for (const double one : k)
      all.push_back((one + sum) / 5.);
    return all;
  }

  std::vector<double>
  strength_of_jumps(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int facet)
  {
    const unsigned int   cell = cell_of_jump(bound, facet);
    const SpatialStrength &one =
      bound.strengths[bound.tetrahedra->material[cell]];
    std::array<double, 3> c;
    for (unsigned int i = 0; i < 3; ++i)
      c[i] =
        one.face_cohesion_per_k() *
        one.k_at(bound.tetrahedra
                   ->vertices[bound.tetrahedra->facets[facet].vertices[i]]);
    const double        sum = c[0] + c[1] + c[2];
    std::vector<double> all;
    if (order == 1)
      for (const double own : c)
        all.push_back((own + sum) / 4.);
    else
      {
        for (const double own : c)
          all.push_back((2. * own + sum) / 5.);
        for (const auto &[i, j] : simplex_nodes::edges_of_facet)
          all.push_back((c[i] + c[j] + sum) / 5.);
      }
    return all;
  }

  std::vector<Tensor<1, dim>>
  forces_of_traction(const unsigned int                   order,
                     const std::array<Tensor<1, dim>, 3> &traction)
  {
    const Tensor<1, dim>        sum = traction[0] + traction[1] + traction[2];
    std::vector<Tensor<1, dim>> forces;
    if (order == 1)
      for (const auto &own : traction)
        forces.push_back((sum + own) / 12.);
    else
      {
        for (const auto &own : traction)
          forces.push_back((sum + 2. * own) / 30.);
        for (const auto &[i, j] : simplex_nodes::edges_of_facet)
          forces.push_back((sum + traction[i] + traction[j]) / 30.);
      }
    return forces;
  }

  namespace
  {
    using Points =
      CellPoints<12, MohrCoulombCones, CircularCone, CutMohrCoulombCones>;
    using Faces    = PointGroupOf<FaceCone, 6>;
    using CutFaces = PointGroupOf<CutMohrCoulombCones, 6>;
    using Planes   = PointGroupOf<OpeningCone, 6>;

    CutMohrCoulombCones
    cut_law(const SpatialStrength &one)
    {
      return cut_mohr_coulomb_cones(one.a, one.tension / one.k);
    }

    /** Groups of the points of cells, without points. */
    Points
    empty_points(const SolidScene &bound)
    {
      return Points(
        bound.strengths,
        [](const auto &one) { return mohr_coulomb_cones(one.a); },
        [](const auto &one) { return circular_cone(one.a); },
        cut_law);
    }

    /** sym(b x g) of the unit vector b along a component. */
    Eigen::Matrix<double, 6, 1>
    symmetric_product(const unsigned int component, const Tensor<1, dim> &g)
    {
      Eigen::Matrix<double, 6, 1> e = Eigen::Matrix<double, 6, 1>::Zero();
      e[index_of_normal[component]] = g[component];
      for (const auto &[place, i, j] : shears)
        {
          if (component == static_cast<unsigned int>(i))
            e[place] = g[j] / sqrt2;
          else if (component == static_cast<unsigned int>(j))
            e[place] = g[i] / sqrt2;
        }
      return e;
    }

    /** Adds a force to a node. @param dof of its x component */
    void
    add_load(ConicProblem           &problem,
             const unsigned int      dof,
             const SolidScene::Load &load)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          problem.dead[dof + d] += load.dead[d];
          problem.live[dof + d] += load.live[d];
        }
    }

    SolidScene::Load
    operator*(const double a, const SolidScene::Load &load)
    {
      return {a * load.dead, a * load.live};
    }

    /** Numbers the distinct velocities of fixed facets and of planes. */
    std::map<std::array<double, 3>, unsigned int>
    bodies_of(const SolidScene &bound)
    {
      std::map<std::array<double, 3>, unsigned int> bodies;
      for (const FacetCondition &held : bound.facet_conditions)
        if (held.kind != FacetCondition::Kind::free)
          bodies.emplace(
            std::array<double, 3>{
              {held.velocity[0], held.velocity[1], held.velocity[2]}},
            bodies.size());
      return bodies;
    }

    /** Tractions of a facet of the dead or the live load. */
    std::array<Tensor<1, dim>, 3>
    part_of(const std::array<SolidScene::Load, 3> &tractions, const bool live)
    {
      std::array<Tensor<1, dim>, 3> part;
      for (unsigned int i = 0; i < 3; ++i)
        part[i] = live ? tractions[i].live : tractions[i].dead;
      return part;
    }
  } // namespace

  ConicProblem
  upper_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const double       L          = bound.units.length;
    const unsigned int n_nodes    = simplex_nodes::n_in_cell(order),
                       n_facet    = simplex_nodes::n_on_facet(order),
                       n_cells    = tetrahedra.cells.size();
    const auto         bodies     = bodies_of(bound);
    const unsigned int first_body = dim * n_nodes * n_cells;
    ConicProblem       problem =
      ConicProblem::of_dofs(first_body + dim * bodies.size());
    for (const auto &[velocity, number] : bodies)
      for (unsigned int d = 0; d < dim; ++d)
        {
          problem.is_prescribed[first_body + dim * number + d] = true;
          problem.prescribed[first_body + dim * number + d]    = velocity[d];
        }
    const auto dof_of = [&](const unsigned int cell, const unsigned int node) {
      return dim * (n_nodes * cell + node);
    };

    Points points = empty_points(bound);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto   g = tetrahedra.gradients(c);
        const double V = tetrahedra.volume(c) / (L * L * L);
        const auto   k = strength_of_rates(bound, order, c);
        for (unsigned int i = 0; i < k.size(); ++i)
          {
            // The gradient at vertex i is 2 sum_j v_ij x g_j.
            Points::Strains              B;
            std::array<unsigned int, 12> dofs;
            for (unsigned int j = 0; j < 4; ++j)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  B.col(dim * j + d) = order * L * symmetric_product(d, g[j]);
                  dofs[dim * j + d] =
                    dof_of(c, order == 1 ? j : simplex_nodes::node(i, j)) + d;
                }
            points.add(tetrahedra.material[c], B, dofs, V / k.size(), k[i]);
          }
        for (unsigned int i = 0; i < n_nodes; ++i)
          add_load(problem, dof_of(c, i), V / n_nodes * bound.body_force(c));
      }

    std::vector<FaceCone>            faces;
    std::vector<CutMohrCoulombCones> cut_faces;
    std::vector<unsigned int>        number; // of the law of a material's faces
    for (const SpatialStrength &one : bound.strengths)
      if (one.is_cut())
        {
          number.push_back(cut_faces.size());
          cut_faces.push_back(cut_law(one));
        }
      else
        {
          number.push_back(faces.size());
          faces.push_back(face_cone(one.face_friction()));
        }
    auto jumps     = std::make_unique<Faces>(faces);
    auto cut_jumps = std::make_unique<CutFaces>(cut_faces);
    auto planes =
      std::make_unique<Planes>(std::vector<OpeningCone>{opening_cone()});
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const auto           &facet    = tetrahedra.facets[f];
        const double          A        = tetrahedra.area(f) / (L * L);
        const FacetCondition &held     = bound.facet_conditions[f];
        const auto            axes     = axes_of_facet(tetrahedra, f);
        const auto            first    = nodes_in_cell(tetrahedra, order, f, 0);
        const bool            is_inner = facet.cells[1] != Tetrahedra::none;
        std::vector<unsigned int> second;
        if (is_inner)
          second = nodes_in_cell(tetrahedra, order, f, 1);
        const unsigned int material =
          tetrahedra.material[cell_of_jump(bound, f)];
        const SpatialStrength &one = bound.strengths[material];
        const auto           k   = strength_of_jumps(bound, order, f);
        const unsigned int   body =
          held.kind == FacetCondition::Kind::free
              ? 0
              : first_body +
                dim *
                  bodies.at(
                    {{held.velocity[0], held.velocity[1], held.velocity[2]}});
        for (unsigned int i = 0; i < n_facet; ++i)
          {
            const unsigned int a = dof_of(facet.cells[0], first[i]),
                               b = is_inner ? dof_of(facet.cells[1], second[i])
                                            : body;
            std::array<unsigned int, 6> dofs;
            for (unsigned int d = 0; d < dim; ++d)
              {
                dofs[d]       = a + d;
                dofs[dim + d] = b + d;
              }
            if (is_inner || held.kind == FacetCondition::Kind::fixed)
              {
                if (one.is_cut())
                  {
                    CutFaces::Strains B; // of a thin layer
                    for (unsigned int d = 0; d < dim; ++d)
                      {
                        B.col(dim + d) = symmetric_product(d, axes[0]);
                        B.col(d)       = -B.col(dim + d);
                      }
                    cut_jumps->add(
                      B, dofs, A / n_facet, number[material], one.k);
                    continue;
                  }
                Faces::Strains B;
                for (unsigned int row = 0; row < 3; ++row)
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      B(row, d)       = -axes[row][d];
                      B(row, dim + d) = axes[row][d];
                    }
                jumps->add(B, dofs, A / n_facet, number[material], k[i]);
              }
            else if (held.kind == FacetCondition::Kind::plane)
              {
                const double mu = one.face_friction();
                if (mu > 0. || one.is_cut())
                  {
                    Planes::Strains B;
                    for (unsigned int d = 0; d < dim; ++d)
                      {
                        B(0, d)       = -axes[0][d];
                        B(0, dim + d) = axes[0][d];
                      }
                    planes->add(B,
                                dofs,
                                A / n_facet,
                                0,
                                one.is_cut() ? one.tension : k[i] / mu);
                  }
                else
                  {
                    problem.is_prescribed[a + held.axis] = true;
                    problem.prescribed[a + held.axis] =
                      held.velocity[held.axis];
                  }
              }
          }
        if (!is_inner)
          for (const bool is_live : {false, true})
            {
              const auto forces =
                forces_of_traction(order, part_of(bound.tractions(f), is_live));
              for (unsigned int i = 0; i < n_facet; ++i)
                for (unsigned int d = 0; d < dim; ++d)
                  (is_live
                     ? problem.live
                     : problem.dead)[dof_of(facet.cells[0], first[i]) + d] +=
                    A * forces[i][d];
            }
      }
    points.move_to(problem);
    if (jumps->n_points() > 0)
      problem.groups.push_back(std::move(jumps));
    if (cut_jumps->n_points() > 0)
      problem.groups.push_back(std::move(cut_jumps));
    if (planes->n_points() > 0)
      problem.groups.push_back(std::move(planes));
    return problem;
  }

  ConicProblem
  lower_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const double       L          = bound.units.length;
    const unsigned int n_cells    = tetrahedra.cells.size(),
                       n_u        = order == 1 ? 1 : 4,
                       n_facet    = simplex_nodes::n_on_facet(order);
    const unsigned int first_w    = dim * n_u * n_cells;
    ConicProblem       problem =
      ConicProblem::of_dofs(first_w + dim * n_facet * tetrahedra.facets.size());
    const auto u_of = [&](const unsigned int cell, const unsigned int i) {
      return dim * (n_u * cell + (order == 1 ? 0 : i));
    };
    // The node of a facet between two vertices of a cell, or at one of them.
    const auto w_of = [&](const unsigned int facet,
                          const unsigned int a,
                          const unsigned int b) {
      const auto &v    = tetrahedra.facets[facet].vertices;
      const auto  find = [&](const unsigned int vertex) {
        return static_cast<unsigned int>(std::find(v.begin(), v.end(), vertex) -
                                         v.begin());
      };
      unsigned int i = find(a), j = find(b);
      unsigned int node = i;
      if (i != j)
        {
          if (i > j)
            std::swap(i, j);
          node = 3;
          while (simplex_nodes::edges_of_facet[node - 3][0] != i ||
                 simplex_nodes::edges_of_facet[node - 3][1] != j)
            ++node;
        }
      return first_w + dim * (n_facet * facet + node);
    };

    Points points = empty_points(bound);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto   g       = tetrahedra.gradients(c);
        const auto  &cell    = tetrahedra.cells[c];
        const double V       = tetrahedra.volume(c) / (L * L * L);
        const auto   k       = bound.strength_at_vertices(c);
        const auto add_point = [&](const unsigned int i, const unsigned int j) {
          Points::Strains              B;
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
          add(u_of(c, i), order == 1 ? -4. : -20., g[j]);
          if (i != j)
            add(u_of(c, j), -20., g[i]);
          // A_f n_f = -3 V grad lambda_f.
          for (unsigned int f = 0; f < 4; ++f)
            if (f != i && f != j)
              add(w_of(tetrahedra.facets_of_cell[c][f], cell[i], cell[j]),
                  order == 1 ? -4. : -5.,
                  g[f]);
          points.add(tetrahedra.material[c],
                     B,
                     dofs,
                     V / simplex_nodes::n_in_cell(order),
                     (k[i] + k[j]) / 2.);
        };
        for (unsigned int i = 0; i < 4; ++i)
          add_point(i, i);
        if (order == 2)
          for (const auto &[i, j] : simplex_nodes::edges)
            add_point(i, j);
        for (unsigned int i = 0; i < n_u; ++i)
          add_load(problem, u_of(c, i), V * bound.body_force(c));
      }

    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const double          A    = tetrahedra.area(f) / (L * L);
        const FacetCondition &held = bound.facet_conditions[f];
        for (unsigned int i = 0; i < n_facet; ++i)
          {
            const unsigned int dof = first_w + dim * (n_facet * f + i);
            for (unsigned int d = 0; d < dim; ++d)
              if (held.holds(d))
                {
                  problem.is_prescribed[dof + d] = true;
                  problem.prescribed[dof + d]    = held.velocity[d];
                }
            const auto t = bound.tractions(f);
            if (i < 3)
              add_load(problem, dof, A / n_facet * t[i]);
            else
              for (const unsigned int end :
                   simplex_nodes::edges_of_facet[i - 3])
                add_load(problem, dof, A / n_facet / 2. * t[end]);
          }
      }
    points.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
