// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_points.h>
#include <geocone/bounds/held_bodies.h>

#include <cmath>
#include <memory>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using bernstein::Exponents;
  using bernstein::Linear;
  using bernstein::lowered;
  using bernstein::mean;
  using bernstein::raised;
  using dealii::Tensor;

  namespace
  {
    namespace space = axisymmetric_velocity;

    constexpr unsigned int columns_of_rate = 8, columns_of_jump = 6;
    using EdgePoints    = PointGroupOf<FaceConeOf<2>, columns_of_jump>;
    using OpeningPoints = PointGroupOf<OpeningCone, columns_of_jump>;

    /** Coefficient of the strain rate of a cell, by dofs. */
    Columns<4, columns_of_rate>
    rate_of_cell(const AxisymmetricScene::Cell &cell,
                 const unsigned int             number,
                 const Exponents<3>            &a)
    {
      Columns<4, columns_of_rate> rate;
      rate.add(space::dof_of_v(number, a), {1., 0., 0., 1.});
      for (unsigned int j = 0; j < 3; ++j)
        {
          const Tensor<1, dim> &g = cell.gradients[j];
          for (unsigned int i = 0; i < 3; ++i)
            if (a[i] > 0) // r grad v
              rate.add(space::dof_of_v(number, raised(lowered(a, i), j)),
                       a[i] * cell.radius[i] *
                         Eigen::Vector4d(g[0], 0., g[1] * M_SQRT1_2, 0.));
          rate.add(space::dof_of_w(number, raised(a, j)),
                   (space::order + 1.) *
                     Eigen::Vector4d(0., g[1], g[0] * M_SQRT1_2, 0.));
        }
      rate.finish();
      return rate;
    }

    /** Adds to a jump the coefficient k of the velocity of a cell on an edge.
     *  @param part 1 or -1 @param axes rows of the jump */
    template <int n_rows, typename Axes>
    void
    add_velocity(Columns<n_rows, columns_of_jump> &jump,
                 const AxisymmetricScene          &scene,
                 const unsigned int                edge,
                 const unsigned int                cell,
                 const unsigned int                k,
                 const double                      part,
                 const Axes                       &axes)
    {
      using Vector       = Eigen::Matrix<double, n_rows, 1>;
      constexpr double n = space::order + 1;
      const auto &[a, b] = ends_in_cell(scene.bound.triangles, edge, cell);
      const auto &r      = scene.edges[edge].radius;
      const auto  along  = [&](const unsigned int d) {
        Vector v;
        for (int i = 0; i < n_rows; ++i)
          v[i] = part * axes[i][d];
        return v;
      };
      if (k <= space::order)
        jump.add(
          space::dof_of_v(cell, bernstein::on_edge(space::order, a, b, k)),
          (n - k) / n * r[0] * along(0));
      if (k > 0)
        jump.add(
          space::dof_of_v(cell, bernstein::on_edge(space::order, a, b, k - 1)),
          k / n * r[1] * along(0));
      jump.add(
        space::dof_of_w(cell, bernstein::on_edge(space::order + 1, a, b, k)),
        along(1));
    }

    /** Dofs of the velocities of held sides. */
    HeldBodies
    held_bodies(const AxisymmetricScene &scene)
    {
      HeldBodies bodies((space::n_v + space::n_w) * scene.cells.size());
      for (const auto &edge : scene.edges)
        bodies.add(edge.condition);
      return bodies;
    }

    /** Prescribes the velocity normal to an edge exactly. */
    void
    prescribe_plane(const AxisymmetricScene &scene,
                    const unsigned int       number,
                    ConicProblem            &problem)
    {
      const auto          &edge = scene.edges[number];
      const FacetCondition held = edge.condition;
      const unsigned int   cell = edge.cells[0];
      const auto &[a, b]   = ends_in_cell(scene.bound.triangles, number, cell);
      const auto prescribe = [&](const unsigned int dof, const double value) {
        problem.is_prescribed[dof] = true;
        problem.prescribed[dof]    = value;
      };
      if (held.axis == 1)
        for (unsigned int k = 0; k <= space::order + 1; ++k)
          prescribe(space::dof_of_w(
                      cell, bernstein::on_edge(space::order + 1, a, b, k)),
                    held.velocity[1]);
      else // the radius is constant
        for (unsigned int k = 0; k <= space::order; ++k)
          prescribe(
            space::dof_of_v(cell, bernstein::on_edge(space::order, a, b, k)),
            held.velocity[0] / edge.radius[0]);
    }

    /** Adds the tractions of a boundary edge to the forces of the velocities. */
    void
    add_tractions_of_edge(const AxisymmetricScene &scene,
                          const unsigned int       number,
                          const Forces            &forces)
    {
      const auto        &edge = scene.edges[number];
      const unsigned int cell = edge.cells[0];
      const auto &[a, b] = ends_in_cell(scene.bound.triangles, number, cell);
      std::array<Linear<2>, dim> dead, live;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < 2; ++i)
          {
            dead[d][i] = edge.traction[i].dead[d];
            live[d][i] = edge.traction[i].live[d];
          }
      const Linear<2> &r = edge.radius;
      for (unsigned int k = 0; k <= space::order; ++k)
        {
          const Exponents<2> own = {{space::order - k, k}};
          forces.add(
            space::dof_of_v(cell, bernstein::on_edge(space::order, a, b, k)),
            edge.length * mean(own, r, r, dead[0]),
            edge.length * mean(own, r, r, live[0]));
        }
      for (unsigned int k = 0; k <= space::order + 1; ++k)
        {
          const Exponents<2> own = {{space::order + 1 - k, k}};
          forces.add(space::dof_of_w(
                       cell, bernstein::on_edge(space::order + 1, a, b, k)),
                     edge.length * mean(own, r, dead[1]),
                     edge.length * mean(own, r, live[1]));
        }
    }

    /** Points of an edge. */
    enum class JumpKind
    {
      none,
      prescribed, ///< a plane that soil without friction cannot leave
      opening,    ///< at a smooth plane
      of_soil
    };

    JumpKind
    kind_of_jump(const AxisymmetricScene &scene,
                 const unsigned int       e,
                 const SpatialStrength   &one)
    {
      using Kind       = FacetCondition::Kind;
      const auto &edge = scene.edges[e];
      if (edge.is_on_axis() ||
          (!edge.is_inner() && edge.condition.kind == Kind::free))
        return JumpKind::none;
      if (edge.condition.kind != Kind::plane)
        return JumpKind::of_soil;
      return one.face_friction() == 0. ? JumpKind::prescribed
                                       : JumpKind::opening;
    }

    /** Points of the jumps of velocity at edges. */
    struct JumpPoints
    {
      explicit JumpPoints(const std::vector<SpatialStrength> &strengths)
      {
        std::vector<FaceConeOf<2>> laws;
        for (const SpatialStrength &one : strengths)
          laws.push_back(face_cone<2>(one.face_friction()));
        of_soil   = std::make_unique<EdgePoints>(laws);
        of_planes = std::make_unique<OpeningPoints>(
          std::vector<OpeningCone>{opening_cone()});
      }

      void
      move_to(ConicProblem &problem)
      {
        if (of_soil->n_points() > 0)
          problem.groups.push_back(std::move(of_soil));
        if (of_planes->n_points() > 0)
          problem.groups.push_back(std::move(of_planes));
      }

      std::unique_ptr<EdgePoints>    of_soil;
      std::unique_ptr<OpeningPoints> of_planes; ///< openings at smooth planes
    };

    /** Adds the jumps at an inner or a held edge; prescribes velocities at a plane that
     *  soil without friction cannot leave. */
    void
    add_jumps(const AxisymmetricScene &scene,
              const unsigned int       e,
              const HeldBodies        &bodies,
              JumpPoints              &jumps,
              ConicProblem            &problem)
    {
      const auto            &edge = scene.edges[e];
      Linear<2>              cohesion;
      const SpatialStrength &one  = scene.strength_of_jump(e, cohesion);
      const JumpKind         kind = kind_of_jump(scene, e, one);
      if (kind == JumpKind::none)
        return;
      if (kind == JumpKind::prescribed)
        return prescribe_plane(scene, e, problem);
      const auto complete = [&](auto &jump, const auto &axes, const auto k) {
        add_velocity(jump, scene, e, edge.cells[0], k, -1., axes);
        if (edge.is_inner())
          add_velocity(jump, scene, e, edge.cells[1], k, 1., axes);
        else
          for (unsigned int d = 0; d < dim; ++d)
            {
              typename std::decay_t<decltype(jump)>::Vector v;
              for (unsigned int i = 0; i < axes.size(); ++i)
                v[i] = axes[i][d];
              jump.add(bodies.dof_of(edge.condition) + d, v);
            }
        jump.finish();
      };
      for (unsigned int k = 0; k <= space::order + 1; ++k)
        {
          const Exponents<2> own  = {{space::order + 1 - k, k}};
          const double       part = mean(own, edge.radius),
                       weight     = edge.length * part,
                       c          = mean(own, edge.radius, cohesion) / part;
          if (kind == JumpKind::opening)
            {
              Columns<1, columns_of_jump> opening;
              complete(
                opening, std::array<Tensor<1, dim>, 1>{{edge.normal}}, k);
              jumps.of_planes->add(
                opening.B, opening.dofs, weight, 0, c / one.face_friction());
            }
          else
            {
              Columns<2, columns_of_jump> jump;
              complete(
                jump,
                std::array<Tensor<1, dim>, 2>{{edge.normal, edge.tangent()}},
                k);
              jumps.of_soil->add(jump.B,
                                 jump.dofs,
                                 weight,
                                 &one - scene.bound.strengths.data(),
                                 c);
            }
        }
    }
  } // namespace

  ConicProblem
  upper_forces(const AxisymmetricScene &scene)
  {
    const unsigned int n_cells = scene.cells.size();
    const HeldBodies   bodies  = held_bodies(scene);
    ConicProblem       problem = ConicProblem::of_dofs(bodies.n_dofs());
    const Forces forces  = {problem};
    bodies.prescribe(problem);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto &cell = scene.cells[c];
        for (const auto &a : bernstein::functions_of_triangle(space::order))
          {
            const double part = cell.area * mean(a, cell.radius, cell.radius);
            forces.add(space::dof_of_v(c, a),
                       part * cell.body_force.dead[0],
                       part * cell.body_force.live[0]);
          }
        for (const auto &a : bernstein::functions_of_triangle(space::order + 1))
          {
            const double part = cell.area * mean(a, cell.radius);
            forces.add(space::dof_of_w(c, a),
                       part * cell.body_force.dead[1],
                       part * cell.body_force.live[1]);
          }
      }
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      if (!scene.edges[e].is_on_axis() && !scene.edges[e].is_inner())
        add_tractions_of_edge(scene, e, forces);
    return problem;
  }

  ConicProblem
  upper_problem(const AxisymmetricScene &scene)
  {
    const BoundScene  &bound   = scene.bound;
    const unsigned int n_cells = scene.cells.size();
    const HeldBodies   bodies  = held_bodies(scene);
    ConicProblem       problem = upper_forces(scene);
    auto points = empty_axisymmetric_points<columns_of_rate>(bound.strengths);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto &cell = scene.cells[c];
        for (const auto &a : bernstein::functions_of_triangle(space::order))
          {
            const auto   rate = rate_of_cell(cell, c, a);
            const double part = mean(a, cell.radius);
            points.add(bound.triangles.material[c],
                       rate.B,
                       rate.dofs,
                       cell.area * part,
                       mean(a, cell.radius, cell.strength) / part);
          }
      }
    JumpPoints jumps(bound.strengths);
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      add_jumps(scene, e, bodies, jumps, problem);
    points.move_to(problem);
    jumps.move_to(problem);
    return problem;
  }

  namespace
  {
    /** Adds the powers of the jumps at an edge to that of its material.
     *  @param jump coefficients of the jump
     *  @param normal_stress of the next point of the soil's group */
    template <typename NormalStress>
    void
    add_powers_of_edge(const AxisymmetricScene           &scene,
                       const unsigned int                 e,
                       const std::vector<Tensor<1, dim>> &jump,
                       const NormalStress                &normal_stress,
                       std::vector<StrengthPower>        &powers)
    {
      const auto            &edge = scene.edges[e];
      Linear<2>              cohesion;
      const SpatialStrength &one  = scene.strength_of_jump(e, cohesion);
      const JumpKind         kind = kind_of_jump(scene, e, one);
      if (kind != JumpKind::of_soil && kind != JumpKind::opening)
        return;
      StrengthPower &power = powers[&one - scene.bound.strengths.data()];
      for (unsigned int k = 0; k < jump.size(); ++k)
        {
          const Exponents<2> own  = {{space::order + 1 - k, k}};
          const double       part = mean(own, edge.radius),
                       c          = mean(own, edge.radius, cohesion) / part,
                       constant   = one.face_cohesion_per_k() * one.k / c;
          const double dissipation =
            edge.length * part *
            one
              .flow_of_jump(
                c, jump[k] * edge.normal, std::abs(jump[k] * edge.tangent()))
              .dissipation;
          power.cohesion += constant * dissipation;
          power.growth += (1. - constant) * dissipation;
          // The strength of an opening is c/tan(phi), of a slip c - s_n tan(phi).
          power.tan_phi -=
            dissipation * (kind == JumpKind::opening
                             ? 1.
                             : one.face_friction() * normal_stress() / c);
        }
    }
  } // namespace

  std::vector<StrengthPower>
  powers_of_upper(const AxisymmetricScene &scene,
                  const ConicProblem      &solved,
                  const Eigen::VectorXd   &q)
  {
    const BoundScene          &bound = scene.bound;
    std::vector<StrengthPower> powers(bound.strengths.size());
    const auto functions = bernstein::functions_of_triangle(space::order);
    const auto stresses  = stresses_of_cells<Eigen::Vector4d>(
      solved, bound.strengths, bound.triangles.material, functions.size());
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      {
        const auto            &cell  = scene.cells[c];
        const unsigned int     m     = bound.triangles.material[c];
        const SpatialStrength &one   = bound.strengths[m];
        const auto             rates = rates_of_cell(scene, q, c);
        for (unsigned int i = 0; i < rates.size(); ++i)
          {
            const double part = mean(functions[i], cell.radius),
                         k    = mean(functions[i], cell.radius, cell.strength) /
                             part;
            add_power_of_point(one,
                               cell.area * part *
                                 one.flow(k, rates[i]).dissipation,
                               k,
                               one.k / k,
                               stresses[functions.size() * c + i],
                               powers[m]);
          }
      }
    // The points of soil's jumps follow those of the cells.
    std::array<bool, SpatialStrength::n_forms> occurs = {};
    for (const unsigned int m : bound.triangles.material)
      occurs[bound.strengths[m].form()] = true;
    const auto   group = std::count(occurs.begin(), occurs.end(), true);
    unsigned int point = 0;
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      if (resists_jump(scene.edges[e]))
        add_powers_of_edge(
          scene,
          e,
          jump_at(scene, q, e),
          [&]() { return solved.groups[group]->stress(point++)[0]; },
          powers);
    return powers;
  }
} // namespace geocone::GEOCONE_DIM
