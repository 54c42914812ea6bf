// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/bounds/held_bodies.h>
#include <geocone/solid_bounds/jump_points.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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

      bool
      is_of_facet(const unsigned int dof) const
      {
        return dof >= first_w;
      }

      /** Facet of an equation of tractions. */
      unsigned int
      facet_of(const unsigned int dof) const
      {
        return (dof - first_w) / (dim * n_facet);
      }

      /** Axis of an equation of tractions. */
      unsigned int
      axis_of(const unsigned int dof) const
      {
        return (dof - first_w) % dim;
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

    /** Returns true if the equations of tractions on a facet refer to its normal and two
     *  tangents instead of x, y and z: on oblique planes and obstacles. */
    bool
    refers_to_normal(const FacetCondition &held)
    {
      return held.is_oblique() || held.kind == FacetCondition::Kind::interface;
    }

    /** Axes to which the equations of tractions on a facet refer. */
    JumpPoints::Axes
    axes_of_equations(const SolidScene &bound, const unsigned int facet)
    {
      return refers_to_normal(bound.facet_conditions[facet])
               ? axes_of_facet(*bound.tetrahedra, facet)
               : global_axes();
    }

    /** Equations of the stress of a cell at the coefficient between two of its
     *  vertices. */
    struct EquationsOfStress
    {
      SolidPoints::Strains         B;
      std::array<unsigned int, 12> dofs;
      double                       volume; ///< weight of the coefficient
    };

    EquationsOfStress
    equations_of_stress(const SolidScene      &bound,
                        const unsigned int     order,
                        const unsigned int     c,
                        const unsigned int     i,
                        const unsigned int     j,
                        const EquilibriumDofs &equations)
    {
      const Tetrahedra &tetrahedra = *bound.tetrahedra;
      const double      L          = bound.units.length;
      const auto        g          = tetrahedra.gradients(c);
      const auto       &cell       = tetrahedra.cells[c];
      EquationsOfStress own;
      unsigned int      n   = 0;
      const auto        add = [&](const unsigned int    dof,
                           const double          factor,
                           const Tensor<1, dim> &gradient) {
        for (unsigned int d = 0; d < dim; ++d, ++n)
          {
            own.B.col(n) = factor * L * symmetric_product(d, gradient);
            own.dofs[n]  = dof + d;
          }
      };
      const auto turn = [&](const unsigned int facet) {
        if (!refers_to_normal(bound.facet_conditions[facet]))
          return;
        const auto      axes = axes_of_equations(bound, facet);
        Eigen::Matrix3d columns;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            columns(d, i) = axes[i][d];
        own.B.middleCols<dim>(n - dim) =
          (own.B.middleCols<dim>(n - dim) * columns).eval();
      };
      add(equations.of_cell(c, i), order == 1 ? -4. : -20., g[j]);
      if (i != j)
        add(equations.of_cell(c, j), -20., g[i]);
      // A_f n_f = -3 V grad lambda_f.
      for (unsigned int f = 0; f < 4; ++f)
        if (f != i && f != j)
          {
            const unsigned int facet = tetrahedra.facets_of_cell[c][f];
            add(equations.between(facet, cell[i], cell[j]),
                order == 1 ? -4. : -5.,
                g[f]);
            turn(facet);
          }
      own.volume =
        tetrahedra.volume(c) / (L * L * L) / simplex_nodes::n_in_cell(order);
      return own;
    }

    /** Pairs of vertices (i, i) or (i, j) to which the coefficients of a cell belong. */
    std::vector<std::array<unsigned int, 2>>
    vertices_of_nodes(const unsigned int order)
    {
      std::vector<std::array<unsigned int, 2>> pairs;
      for (unsigned int i = 0; i < 4; ++i)
        pairs.push_back({{i, i}});
      if (order == 2)
        for (const auto &[i, j] : simplex_nodes::edges)
          pairs.push_back({{i, j}});
      return pairs;
    }

    /** Removes the equations of facets and cells all of whose stresses vanish. */
    void
    remove_without_stress(const SolidScene        &bound,
                          const unsigned int       order,
                          const std::vector<bool> &vanishes,
                          const EquilibriumDofs   &equations,
                          ConicProblem            &problem)
    {
      const Tetrahedra  &tetrahedra = *bound.tetrahedra;
      const unsigned int n          = simplex_nodes::n_in_cell(order);
      const auto         remove     = [&](const unsigned int dof) {
        for (unsigned int d = 0; d < dim; ++d)
          {
            problem.is_prescribed[dof + d] = true;
            problem.prescribed[dof + d]    = 0.;
          }
      };
      for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
        for (unsigned int i = 0; i < equations.n_u; ++i)
          {
            bool has_stress = false;
            for (unsigned int j = 0; j < 4; ++j)
              has_stress =
                has_stress ||
                !vanishes[n * c + (order == 1 ? j : simplex_nodes::node(i, j))];
            if (!has_stress)
              remove(equations.of_cell(c, i));
          }
      for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
        {
          const auto &cells  = tetrahedra.facets[f].cells;
          const auto  first  = nodes_in_cell(tetrahedra, order, f, 0);
          const auto  second = cells[1] == Tetrahedra::none
                                 ? std::vector<unsigned int>()
                                 : nodes_in_cell(tetrahedra, order, f, 1);
          for (unsigned int i = 0; i < equations.n_facet; ++i)
            if (vanishes[n * cells[0] + first[i]] &&
                (second.empty() || vanishes[n * cells[1] + second[i]]))
              remove(equations.of_facet(f, i));
        }
    }

    /** Returns the rows of a symmetric semidefinite matrix with a unit diagonal that
     *  depend on others, by a factorisation with the largest pivots first. */
    std::vector<unsigned int>
    dependent_rows(Eigen::MatrixXd G)
    {
      constexpr double          least = 1e-10; // of sin^2 of an angle
      std::vector<unsigned int> left(G.rows());
      std::iota(left.begin(), left.end(), 0);
      while (!left.empty())
        {
          const auto pivot =
            std::max_element(left.begin(), left.end(), [&](auto i, auto j) {
              return G(i, i) < G(j, j);
            });
          if (!(G(*pivot, *pivot) > least))
            break;
          const Eigen::VectorXd column =
            G.col(*pivot) / std::sqrt(G(*pivot, *pivot));
          G.noalias() -= column * column.transpose();
          left.erase(pivot);
        }
      return left;
    }

    /** Returns whether an obstacle carries tractions on a facet along an axis of the
     *  equations. */
    bool
    carries(const SolidScene  &bound,
            const unsigned int facet,
            const unsigned int axis)
    {
      const FacetCondition &held = bound.facet_conditions[facet];
      return held.kind == FacetCondition::Kind::interface &&
             (axis == 0 || !bound.interfaces[held.obstacle].is_smooth());
    }

    /**
     * Removes equations of tractions that follow from others at the same node of the mesh.
     * Where two facets of a cell meet, n_2 . s n_1 = n_1 . s n_2, so the equations of a
     * cell with two free facets depend on each other, and those of one with two
     * perpendicular smooth planes; likewise around edges on a plane.
     */
    void
    remove_dependent(const SolidScene        &bound,
                     const unsigned int       order,
                     const std::vector<bool> &vanishes,
                     const EquilibriumDofs   &equations,
                     ConicProblem            &problem)
    {
      const Tetrahedra &tetrahedra = *bound.tetrahedra;
      const auto        nodes      = vertices_of_nodes(order);
      // Cells and pairs of their vertices at each node of the mesh.
      std::map<std::array<unsigned int, 2>,
               std::vector<std::array<unsigned int, 3>>>
        around;
      for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
        for (unsigned int p = 0; p < nodes.size(); ++p)
          if (const auto [i, j] = nodes[p]; !vanishes[nodes.size() * c + p])
            {
              const auto &cell  = tetrahedra.cells[c];
              const auto [a, b] = std::minmax(cell[i], cell[j]);
              around[{{a, b}}].push_back({{c, i, j}});
            }
      for (const auto &[node, all] : around)
        {
          std::vector<EquationsOfStress>       stresses;
          std::map<unsigned int, unsigned int> number; // of the free dofs
          for (const auto &[c, i, j] : all)
            {
              stresses.push_back(
                equations_of_stress(bound, order, c, i, j, equations));
              for (const unsigned int dof : stresses.back().dofs)
                if (equations.is_of_facet(dof) && !problem.is_prescribed[dof])
                  number.emplace(dof, 0);
            }
          std::vector<unsigned int> dofs;
          for (auto &[dof, own] : number)
            {
              own = dofs.size();
              dofs.push_back(dof);
            }
          Eigen::MatrixXd G = Eigen::MatrixXd::Zero(dofs.size(), dofs.size());
          for (const EquationsOfStress &own : stresses)
            for (unsigned int k = 0; k < own.dofs.size(); ++k)
              for (unsigned int l = 0; l < own.dofs.size(); ++l)
                if (const auto row = number.find(own.dofs[k]),
                    column         = number.find(own.dofs[l]);
                    row != number.end() && column != number.end())
                  G(row->second, column->second) +=
                    own.B.col(k).dot(own.B.col(l));
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (carries(bound,
                        equations.facet_of(dofs[i]),
                        equations.axis_of(dofs[i])))
              G(i, i) *= 2.; // the traction on the obstacle
          const Eigen::VectorXd size = G.diagonal().cwiseSqrt().cwiseInverse();
          for (const unsigned int row :
               dependent_rows(size.asDiagonal() * G * size.asDiagonal()))
            problem.is_prescribed[dofs[row]] = true;
        }
    }

    /** Adds the tractions between the body and an obstacle. */
    void
    add_interface(const SolidScene        &bound,
                  const unsigned int       order,
                  const unsigned int       f,
                  const std::vector<bool> &vanishes,
                  const EquilibriumDofs   &equations,
                  const HeldBodies        &bodies,
                  JumpPoints              &jumps)
    {
      const Tetrahedra     &tetrahedra = *bound.tetrahedra;
      const FacetCondition &held       = bound.facet_conditions[f];
      const auto            axes       = axes_of_facet(tetrahedra, f);
      const auto            nodes      = nodes_in_cell(tetrahedra, order, f, 0);
      const double          L          = bound.units.length,
                   weight = tetrahedra.area(f) / (L * L) / equations.n_facet;
      const unsigned int first =
        simplex_nodes::n_in_cell(order) * tetrahedra.facets[f].cells[0];
      for (unsigned int i = 0; i < equations.n_facet; ++i)
        if (!vanishes[first + nodes[i]])
          jumps.add_at_obstacle(
            held.obstacle,
            axes,
            dofs_of_both(equations.of_facet(f, i), bodies.dof_of(held)),
            weight,
            axes_of_equations(bound, f));
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
      const auto            axes = axes_of_equations(bound, f);
      auto                  t    = bound.tractions(f);
      if (held.is_oblique())
        for (SolidScene::Load &at_vertex : t)
          for (Tensor<1, dim> *part : {&at_vertex.dead, &at_vertex.live})
            *part = Tensor<1, dim>(
              {*part * axes[0], *part * axes[1], *part * axes[2]});
      for (unsigned int i = 0; i < equations.n_facet; ++i)
        {
          const unsigned int dof = equations.of_facet(f, i);
          for (unsigned int d = 0; d < dim; ++d)
            if (held.is_oblique() ? d == 0 : held.holds(d))
              {
                problem.is_prescribed[dof + d] = true;
                problem.prescribed[dof + d]    = held.velocity * axes[d];
              }
          if (i < 3)
            add_load(problem, dof, A / equations.n_facet * t[i]);
          else
            for (const unsigned int end : simplex_nodes::edges_of_facet[i - 3])
              add_load(problem, dof, A / equations.n_facet / 2. * t[end]);
        }
    }
  } // namespace

  namespace
  {
    /** Strain rates B q of all stresses of cells, in the order of the cells. */
    std::vector<Mandel>
    rates_of_stresses(const SolidScene      &bound,
                      const unsigned int     order,
                      const Eigen::VectorXd &q)
    {
      const EquilibriumDofs equations(*bound.tetrahedra, order);
      std::vector<Mandel>   rates;
      for (unsigned int c = 0; c < bound.tetrahedra->cells.size(); ++c)
        for (const auto &[i, j] : vertices_of_nodes(order))
          {
            const EquationsOfStress own =
              equations_of_stress(bound, order, c, i, j, equations);
            Mandel rate = Mandel::Zero();
            for (unsigned int k = 0; k < own.dofs.size(); ++k)
              rate += q[own.dofs[k]] * own.B.col(k);
            rates.push_back(rate);
          }
      return rates;
    }
  } // namespace

  std::vector<double>
  dual_power_of_cells(const SolidScene          &bound,
                      const unsigned int         order,
                      const std::vector<Mandel> &stress,
                      const Eigen::VectorXd     &q)
  {
    const Tetrahedra         &tetrahedra = *bound.tetrahedra;
    const double              L          = bound.units.length;
    const std::vector<Mandel> rate       = rates_of_stresses(bound, order, q);
    const unsigned int        n          = simplex_nodes::n_in_cell(order);
    std::vector<double>       power(tetrahedra.cells.size(), 0.);
    for (unsigned int c = 0; c < power.size(); ++c)
      for (unsigned int p = n * c; p < n * (c + 1); ++p)
        power[c] +=
          tetrahedra.volume(c) / (L * L * L) / n * stress[p].dot(rate[p]);
    return power;
  }

  std::vector<Mandel>
  in_equilibrium(const SolidScene          &bound,
                 const unsigned int         order,
                 const ConicProblem        &problem,
                 const double               lambda,
                 const std::vector<Mandel> &stress)
  {
    std::vector<BlockMatrix::Set> sets;
    for (const auto &group : problem.groups)
      sets.push_back(group->set());
    BlockMatrix matrix(problem.is_prescribed, sets);
    matrix.clear();
    Eigen::VectorXd left = -lambda * problem.live - problem.dead;
    for (unsigned int i = 0; i < problem.groups.size(); ++i)
      {
        problem.groups[i]->add_elastic_blocks(matrix, i, 0.);
        problem.groups[i]->add_forces(left);
      }
    if (!matrix.factorise())
      return stress;
    Eigen::VectorXd q = Eigen::VectorXd::Zero(problem.n_dofs());
    for (unsigned int k = 0; k < 4; ++k)
      {
        Eigen::VectorXd F = left;
        for (const auto &group : problem.groups)
          group->add_elastic_forces(q, 0., F);
        q -= matrix.solve(F);
      }
    std::vector<Mandel>       all      = stress;
    const std::vector<Mandel> rate     = rates_of_stresses(bound, order, q);
    const std::vector<bool>   vanishes = stress_free_nodes(bound, order);
    for (unsigned int p = 0; p < all.size(); ++p)
      if (!vanishes[p])
        all[p] += rate[p];
    return all;
  }

  ConicProblem
  lower_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra     &tetrahedra = *bound.tetrahedra;
    const double          L          = bound.units.length;
    const EquilibriumDofs equations(tetrahedra, order);
    HeldBodies            bodies(equations.n()); // obstacles
    for (const FacetCondition &held : bound.facet_conditions)
      if (held.kind == FacetCondition::Kind::interface)
        bodies.add(held);
    ConicProblem problem = ConicProblem::of_dofs(bodies.n_dofs());
    problem.least_start  = least_start(bound);
    bodies.prescribe(problem);
    SolidPoints             points   = empty_points(bound);
    JumpPoints              jumps(bound);
    const std::vector<bool> vanishes = stress_free_nodes(bound, order);
    const auto              nodes    = vertices_of_nodes(order);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      {
        const auto k = strength_at_nodes(bound, order, c);
        for (unsigned int p = 0; p < nodes.size(); ++p)
          if (!vanishes[nodes.size() * c + p])
            {
              const EquationsOfStress own = equations_of_stress(
                bound, order, c, nodes[p][0], nodes[p][1], equations);
              points.add(
                tetrahedra.material[c], own.B, own.dofs, own.volume, k[p]);
            }
        for (unsigned int i = 0; i < equations.n_u; ++i)
          add_load(problem,
                   equations.of_cell(c, i),
                   tetrahedra.volume(c) / (L * L * L) * bound.body_force(c));
      }
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        add_facet(bound, f, equations, problem);
        if (bound.facet_conditions[f].kind == FacetCondition::Kind::interface)
          add_interface(bound, order, f, vanishes, equations, bodies, jumps);
      }
    remove_without_stress(bound, order, vanishes, equations, problem);
    remove_dependent(bound, order, vanishes, equations, problem);
    points.move_to(problem);
    jumps.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
