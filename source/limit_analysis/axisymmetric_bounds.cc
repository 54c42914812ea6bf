// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/limit_analysis/axisymmetric_bounds.h>
#include <geocone/limit_analysis/axisymmetric_strength.h>
#include <geocone/limit_analysis/cell_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using bernstein::Exponents;
  using bernstein::Linear;
  using bernstein::lowered;
  using bernstein::mean;
  using bernstein::raised;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Radius in units of length; that of vertices on the axis is exactly zero. */
    double
    scaled_radius(const Point<dim> &x, const double unit)
    {
      const double r = x[0] / unit;
      return r < 1e-12 ? 0. : r;
    }

    /** @throws InputError for a condition on the axis that holds more than the
     *  radius */
    void
    check_condition_on_axis(const BoundaryCondition &condition,
                            const FacetPlace        &place)
    {
      for (const Point<dim> &x : place.vertices)
        if (condition.components[1] ||
            (condition.components[0] &&
             condition.components[0]->value(x, 0.) != 0.))
          throw InputError(condition.parameter("Sides"),
                           condition.part(),
                           "Velocity x = 0 alone on the axis, where loads are "
                           "bounded",
                           "the axis has no area: hold another side");
    }
  } // namespace

  AxisymmetricScene::AxisymmetricScene(const BoundScene &bound)
    : bound(bound)
  {
    const Triangles &triangles = bound.triangles;
    const Scene     &scene     = bound.scene;
    const double     L         = bound.units.length;
    const auto       is_live   = [&](const LoadFactor kind) {
      return bound.factor == kind || bound.factor == LoadFactor::all;
    };
    edges.resize(triangles.edges.size());
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        Cell cell;
        cell.area      = triangles.area(c) / (L * L);
        cell.gradients = triangles.gradients(c);
        for (unsigned int i = 0; i < 3; ++i)
          {
            cell.gradients[i] *= L;
            const Point<dim> &x = triangles.vertices[triangles.cells[c][i]];
            cell.radius[i]      = scaled_radius(x, L);
            cell.strength[i]    = positive_strength(
              scene, bound.strengths, triangles.material[c], x);
            Edge &edge = edges[triangles.edges_of_cell[c][i]];
            if (edge.cells[0] == Edge::none)
              edge.normal = -cell.gradients[i] / cell.gradients[i].norm();
            edge.cells[edge.cells[0] == Edge::none ? 0 : 1] = c;
          }
        const Tensor<1, dim> weight = weight_of_cell(bound, c);
        if (weight[0] != 0.)
          throw InputError("Gravity/Acceleration",
                           scene.gravity.at(0.)[0],
                           "0 along x where loads are bounded around an axis",
                           "let the weight act along the axis");
        (is_live(LoadFactor::weight) ? cell.body_force.live
                                     : cell.body_force.dead) = weight;
        cells.push_back(cell);
      }
    const auto place_of = [&](const unsigned int e) {
      FacetPlace place;
      place.normal = edges[e].normal;
      for (unsigned int i = 0; i < 2; ++i)
        place.vertices[i] = triangles.vertices[triangles.edges[e].vertices[i]];
      return place;
    };
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        const FacetPlace place = place_of(e);
        edges[e].length = place.vertices[0].distance(place.vertices[1]) / L;
        for (unsigned int i = 0; i < 2; ++i)
          edges[e].radius[i] = scaled_radius(place.vertices[i], L);
      }

    std::vector<HeldComponents> held(edges.size());
    for (const auto &condition : scene.dirichlet.list)
      for (const auto &of : triangles.held_edges(*condition))
        if (edges[of.edge].is_on_axis())
          check_condition_on_axis(*condition, place_of(of.edge));
        else
          held[of.edge].add(*condition, place_of(of.edge));
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        edges[e].condition = held[e].condition(place_of(e));
        edges[e].condition.velocity /= bound.units.velocity;
      }
    for (const auto &load : scene.tractions.list)
      for (const auto &of : triangles.held_edges(*load))
        {
          Edge &edge = edges[of.edge];
          if (edge.is_on_axis())
            continue;
          const auto t =
            tractions_at_vertices(*load, place_of(of.edge), edge.condition);
          for (unsigned int i = 0; i < 2; ++i)
            (is_live(LoadFactor::tractions) ? edge.traction[i].live
                                            : edge.traction[i].dead) +=
              t[i] / bound.units.stress;
        }
  }

  void
  AxisymmetricScene::check_support() const
  {
    if (std::none_of(edges.begin(), edges.end(), [](const Edge &edge) {
          return edge.condition.holds(1);
        }))
      throw InputError("Boundary conditions/Names",
                       "conditions that leave the motion along the axis free",
                       "a support with Velocity y",
                       "nothing resists a translation of the body along y, so "
                       "no load has a limit: hold another side");
  }

  bool
  AxisymmetricScene::has_live_load() const
  {
    return std::any_of(cells.begin(),
                       cells.end(),
                       [](const Cell &cell) {
                         return cell.body_force.live.norm() > 0.;
                       }) ||
           std::any_of(edges.begin(), edges.end(), [](const Edge &edge) {
             return edge.traction[0].live.norm() +
                      edge.traction[1].live.norm() >
                    0.;
           });
  }

  const SpatialStrength &
  AxisymmetricScene::strength_of_jump(const unsigned int edge,
                                      Linear<2>         &cohesion) const
  {
    const auto strength_of = [&](const unsigned int cell) -> const auto &
    {
      return bound.strengths[bound.triangles.material[cell]];
    };
    const auto of_face = [&](const unsigned int cell) {
      return strength_of(cell).face_cohesion_per_k() * strength_of(cell).k;
    };
    const auto &[first, second] = edges[edge].cells;
    const SpatialStrength &one  = strength_of(
      second != Edge::none && of_face(second) < of_face(first) ? second
                                                               : first);
    for (unsigned int i = 0; i < 2; ++i)
      cohesion[i] =
        one.face_cohesion_per_k() *
        one.k_at(
          bound.triangles.vertices[bound.triangles.edges[edge].vertices[i]]);
    return one;
  }

  namespace
  {
    /** Forces F0 and f of a problem. */
    struct Forces
    {
      ConicProblem &problem;

      void
      add(const unsigned int dof, const double dead, const double live) const
      {
        problem.dead[dof] += dead;
        problem.live[dof] += live;
      }
    };

    /** Columns of a matrix of rates by dofs, each of which occurs once. */
    template <int n_rows, int n_columns>
    class Columns
    {
    public:
      using Vector = Eigen::Matrix<double, n_rows, 1>;

      void
      add(const unsigned int dof, const Vector &rate)
      {
        const auto end   = dofs.begin() + n;
        const auto found = std::find(dofs.begin(), end, dof);
        if (found == end)
          {
            AssertThrow(n < n_columns, dealii::ExcInternalError());
            dofs[n++] = dof;
          }
        B.col(found - dofs.begin()) += rate;
      }

      /** Completes unused columns by zeros. */
      void
      finish()
      {
        std::fill(dofs.begin() + n, dofs.end(), dofs[0]);
      }

      Eigen::Matrix<double, n_rows, n_columns> B =
        Eigen::Matrix<double, n_rows, n_columns>::Zero();
      std::array<unsigned int, n_columns> dofs;

    private:
      unsigned int n = 0;
    };

    /** Local index of the vertices of an edge in a cell. */
    std::array<unsigned int, 2>
    ends_in_cell(const Triangles   &triangles,
                 const unsigned int edge,
                 const unsigned int cell)
    {
      std::array<unsigned int, 2> ends;
      for (unsigned int i = 0; i < 2; ++i)
        ends[i] = std::find(triangles.cells[cell].begin(),
                            triangles.cells[cell].end(),
                            triangles.edges[edge].vertices[i]) -
                  triangles.cells[cell].begin();
      return ends;
    }

    namespace space = axisymmetric_velocity;

    constexpr unsigned int columns_of_rate = 8, columns_of_jump = 6;
    using EdgePoints    = PointGroupOf<FaceConeOf<2>, columns_of_jump>;
    using OpeningPoints = PointGroupOf<OpeningCone, columns_of_jump>;

    /** Groups of the points of cells, without points. */
    template <int n_columns>
    CellPoints<n_columns, AxisymmetricMohrCoulomb, CircularConeOf<4>>
    empty_axisymmetric_points(const std::vector<SpatialStrength> &strengths)
    {
      return CellPoints<n_columns, AxisymmetricMohrCoulomb, CircularConeOf<4>>(
        strengths,
        [](const auto &one) { return axisymmetric_mohr_coulomb(one.a); },
        [](const auto &one) { return circular_cone<4>(one.a); });
    }

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
    class HeldBodies
    {
    public:
      HeldBodies(const AxisymmetricScene &scene, const unsigned int first_dof)
        : first_dof(first_dof)
      {
        for (const auto &edge : scene.edges)
          if (edge.condition.kind != FacetCondition::Kind::free)
            number.emplace(key(edge), number.size());
      }

      unsigned int
      n_dofs() const
      {
        return dim * number.size();
      }

      unsigned int
      dof_of(const AxisymmetricScene::Edge &edge) const
      {
        return first_dof + dim * number.at(key(edge));
      }

      void
      prescribe(ConicProblem &problem) const
      {
        for (const auto &[velocity, own] : number)
          for (unsigned int d = 0; d < dim; ++d)
            {
              problem.is_prescribed[first_dof + dim * own + d] = true;
              problem.prescribed[first_dof + dim * own + d]    = velocity[d];
            }
      }

    private:
      using Key = std::array<double, dim>;

      static Key
      key(const AxisymmetricScene::Edge &edge)
      {
        return {{edge.condition.velocity[0], edge.condition.velocity[1]}};
      }

      std::map<Key, unsigned int> number;
      unsigned int                first_dof;
    };

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
      const auto           &edge = scene.edges[e];
      const FacetCondition &held = edge.condition;
      if (!edge.is_inner() && held.kind == FacetCondition::Kind::free)
        return;
      Linear<2>              cohesion;
      const SpatialStrength &one = scene.strength_of_jump(e, cohesion);
      const bool is_plane        = held.kind == FacetCondition::Kind::plane;
      if (is_plane && one.face_friction() == 0.)
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
              jump.add(bodies.dof_of(edge) + d, v);
            }
        jump.finish();
      };
      for (unsigned int k = 0; k <= space::order + 1; ++k)
        {
          const Exponents<2> own  = {{space::order + 1 - k, k}};
          const double       part = mean(own, edge.radius),
                       weight     = edge.length * part,
                       c          = mean(own, edge.radius, cohesion) / part;
          if (is_plane)
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
  upper_problem(const AxisymmetricScene &scene)
  {
    const BoundScene  &bound      = scene.bound;
    const unsigned int n_cells    = scene.cells.size();
    const unsigned int first_body = (space::n_v + space::n_w) * n_cells;
    const HeldBodies   bodies(scene, first_body);
    ConicProblem problem = ConicProblem::of_dofs(first_body + bodies.n_dofs());
    const Forces forces  = {problem};
    bodies.prescribe(problem);

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
        for (const auto &a : bernstein::functions_of_triangle(space::order + 1))
          {
            const double part = cell.area * mean(a, cell.radius);
            forces.add(space::dof_of_w(c, a),
                       part * cell.body_force.dead[1],
                       part * cell.body_force.live[1]);
          }
      }
    JumpPoints jumps(bound.strengths);
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      if (!scene.edges[e].is_on_axis())
        {
          if (!scene.edges[e].is_inner())
            add_tractions_of_edge(scene, e, forces);
          add_jumps(scene, e, bodies, jumps, problem);
        }
    points.move_to(problem);
    jumps.move_to(problem);
    return problem;
  }

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

    /** Adds the stress and the weight of a cell. */
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
      const double       V        = cell.area / EquilibriumDofs::n_r,
                   V_z            = cell.area / EquilibriumDofs::n_z;
      for (const auto &a :
           bernstein::functions_of_triangle(EquilibriumDofs::order))
        {
          const double k =
            bernstein::coefficient(a, cell.radius, cell.strength);
          // On the axis the stress times r is zero.
          if (k == 0.)
            {
              const unsigned int equation =
                equations.of_r(c) + bernstein::position(a);
              problem.is_prescribed[equation] = true;
              StressColumns none;
              none.add(equation, Eigen::Vector4d::Zero());
              none.finish();
              points.add(material, none.B, none.dofs, V, 1.);
              continue;
            }
          const auto rate = equations_of(scene, c, a, equations);
          points.add(material, rate.B, rate.dofs, V, k);
        }
      const Forces forces = {problem};
      for (unsigned int i = 0; i < EquilibriumDofs::n_z; ++i)
        forces.add(equations.of_z(c) + i,
                   V_z * cell.radius[i] * cell.body_force.dead[1],
                   V_z * cell.radius[i] * cell.body_force.live[1]);
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
  lower_problem(const AxisymmetricScene &scene)
  {
    const EquilibriumDofs equations(scene);
    ConicProblem          problem = ConicProblem::of_dofs(equations.n);
    auto                  points =
      empty_axisymmetric_points<columns_of_stress>(scene.bound.strengths);
    for (unsigned int c = 0; c < scene.cells.size(); ++c)
      add_cell(scene, c, equations, points, problem);
    for (unsigned int e = 0; e < scene.edges.size(); ++e)
      add_edge(scene, e, equations, problem);
    points.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
