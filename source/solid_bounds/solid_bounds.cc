// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solid_bounds/solid_points.h>

#include <algorithm>

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
    const unsigned int     cell = cell_of_jump(bound, facet);
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

  std::vector<std::optional<InterfaceStrength::Soil>>
  strength_of_cracks(const SolidScene  &bound,
                     const unsigned int order,
                     const unsigned int facet)
  {
    const SpatialStrength &one =
      bound.strengths[bound.tetrahedra->material[cell_of_jump(bound, facet)]];
    std::vector<std::optional<InterfaceStrength::Soil>> all;
    for (const double c : strength_of_jumps(bound, order, facet))
      {
        all.emplace_back();
        if (!one.is_cut())
          all.back() = {c, one.face_friction()};
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

  std::vector<bool>
  stress_free_nodes(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const unsigned int n          = simplex_nodes::n_in_cell(order);
    std::vector<bool>  is_free(n * tetrahedra.cells.size(), false);
    std::vector<std::array<unsigned int, 2>> last; // cell, node
    const auto visit = [&](const unsigned int c, const unsigned int node) {
      if (is_free[n * c + node] ||
          strength_at_nodes(bound, order, c)[node] > 0.)
        return;
      is_free[n * c + node] = true;
      last.push_back({{c, node}});
    };
    const auto facets_of = [&](const unsigned int c, const auto &function) {
      for (const unsigned int f : tetrahedra.facets_of_cell[c])
        function(f, tetrahedra.facets[f].cells[0] == c ? 0u : 1u);
    };
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const auto nodes = nodes_in_cell(tetrahedra, order, f, 0);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            std::array<unsigned int, 2> ends = {{i, i}};
            if (i >= 3)
              ends = {{simplex_nodes::edges_of_facet[i - 3][0],
                       simplex_nodes::edges_of_facet[i - 3][1]}};
            if (bound.is_without_traction(f, ends[0]) &&
                bound.is_without_traction(f, ends[1]))
              visit(tetrahedra.facets[f].cells[0], nodes[i]);
          }
      }
    // Across a facet with a node whose traction vanishes.
    while (!last.empty())
      {
        const auto [c, node] = last.back();
        last.pop_back();
        facets_of(c,
                  [&, c = c, node = node](const unsigned int f,
                                          const unsigned int side) {
                    const unsigned int other =
                      tetrahedra.facets[f].cells[1 - side];
                    if (other == Tetrahedra::none)
                      return;
                    const auto here = nodes_in_cell(tetrahedra, order, f, side),
                               there =
                                 nodes_in_cell(tetrahedra, order, f, 1 - side);
                    for (unsigned int i = 0; i < here.size(); ++i)
                      if (here[i] == node)
                        visit(other, there[i]);
                  });
      }
    return is_free;
  }

  std::vector<double>
  strength_at_nodes(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int cell)
  {
    const auto          at_vertices = bound.strength_at_vertices(cell);
    std::vector<double> k(at_vertices.begin(), at_vertices.end());
    if (order == 2)
      for (const auto &[i, j] : simplex_nodes::edges)
        k.push_back((k[i] + k[j]) / 2.);
    return k;
  }

  CutMohrCoulombCones
  cut_law(const SpatialStrength &one)
  {
    return cut_mohr_coulomb_cones(one.a, one.tension / one.k);
  }

  SolidPoints
  empty_points(const SolidScene &bound)
  {
    return SolidPoints(
      bound.strengths,
      [](const auto &one) {
        MohrCoulombCones law = mohr_coulomb_cones(one.a);
        if (one.k == 0.)
          law.start[6] = law.start[0]; // inside the cones without cohesion, too
        return law;
      },
      [](const auto &one) { return circular_cone(one.a); },
      cut_law);
  }

  double
  least_start(const SolidScene &bound)
  {
    // Friction on obstacles has no strength of its own.
    return bound.units.is_of_loads || !bound.interfaces.empty() ? 0.1 : 0.;
  }

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
} // namespace geocone::GEOCONE_DIM
