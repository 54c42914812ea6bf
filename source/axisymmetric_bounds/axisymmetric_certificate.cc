// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_certificate.h>
#include <geocone/axisymmetric_bounds/axisymmetric_points.h>
#include <geocone/base/log.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using bernstein::Exponents;
  using bernstein::Linear;
  using bernstein::lowered;
  using bernstein::mean;
  using bernstein::mean_of_product;
  using bernstein::raised;
  using dealii::Tensor;

  namespace
  {
    namespace space = axisymmetric_velocity;

    Eigen::Matrix3d
    tensor_of(const SpatialMandel &s)
    {
      Eigen::Matrix<double, 6, 1> all = Eigen::Matrix<double, 6, 1>::Zero();
      all.head<4>()                   = s;
      return spatial_tensor(all);
    }

    /** Stress times a vector in the plane. */
    Tensor<1, dim>
    traction_of(const SpatialMandel &s, const Tensor<1, dim> &n)
    {
      const double shear = s[2] / sqrt2;
      return Tensor<1, dim>(
        {s[0] * n[0] + shear * n[1], shear * n[0] + s[1] * n[1]});
    }

    /** Traction of a cell on an edge: the coefficients of its polynomial. */
    std::vector<Tensor<1, dim>>
    tractions_on_edge(const AxisymmetricScene          &scene,
                      const std::vector<SpatialMandel> &stress,
                      const unsigned int                number,
                      const unsigned int                cell)
    {
      const auto [a, b] = ends_in_cell(scene.bound.triangles, number, cell);
      std::vector<Tensor<1, dim>> t;
      for (unsigned int k = 0; k <= axisymmetric_stress::order; ++k)
        t.push_back(traction_of(stress[axisymmetric_stress::n * cell +
                                       bernstein::position(bernstein::on_edge(
                                         axisymmetric_stress::order, a, b, k))],
                                scene.edges[number].normal));
      return t;
    }

    /** Largest residual of equilibrium and power of the reactions. */
    struct StaticsOfBody
    {
      double error = 0., power = 0.;
    };

    StaticsOfBody
    statics_of_body(const AxisymmetricScene          &scene,
                    const std::vector<SpatialMandel> &stress,
                    const double                      lambda)
    {
      constexpr unsigned int order = axisymmetric_stress::order;
      StaticsOfBody          result;
      for (unsigned int c = 0; c < scene.cells.size(); ++c)
        {
          const auto                &cell = scene.cells[c];
          const SpatialMandel *const s    = &stress[axisymmetric_stress::n * c];
          const double               mean_radius =
            (cell.radius[0] + cell.radius[1] + cell.radius[2]) / 3.;
          const auto divergence = [&](const Exponents<3> &b) {
            Tensor<1, dim> sum;
            for (unsigned int j = 0; j < 3; ++j)
              sum += double(order) *
                     traction_of(s[bernstein::position(raised(b, j))],
                                 cell.gradients[j]);
            return sum;
          };
          const auto add_error = [&](const double left) {
            take_larger(result.error,
                        std::abs(left) / mean_radius * std::sqrt(cell.area));
          };
          const Tensor<1, dim> f =
            cell.body_force.dead + lambda * cell.body_force.live;
          for (unsigned int i = 0; i < 3; ++i)
            {
              add_error(divergence(raised(Exponents<3>{{0, 0, 0}}, i))[1] +
                        cell.radius[i] * f[1]);
            }
          for (const auto &a : bernstein::functions_of_triangle(order))
            {
              double left =
                f[0] * bernstein::coefficient(a, cell.radius, cell.radius) -
                s[bernstein::position(a)][3];
              for (unsigned int i = 0; i < 3; ++i)
                if (a[i] > 0)
                  left += double(a[i]) / order * cell.radius[i] *
                          divergence(lowered(a, i))[0];
              add_error(left / mean_radius);
            }
        }
      for (unsigned int e = 0; e < scene.edges.size(); ++e)
        {
          const auto &edge = scene.edges[e];
          if (edge.is_on_axis())
            continue;
          auto left = tractions_on_edge(scene, stress, e, edge.cells[0]);
          if (edge.is_inner())
            {
              const auto other =
                tractions_on_edge(scene, stress, e, edge.cells[1]);
              for (unsigned int k = 0; k < left.size(); ++k)
                left[k] -= other[k];
            }
          for (unsigned int k = 0; k < left.size(); ++k)
            {
              const AxisymmetricScene::Load given =
                traction_coefficient(edge, k);
              left[k] -= given.dead + lambda * given.live;
              for (unsigned int d = 0; d < dim; ++d)
                if (edge.condition.holds(d))
                  result.power += edge.length / (order + 1) * left[k][d] *
                                  edge.condition.velocity[d];
                else
                  take_larger(result.error,
                              2. * std::abs(left[k][d]) /
                                (edge.radius[0] + edge.radius[1]));
            }
        }
      return result;
    }
  } // namespace

  Bound
  certify_lower(const AxisymmetricScene          &scene,
                const std::vector<SpatialMandel> &stress,
                const double                      lambda)
  {
    Bound         result;
    StressCheck   check;
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      {
        const auto            &cell = scene.cells[c];
        const SpatialStrength &one =
          scene.bound.strengths[scene.bound.triangles.material[c]];
        const double mean_radius =
          (cell.radius[0] + cell.radius[1] + cell.radius[2]) / 3.;
        check.is_dead = check.is_dead || cell.body_force.dead.norm() > 0.;
        for (const auto &a :
             bernstein::functions_of_triangle(axisymmetric_stress::order))
          {
            const SpatialMandel &s =
              stress[axisymmetric_stress::n * c + bernstein::position(a)];
            const double k =
              bernstein::coefficient(a, cell.radius, cell.strength);
            if (k == 0. && s.isZero(0.))
              continue; // on the axis
            const Eigen::Matrix3d m = tensor_of(s);
            check.add(
              one.utilisation(k, m), k / mean_radius, m.norm() / mean_radius);
          }
      }
    for (const auto &edge : scene.edges)
      check.is_dead = check.is_dead || edge.traction[0].dead.norm() > 0. ||
                      edge.traction[1].dead.norm() > 0.;
    const StaticsOfBody found = statics_of_body(scene, stress, lambda);
    check.add_error(found.error);
    const double theta = check.judge(
      result,
      scene.bound.factor == LoadFactor::velocity ? found.power : lambda);
    result.stress = stress;
    for (SpatialMandel &s : result.stress)
      s *= theta;
    return result;
  }

  std::vector<Eigen::Matrix3d>
  rates_of_cell(const AxisymmetricScene &scene,
                const Eigen::VectorXd   &q,
                const unsigned int       number)
  {
    const auto                  &cell = scene.cells[number];
    std::vector<Eigen::Matrix3d> rates;
    for (const auto &a : bernstein::functions_of_triangle(space::order))
      {
        const double   v = q[space::dof_of_v(number, a)];
        Tensor<1, dim> of_r, of_z; // gradients of r v, less v, and of w
        for (unsigned int j = 0; j < 3; ++j)
          {
            of_z += (space::order + 1.) *
                    q[space::dof_of_w(number, raised(a, j))] *
                    cell.gradients[j];
            for (unsigned int i = 0; i < 3; ++i)
              if (a[i] > 0)
                of_r += a[i] * cell.radius[i] *
                        q[space::dof_of_v(number, raised(lowered(a, i), j))] *
                        cell.gradients[j];
          }
        Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
        e(0, 0)           = v + of_r[0];
        e(1, 1)           = of_z[1];
        e(0, 1) = e(1, 0) = (of_r[1] + of_z[0]) / 2.;
        e(2, 2)           = v;
        rates.push_back(e);
      }
    return rates;
  }

  std::vector<Tensor<1, dim>>
  velocity_on_edge(const AxisymmetricScene &scene,
                   const Eigen::VectorXd   &q,
                   const unsigned int       number,
                   const unsigned int       cell)
  {
    const auto &r     = scene.edges[number].radius;
    const auto [a, b] = ends_in_cell(scene.bound.triangles, number, cell);
    constexpr unsigned int      n = space::order + 1;
    std::vector<Tensor<1, dim>> u(n + 1);
    for (unsigned int k = 0; k <= n; ++k)
      u[k][1] = q[space::dof_of_w(cell, bernstein::on_edge(n, a, b, k))];
    for (unsigned int k = 0; k < n; ++k)
      {
        const double v =
          q[space::dof_of_v(cell, bernstein::on_edge(n - 1, a, b, k))];
        u[k][0] += double(n - k) / n * r[0] * v;
        u[k + 1][0] += double(k + 1) / n * r[1] * v;
      }
    return u;
  }

  std::vector<Tensor<1, dim>>
  jump_at(const AxisymmetricScene &scene,
          const Eigen::VectorXd   &q,
          const unsigned int       number)
  {
    const auto &edge = scene.edges[number];
    auto        u    = velocity_on_edge(scene, q, number, edge.cells[0]);
    if (edge.is_inner())
      {
        const auto outer = velocity_on_edge(scene, q, number, edge.cells[1]);
        for (unsigned int k = 0; k < u.size(); ++k)
          u[k] = outer[k] - u[k];
      }
    else
      for (Tensor<1, dim> &one : u)
        one = edge.condition.velocity - one;
    if (edge.condition.kind == FacetCondition::Kind::plane)
      for (Tensor<1, dim> &one : u) // the soil slides freely along it
        one = (one * edge.normal) * edge.normal;
    return u;
  }

  bool
  resists_jump(const AxisymmetricScene::Edge &edge)
  {
    return !edge.is_on_axis() &&
           (edge.is_inner() ||
            edge.condition.kind != FacetCondition::Kind::free);
  }

  namespace
  {
    /** Power of the dead and the live loads. */
    struct PowerOfLoads
    {
      double dead = 0., live = 0.;

      void
      add(const double weight, const double dead_force, const double live_force)
      {
        dead += weight * dead_force;
        live += weight * live_force;
      }
    };

    PowerOfLoads
    power_of_loads(const AxisymmetricScene &scene, const Eigen::VectorXd &q)
    {
      PowerOfLoads power;
      for (unsigned int c = 0; c < scene.cells.size(); ++c)
        {
          const auto &cell = scene.cells[c];
          for (const auto &a : bernstein::functions_of_triangle(space::order))
            power.add(cell.area * mean(a, cell.radius, cell.radius) *
                        q[space::dof_of_v(c, a)],
                      cell.body_force.dead[0],
                      cell.body_force.live[0]);
          for (const auto &a :
               bernstein::functions_of_triangle(space::order + 1))
            power.add(cell.area * mean(a, cell.radius) *
                        q[space::dof_of_w(c, a)],
                      cell.body_force.dead[1],
                      cell.body_force.live[1]);
        }
      for (unsigned int e = 0; e < scene.edges.size(); ++e)
        {
          const auto &edge = scene.edges[e];
          if (edge.is_on_axis() || edge.is_inner())
            continue;
          const auto u = velocity_on_edge(scene, q, e, edge.cells[0]);
          for (unsigned int k = 0; k < u.size(); ++k)
            for (unsigned int i = 0; i < 2; ++i)
              {
                Linear<2> at           = {{0., 0.}};
                at[i]                  = 1.;
                const Exponents<2> own = {
                  {static_cast<unsigned int>(u.size()) - 1 - k, k}};
                power.add(edge.length * mean(own, edge.radius, at),
                          edge.traction[i].dead * u[k],
                          edge.traction[i].live * u[k]);
              }
        }
      return power;
    }
  } // namespace

  Bound
  certify_upper(const AxisymmetricScene &scene,
                const Eigen::VectorXd   &q,
                AxisymmetricPower       &power)
  {
    const BoundScene &bound = scene.bound;
    Bound             result;
    result.q = q;
    power.of_cell.assign(scene.cells.size(), 0.);
    power.of_edge.assign(scene.edges.size(), 0.);
    VelocityCheck check;
    double        sum       = 0.;
    const auto functions = bernstein::functions_of_triangle(space::order);
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      {
        const auto            &cell = scene.cells[c];
        const SpatialStrength &one =
          bound.strengths[bound.triangles.material[c]];
        const auto rates = rates_of_cell(scene, q, c);
        for (unsigned int i = 0; i < rates.size(); ++i)
          {
            const double part = mean(functions[i], cell.radius);
            const auto   flow = one.flow(
              mean(functions[i], cell.radius, cell.strength) / part, rates[i]);
            power.of_cell[c] += cell.area * part * flow.dissipation;
            check.add_rate(flow, rates[i].norm());
          }
        sum += power.of_cell[c];
      }
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      {
        const auto &edge = scene.edges[e];
        for (const Tensor<1, dim> &u :
             velocity_on_edge(scene, q, e, edge.cells[0]))
          take_larger(check.fastest, u.norm());
        if (!resists_jump(edge))
          continue;
        Linear<2>              cohesion;
        const SpatialStrength &one = scene.strength_of_jump(e, cohesion);
        const auto             u   = jump_at(scene, q, e);
        for (unsigned int k = 0; k < u.size(); ++k)
          {
            const Exponents<2> own = {
              {static_cast<unsigned int>(u.size()) - 1 - k, k}};
            const double part = mean(own, edge.radius);
            const auto   flow =
              one.flow_of_jump(mean(own, edge.radius, cohesion) / part,
                               u[k] * edge.normal,
                               std::abs(u[k] * edge.tangent()));
            power.of_edge[e] += edge.length * part * flow.dissipation;
            check.add_jump(flow);
          }
        sum += power.of_edge[e];
      }
    const PowerOfLoads of_loads = power_of_loads(scene, q);
    sum -= of_loads.dead;
    power.work = bound.factor == LoadFactor::velocity ? 1. : of_loads.live;
    // Parts of a body that slide as rigid ones have no other measure of their rates.
    take_larger(check.largest_rate, check.fastest);
    check.judge(result, sum, power.work);
    return result;
  }

  CertifiedSide
  certified_upper(const AxisymmetricScene &scene,
                  const double             tolerance,
                  AxisymmetricPower       &power)
  {
    ConicProblem          problem = upper_problem(scene);
    CertifiedSide         side;
    static_cast<ConicSolution &>(side.solution) =
      solve_for_velocities(problem, tolerance, [&](const Eigen::VectorXd &q) {
        side.bound = certify_upper(scene, q, power);
        return side.bound;
      });
    side.n_unknowns     = problem.n_unknowns();
    side.strength_power = powers_of_upper(scene, problem, side.bound.q);
    return side;
  }

  CertifiedSide
  certified_lower(const AxisymmetricScene &scene, const double tolerance)
  {
    ConicProblem problem = lower_problem(scene);
    ConicOptions options;
    options.tolerance      = tolerance;
    options.flow_tolerance = tolerance;
    options.stresses       = true;
    if (problem.dead.squaredNorm() > 0.)
      options.strength_margin = 1e-5;
    CertifiedSide side;
    static_cast<ConicSolution &>(side.solution) = solve(problem, options);
    side.n_unknowns                             = problem.n_unknowns();
    auto stress =
      stresses_of_cells<SpatialMandel>(problem,
                                       scene.bound.strengths,
                                       scene.bound.triangles.material,
                                       axisymmetric_stress::n);
    // Points on the axis have no part in the problem.
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      for (const auto &a :
           bernstein::functions_of_triangle(axisymmetric_stress::order))
        if (bernstein::coefficient(
              a, scene.cells[c].radius, scene.cells[c].strength) == 0.)
          stress[axisymmetric_stress::n * c + bernstein::position(a)].setZero();
    side.bound   = certify_lower(scene, stress, side.solution.load);
    side.bound.q = side.solution.q; // shows the mechanism
    side.power.assign(scene.cells.size(), 0.);
    side.strength_power = powers_of_lower(scene, problem, side.solution.q);
    return side;
  }

  void
  add_power_of_point(const SpatialStrength &strength,
                     const double           dissipation,
                     const double           k,
                     const double           constant,
                     const Eigen::Vector4d &stress,
                     StrengthPower         &power)
  {
    power.cohesion += constant * dissipation;
    power.growth += (1. - constant) * dissipation;
    const double a = strength.a;
    if (strength.is_circular || a == 0.)
      return;
    // Of k - (1 + a) s_1 + (1 - a) s_3: da = a cos^2(phi) d ln tan(phi), and k is
    // proportional to cos(phi).
    const double middle = (stress[0] + stress[1]) / 2.,
                 radius =
                   std::hypot((stress[0] - stress[1]) / 2., stress[2] / sqrt2),
                 most  = std::max(middle + radius, stress[3]),
                 least = std::min(middle - radius, stress[3]);
    power.tan_phi -=
      dissipation / k * (a * a * k + a * (1. - a * a) * (most + least));
  }

  std::vector<double>
  gap_of_cells(const AxisymmetricScene &scene,
               const Bound             &upper,
               const AxisymmetricPower &power,
               const Bound             &lower)
  {
    std::vector<double> gap = power.of_cell;
    const auto functions    = bernstein::functions_of_triangle(space::order);
    for (unsigned int c = 0; c < gap.size(); ++c)
      {
        const auto &cell  = scene.cells[c];
        const auto  rates = rates_of_cell(scene, upper.q, c);
        for (const auto &a :
             bernstein::functions_of_triangle(axisymmetric_stress::order))
          {
            const Eigen::Matrix3d s = tensor_of(
              lower
                .stress[axisymmetric_stress::n * c + bernstein::position(a)]);
            for (unsigned int j = 0; j < rates.size(); ++j)
              gap[c] -= cell.area * mean_of_product(functions[j], a) *
                        s.cwiseProduct(rates[j]).sum();
          }
      }
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      {
        const auto &edge = scene.edges[e];
        if (!resists_jump(edge))
          continue;
        double     part = power.of_edge[e];
        const auto u    = jump_at(scene, upper.q, e);
        const auto t = tractions_on_edge(scene, lower.stress, e, edge.cells[0]);
        for (unsigned int i = 0; i < t.size(); ++i)
          for (unsigned int k = 0; k < u.size(); ++k)
            part -=
              edge.length *
              mean_of_product(Exponents<2>{{axisymmetric_stress::order - i, i}},
                              Exponents<2>{{space::order + 1 - k, k}}) *
              (t[i] * u[k]);
        for (const unsigned int c : edge.cells)
          if (c != AxisymmetricScene::Edge::none)
            gap[c] += edge.is_inner() ? part / 2. : part;
      }
    return gap;
  }

  SpatialMandel
  stress_at_vertex(const BoundScene  &bound,
                   const Bound       &lower,
                   const unsigned int cell,
                   const unsigned int vertex)
  {
    constexpr unsigned int order  = axisymmetric_stress::order;
    const auto             radius = [&](const unsigned int i) {
      return bound.triangles.vertices[bound.triangles.cells[cell][i]][0] /
             bound.units.length;
    };
    // The coefficient next to the vertex is half of r times the slope on the axis.
    const bool   is_on_axis = radius(vertex) < 1e-12;
    unsigned int other      = (vertex + 1) % 3;
    if (radius((vertex + 2) % 3) > radius(other))
      other = (vertex + 2) % 3;
    const SpatialMandel &s =
      lower.stress[axisymmetric_stress::n * cell +
                   bernstein::position(bernstein::on_edge(
                     order, vertex, other, is_on_axis ? 1 : 0))];
    return s * (is_on_axis ? order / radius(other) : 1. / radius(vertex));
  }

  Tensor<1, dim>
  multiplier_at_vertex(const Eigen::VectorXd &q,
                       const unsigned int     cell,
                       const unsigned int     vertex)
  {
    constexpr unsigned int n_r = axisymmetric_stress::n,
                           n_z = bernstein::n_in_triangle(
                             axisymmetric_stress::order - 1);
    const unsigned int first = (n_r + n_z) * cell;
    return Tensor<1, dim>(
      {q[first + bernstein::position(bernstein::on_edge(
                   axisymmetric_stress::order, vertex, (vertex + 1) % 3, 0))],
       q[first + n_r + vertex]});
  }

  Tensor<1, dim>
  velocity_at_vertex(const Eigen::VectorXd &q,
                     const unsigned int     cell,
                     const unsigned int     vertex,
                     const double           radius)
  {
    Exponents<3> v = {{0, 0, 0}}, w = v;
    v[vertex] = space::order;
    w[vertex] = space::order + 1;
    return Tensor<1, dim>(
      {radius * q[space::dof_of_v(cell, v)], q[space::dof_of_w(cell, w)]});
  }
} // namespace geocone::GEOCONE_DIM
