// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_points.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using bernstein::Exponents;
  using bernstein::Linear;
  using bernstein::lowered;
  using bernstein::raised;
  using dealii::Tensor;

  namespace
  {
    /** Rate sym(e_d x g) of a component d, without a hoop rate. */
    Eigen::Vector4d
    symmetric_rate(const unsigned int d, const Tensor<1, dim> &g)
    {
      return d == 0 ? Eigen::Vector4d(g[0], 0., g[1] * M_SQRT1_2, 0.)
                    : Eigen::Vector4d(0., g[1], g[0] * M_SQRT1_2, 0.);
    }

    /** Dofs of the lower bound's equations: of equilibrium along r and z in cells, and of
     *  tractions on edges. */
    struct EquilibriumDofs
    {
      static constexpr unsigned int order = axisymmetric_stress::order,
                                    n_r   = axisymmetric_stress::n,
                                    n_z   = bernstein::n_in_triangle(order - 1),
                                    n_edge = order + 1;

      explicit EquilibriumDofs(const AxisymmetricScene &scene)
        : first_w((n_r + n_z) * scene.cells.size())
        , n(first_w + dim * n_edge * scene.edges.size())
      {}

      static unsigned int
      of_r(const unsigned int cell)
      {
        return (n_r + n_z) * cell;
      }
      static unsigned int
      of_z(const unsigned int cell)
      {
        return of_r(cell) + n_r;
      }
      unsigned int
      of_edge(const unsigned int edge, const unsigned int k) const
      {
        return first_w + dim * (n_edge * edge + k);
      }

      const unsigned int first_w, n;
    };

    constexpr unsigned int columns_of_stress = 9;
    using StressColumns                      = Columns<4, columns_of_stress>;

    /** Equations of a coefficient of the stress times the radius. */
    StressColumns
    equations_of(const AxisymmetricScene &scene,
                 const unsigned int       c,
                 const Exponents<3>      &a,
                 const EquilibriumDofs   &equations)
    {
      constexpr unsigned int order     = EquilibriumDofs::order;
      const auto            &cell      = scene.cells[c];
      const Triangles       &triangles = scene.bound.triangles;
      const unsigned int     first_r   = equations.of_r(c),
                         first_z       = equations.of_z(c);
      const double V                   = cell.area / EquilibriumDofs::n_r,
                   V_z                 = cell.area / EquilibriumDofs::n_z;
      StressColumns rate;
      rate.add(first_r + bernstein::position(a), {0., 0., 0., 1.});
      for (unsigned int j = 0; j < 3; ++j)
        if (a[j] > 0)
          {
            const Exponents<3> less = lowered(a, j);
            // Equation b has the coefficient a = b - i + j in r div S.
            for (unsigned int i = 0; i < 3; ++i)
              {
                const Exponents<3> b = raised(less, i);
                if (b[i] * cell.radius[i] != 0.)
                  rate.add(first_r + bernstein::position(b),
                           -double(b[i]) * cell.radius[i] *
                             symmetric_rate(0, cell.gradients[j]));
              }
            rate.add(first_z + bernstein::position(less),
                     -V_z / V * order * symmetric_rate(1, cell.gradients[j]));
          }
      for (unsigned int f = 0; f < 3; ++f)
        if (a[f] == 0) // a function of the edge
          {
            const unsigned int   e    = triangles.edges_of_cell[c][f];
            const auto          &edge = scene.edges[e];
            const unsigned int   at   = a[ends_in_cell(triangles, e, c)[1]];
            const Tensor<1, dim> n =
              (c == edge.cells[0] ? 1. : -1.) * edge.normal;
            for (unsigned int d = 0; d < dim; ++d)
              rate.add(equations.of_edge(e, at) + d,
                       edge.length / EquilibriumDofs::n_edge / V *
                         symmetric_rate(d, n));
          }
      rate.finish();
      return rate;
    }

    /** Returns true if the stress times r is zero: a coefficient on the axis. */
    bool
    is_on_axis(const AxisymmetricScene::Cell &cell, const Exponents<3> &a)
    {
      return bernstein::coefficient(a, cell.radius, cell.strength) == 0.;
    }

    /** Adds the stress of a cell. */
    template <typename Points>
    void
    add_cell(const AxisymmetricScene &scene,
             const unsigned int       c,
             const EquilibriumDofs   &equations,
             Points                  &points,
             ConicProblem            &problem)
    {
      const auto        &cell     = scene.cells[c];
      const unsigned int material = scene.bound.triangles.material[c];
      const double       V        = cell.area / EquilibriumDofs::n_r;
      for (const auto &a :
           bernstein::functions_of_triangle(EquilibriumDofs::order))
        if (is_on_axis(cell, a))
          {
            const unsigned int equation =
              equations.of_r(c) + bernstein::position(a);
            problem.is_prescribed[equation] = true;
            StressColumns none;
            none.add(equation, Eigen::Vector4d::Zero());
            none.finish();
            points.add(material, none.B, none.dofs, V, 1.);
          }
        else
          {
            const auto rate = equations_of(scene, c, a, equations);
            points.add(material,
                       rate.B,
                       rate.dofs,
                       V,
                       bernstein::coefficient(a, cell.radius, cell.strength));
          }
    }

    /** Adds the given tractions and the held components of an edge. */
    void
    add_edge(const AxisymmetricScene &scene,
             const unsigned int       e,
             const EquilibriumDofs   &equations,
             ConicProblem            &problem)
    {
      constexpr unsigned int order  = EquilibriumDofs::order;
      const auto            &edge   = scene.edges[e];
      const double           m      = edge.length / EquilibriumDofs::n_edge;
      const Forces           forces = {problem};
      for (unsigned int k = 0; k <= order; ++k)
        {
          const AxisymmetricScene::Load t = traction_coefficient(edge, k);
          const bool is_on_axis           = (k == 0 && edge.radius[0] == 0.) ||
                                  (k == order && edge.radius[1] == 0.) ||
                                  edge.is_on_axis();
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int dof = equations.of_edge(e, k) + d;
              forces.add(dof, m * t.dead[d], m * t.live[d]);
              if (edge.condition.holds(d) || is_on_axis)
                {
                  problem.is_prescribed[dof] = true;
                  problem.prescribed[dof]    = edge.condition.velocity[d];
                }
            }
        }
    }
  } // namespace

  AxisymmetricScene::Load
  traction_coefficient(const AxisymmetricScene::Edge &edge,
                       const unsigned int             k)
  {
    const Exponents<2>      own = {{axisymmetric_stress::order - k, k}};
    AxisymmetricScene::Load t;
    for (unsigned int i = 0; i < 2; ++i)
      {
        Linear<2> at      = {{0., 0.}};
        at[i]             = 1.;
        const double part = bernstein::coefficient(own, edge.radius, at);
        t.dead += part * edge.traction[i].dead;
        t.live += part * edge.traction[i].live;
      }
    return t;
  }

  ConicProblem
  lower_forces(const AxisymmetricScene &scene)
  {
    const EquilibriumDofs equations(scene);
    ConicProblem          problem = ConicProblem::of_dofs(equations.n);
    const Forces          forces  = {problem};
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      {
        const auto  &cell = scene.cells[c];
        const double V    = cell.area / EquilibriumDofs::n_r,
                     V_z  = cell.area / EquilibriumDofs::n_z;
        for (const auto &a :
             bernstein::functions_of_triangle(EquilibriumDofs::order))
          {
            const double part =
              V * bernstein::coefficient(a, cell.radius, cell.radius);
            forces.add(equations.of_r(c) + bernstein::position(a),
                       part * cell.body_force.dead[0],
                       part * cell.body_force.live[0]);
          }
        for (unsigned int i = 0; i < EquilibriumDofs::n_z; ++i)
          forces.add(equations.of_z(c) + i,
                     V_z * cell.radius[i] * cell.body_force.dead[1],
                     V_z * cell.radius[i] * cell.body_force.live[1]);
      }
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      add_edge(scene, e, equations, problem);
    return problem;
  }

  ConicProblem
  lower_problem(const AxisymmetricScene &scene)
  {
    const EquilibriumDofs equations(scene);
    ConicProblem          problem = lower_forces(scene);
    auto                  points =
      empty_axisymmetric_points<columns_of_stress>(scene.bound.strengths);
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      add_cell(scene, c, equations, points, problem);
    points.move_to(problem);
    return problem;
  }

  std::vector<StrengthPower>
  powers_of_lower(const AxisymmetricScene &scene,
                  const ConicProblem      &solved,
                  const Eigen::VectorXd   &q)
  {
    const BoundScene          &bound = scene.bound;
    const EquilibriumDofs      equations(scene);
    std::vector<StrengthPower> powers(bound.strengths.size());
    const auto                 functions =
      bernstein::functions_of_triangle(EquilibriumDofs::order);
    const auto stresses = stresses_of_cells<Eigen::Vector4d>(
      solved, bound.strengths, bound.triangles.material, functions.size());
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      {
        const auto        &cell = scene.cells[c];
        const unsigned int m    = bound.triangles.material[c];
        const double       V    = cell.area / EquilibriumDofs::n_r;
        for (unsigned int i = 0; i < functions.size(); ++i)
          {
            const Exponents<3> &a = functions[i];
            if (is_on_axis(cell, a))
              continue;
            const auto  rate   = equations_of(scene, c, a, equations);
            const auto &stress = stresses[functions.size() * c + i];
            double      work   = 0.;
            for (unsigned int j = 0; j < rate.n_used(); ++j)
              work += V * stress.dot(rate.B.col(j)) * q[rate.dofs[j]];
            const double    k0  = bound.strengths[m].k;
            const Linear<3> all = {{k0, k0, k0}};
            const double    k =
              bernstein::coefficient(a, cell.radius, cell.strength);
            add_power_of_point(bound.strengths[m],
                               work,
                               k,
                               bernstein::coefficient(a, cell.radius, all) / k,
                               stress,
                               powers[m]);
          }
      }
    return powers;
  }
} // namespace geocone::GEOCONE_DIM
