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

    /** Dofs of the velocities of cells and of rigid bodies: the distinct velocities of
     *  fixed facets and of planes. */
    class VelocityDofs
    {
    public:
      VelocityDofs(const SolidScene &bound, const unsigned int order)
        : n_nodes(simplex_nodes::n_in_cell(order))
        , first_body(dim * n_nodes * bound.tetrahedra->cells.size())
      {
        for (const FacetCondition &held : bound.facet_conditions)
          if (held.kind != FacetCondition::Kind::free)
            bodies.emplace(key(held), bodies.size());
      }

      unsigned int
      n() const
      {
        return first_body + dim * bodies.size();
      }

      unsigned int
      of_node(const unsigned int cell, const unsigned int node) const
      {
        return dim * (n_nodes * cell + node);
      }

      /** Dofs of the body that holds a facet; of none, if it is free. */
      unsigned int
      of_body(const FacetCondition &held) const
      {
        return held.kind == FacetCondition::Kind::free
                 ? 0
                 : first_body + dim * bodies.at(key(held));
      }

      void
      prescribe(ConicProblem &problem) const
      {
        for (const auto &[velocity, number] : bodies)
          for (unsigned int d = 0; d < dim; ++d)
            {
              problem.is_prescribed[first_body + dim * number + d] = true;
              problem.prescribed[first_body + dim * number + d] = velocity[d];
            }
      }

    private:
      using Key = std::array<double, dim>;

      static Key
      key(const FacetCondition &held)
      {
        return {{held.velocity[0], held.velocity[1], held.velocity[2]}};
      }

      unsigned int                n_nodes, first_body;
      std::map<Key, unsigned int> bodies;
    };

    /** Points of the jumps of velocity at facets. Each has six dofs, those of both
     *  sides. */
    class JumpPoints
    {
    public:
      using Dofs = std::array<unsigned int, 6>;
      using Axes = std::array<Tensor<1, dim>, dim>;

      explicit JumpPoints(const std::vector<SpatialStrength> &strengths)
        : strengths(strengths)
      {
        std::vector<FaceCone>            of_faces;
        std::vector<CutMohrCoulombCones> of_cut_faces;
        for (const SpatialStrength &one : strengths)
          if (one.is_cut())
            {
              number.push_back(of_cut_faces.size());
              of_cut_faces.push_back(cut_law(one));
            }
          else
            {
              number.push_back(of_faces.size());
              of_faces.push_back(face_cone(one.face_friction()));
            }
        faces     = std::make_unique<Faces>(of_faces);
        cut_faces = std::make_unique<CutFaces>(of_cut_faces);
        planes =
          std::make_unique<Planes>(std::vector<OpeningCone>{opening_cone()});
      }

      /** Adds a jump within soil. @param k cohesion of the facet */
      void
      add_in_soil(const unsigned int material,
                  const Axes        &axes,
                  const Dofs        &dofs,
                  const double       weight,
                  const double       k)
      {
        const SpatialStrength &one = strengths[material];
        if (one.is_cut())
          {
            CutFaces::Strains B; // of a thin layer
            for (unsigned int d = 0; d < dim; ++d)
              {
                B.col(dim + d) = symmetric_product(d, axes[0]);
                B.col(d)       = -B.col(dim + d);
              }
            cut_faces->add(B, dofs, weight, number[material], one.k);
            return;
          }
        Faces::Strains B;
        for (unsigned int row = 0; row < dim; ++row)
          for (unsigned int d = 0; d < dim; ++d)
            {
              B(row, d)       = -axes[row][d];
              B(row, dim + d) = axes[row][d];
            }
        faces->add(B, dofs, weight, number[material], k);
      }

      /** Adds an opening at a smooth plane. @param tension tensile strength */
      void
      add_opening(const Tensor<1, dim> &normal,
                  const Dofs           &dofs,
                  const double          weight,
                  const double          tension)
      {
        Planes::Strains B;
        for (unsigned int d = 0; d < dim; ++d)
          {
            B(0, d)       = -normal[d];
            B(0, dim + d) = normal[d];
          }
        planes->add(B, dofs, weight, 0, tension);
      }

      void
      move_to(ConicProblem &problem)
      {
        if (faces->n_points() > 0)
          problem.groups.push_back(std::move(faces));
        if (cut_faces->n_points() > 0)
          problem.groups.push_back(std::move(cut_faces));
        if (planes->n_points() > 0)
          problem.groups.push_back(std::move(planes));
      }

    private:
      const std::vector<SpatialStrength> &strengths;
      std::vector<unsigned int>           number; ///< of the law of a material
      std::unique_ptr<Faces>              faces;
      std::unique_ptr<CutFaces>           cut_faces;
      std::unique_ptr<Planes>             planes;
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
              Points             &points,
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
          Points::Strains              B;
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
                                          : velocities.of_body(held);
          if (is_plane && !is_inner && mu == 0. && !one.is_cut())
            {
              problem.is_prescribed[a + held.axis] = true;
              problem.prescribed[a + held.axis]    = held.velocity[held.axis];
              continue;
            }
          JumpPoints::Dofs dofs;
          for (unsigned int d = 0; d < dim; ++d)
            {
              dofs[d]       = a + d;
              dofs[dim + d] = b + d;
            }
          if (is_plane && !is_inner)
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
    ConicProblem       problem = ConicProblem::of_dofs(velocities.n());
    velocities.prescribe(problem);
    Points points = empty_points(bound);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      add_rates(bound, order, c, velocities, points, problem);
    JumpPoints jumps(bound.strengths);
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
               Points                &points)
    {
      const Tetrahedra            &tetrahedra = *bound.tetrahedra;
      const double                 L          = bound.units.length;
      const auto                   g          = tetrahedra.gradients(c);
      const auto                  &cell       = tetrahedra.cells[c];
      const auto                   k          = bound.strength_at_vertices(c);
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
    Points                points  = empty_points(bound);
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
