// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/base/constants.h>
#include <geocone/bounds/strengths_in_files.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/certificate_files.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    Json
    pair(const double x, const double y)
    {
      return Json::array({x, y});
    }

    Json
    pair_at(const Eigen::VectorXd &v,
            const unsigned int     first,
            const double           unit)
    {
      return pair(unit * v[first], unit * v[first + 1]);
    }

    /** Materials with their given strengths, cohesion c + gradient (level - y), and their
     *  ratios by direction if there are any. */
    Json
    materials_of(const BoundScene &given)
    {
      Json       materials    = Json::array();
      const bool by_direction = std::any_of(
        given.cones.begin(), given.cones.end(), [](const PointCone &one) {
          return !one.ellipse.is_circle();
        });
      for (unsigned int m = 0; m < given.cones.size(); ++m)
        {
          const PointCone &cone = given.cones[m];
          const double     unit =
            given.units.stress / (sqrt2 * std::sqrt(1. - cone.a * cone.a));
          materials.push_back(
            {{"name", given.scene.materials.name(m)},
             {"cohesion", cone.k * unit},
             {"cohesion_gradient", given.growth[m].slope * unit},
             {"cohesion_level", given.growth[m].level},
             {"friction_angle", std::asin(cone.a) * 180. / pi},
             {"tensile_strength",
              finite_or_null(cone.cut_off * given.units.stress / sqrt2)},
             {"is_reduced", given.scene.materials[m].is_reduced()}});
          if (by_direction)
            {
              const StrengthEllipse &ellipse    = cone.ellipse;
              materials.back()["passive_ratio"] = 2. * ellipse.compression - 1.;
              materials.back()["simple_shear_ratio"] = ellipse.shear;
              materials.back()["anisotropy_angle"] =
                std::atan2(ellipse.sine, ellipse.cosine) * 90. / pi;
            }
        }
      return materials;
    }

    /** Obstacles with their loads in free components, and one more at rest, smooth and
     *  inseparable, for oblique sides that are fixed in their normal direction.
     *  @param problem lower-bound problem */
    Json
    obstacles_with_loads(const BoundScene &given, const BoundProblem &problem)
    {
      const Triangles   &triangles = given.triangles;
      const unsigned int first_dof =
        dim * (triangles.cells.size() + 2 * triangles.edges.size());
      const double L         = given.units.length;
      Json         obstacles = Json::array();
      for (unsigned int o = 0; o < given.scene.obstacles.list.size(); ++o)
        {
          const Obstacle    &obstacle = *given.scene.obstacles.list[o];
          const RigidMotion  velocity = obstacle.velocity(0.);
          const unsigned int first    = first_dof + n_motions * o;
          Json               motion = Json::array(), dead = Json::array(),
               live = Json::array();
          for (unsigned int k = 0; k < n_motions; ++k)
            {
              const double unit = given.units.stress * L * (k < dim ? 1. : L);
              motion.push_back(obstacle.is_free(k) ? Json()
                                                   : Json(velocity[k]));
              dead.push_back(unit * problem.dead[first + k]);
              live.push_back(unit * problem.live[first + k]);
            }
          const InterfaceLaw &law = obstacle.law;
          obstacles.push_back(
            {{"name", obstacle.name},
             {"centre", pair(obstacle.centre()[0], obstacle.centre()[1])},
             {"velocity", motion},
             {"dead", dead},
             {"live", live},
             {"friction", law.friction},
             {"adhesion", law.adhesion},
             {"tensile_strength",
              law.never_opens() ? Json() : Json(law.tension)}});
        }
      const Json at_rest = Json::array({0., 0., 0.});
      for (const Interface &interface : given.interfaces)
        if (interface.obstacle < 0)
          {
            obstacles.push_back({{"name", "oblique sides"},
                                 {"centre", pair(0., 0.)},
                                 {"velocity", at_rest},
                                 {"dead", at_rest},
                                 {"live", at_rest},
                                 {"friction", 0.},
                                 {"adhesion", 0.},
                                 {"tensile_strength", Json()}});
            break;
          }
      return obstacles;
    }

    Json
    interfaces_of(const BoundScene &given)
    {
      Json edges = Json::array(), obstacles = Json::array();
      for (const Interface &interface : given.interfaces)
        {
          edges.push_back(interface.held.edge);
          obstacles.push_back(interface.obstacle >= 0
                                ? interface.obstacle
                                : int(given.scene.obstacles.list.size()));
        }
      return {{"edge", edges}, {"obstacle", obstacles}};
    }

    /**
     * Loads and supports of the body. Loads are taken from the lower-bound problem, in
     * which each dof belongs to one triangle or one end of an edge, supports from the
     * midpoints of the edges in the upper-bound problem.
     */
    void
    add_loads_and_supports(const BoundScene   &given,
                           const BoundProblem &problem,
                           Json               &json)
    {
      const BoundProblem above     = upper_problem(given);
      const Triangles   &triangles = given.triangles;
      const double       L = given.units.length, stress = given.units.stress;
      Json dead_forces = Json::array(), live_forces = Json::array();
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        {
          const double unit = stress * L / triangles.area(c);
          dead_forces.push_back(pair_at(problem.dead, dim * c, unit));
          live_forces.push_back(pair_at(problem.live, dim * c, unit));
        }
      json["body_force"] = {{"dead", dead_forces}, {"live", live_forces}};

      Json edges = Json::array(), held = Json::array(), dead = Json::array(),
           live = Json::array(), velocity = Json::array();
      for (const auto &outer : triangles.outer_edges())
        {
          const double unit =
            2. * L * stress / triangles.edge_length(outer.edge);
          const unsigned int first =
                               dim * (triangles.cells.size() + 2 * outer.edge),
                             middle =
                               dim * (triangles.vertices.size() + outer.edge);
          edges.push_back(outer.edge);
          held.push_back({bool(above.is_prescribed[middle]),
                          bool(above.is_prescribed[middle + 1])});
          velocity.push_back(
            pair_at(above.prescribed, middle, given.units.velocity));
          dead.push_back({pair_at(problem.dead, first, unit),
                          pair_at(problem.dead, first + dim, unit)});
          live.push_back({pair_at(problem.live, first, unit),
                          pair_at(problem.live, first + dim, unit)});
        }
      json["boundary"] = {{"edge", edges},
                          {"held", held},
                          {"velocity", velocity},
                          {"dead", dead},
                          {"live", live}};
    }

    /** Stresses (xx, yy, xy) at the vertices of the triangles, and the tractions of
     *  interfaces on the body at the ends of their edges (Pa). */
    void
    add_stresses(const BoundScene &given, const Bound &bound, Json &json)
    {
      const double       unit      = given.units.stress;
      const unsigned int n_cells   = given.triangles.cells.size();
      Json               stress    = Json::array();
      Json               tractions = Json::array();
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          Json of_cell = Json::array();
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Mandel s =
                unit * from_cone_axes(Mandel(bound.s[3 * c + i]));
              of_cell.push_back({s[0], s[1], s[2] / sqrt2});
            }
          stress.push_back(of_cell);
        }
      unsigned int first = 3 * n_cells;
      for (const Interface &interface : given.interfaces)
        {
          Tensor<1, dim>        ends[2];
          const Tensor<1, dim> &N = interface.normal;
          const Tensor<1, dim>  T({-N[1], N[0]});
          for (unsigned int f = 0; f < interface.faces.size(); ++f, first += 3)
            for (unsigned int i = 0; i < 2; ++i)
              {
                // The second face of an interface that opens has the same traction.
                if (f > 0 && interface.opens())
                  continue;
                if (interface.faces[f].has_normal)
                  ends[i] += unit * bound.s[first + i][0] * N;
                if (interface.faces[f].has_tangential)
                  ends[i] += unit * bound.s[first + i][1] * T;
              }
          tractions.push_back(
            {pair(ends[0][0], ends[0][1]), pair(ends[1][0], ends[1][1])});
        }
      json["stress"]                 = stress;
      json["interfaces"]["traction"] = tractions;
    }

    /** Velocities of the vertices, the edges' midpoints and the obstacles (m/s). */
    void
    add_velocities(const BoundScene &given, const Bound &bound, Json &json)
    {
      const Triangles   &triangles   = given.triangles;
      const double       unit        = given.units.velocity;
      const unsigned int n_vertices  = triangles.vertices.size();
      const unsigned int n_edges     = triangles.edges.size();
      Json               of_vertices = Json::array(), of_edges = Json::array(),
           of_obstacles = Json::array();
      for (unsigned int v = 0; v < n_vertices; ++v)
        of_vertices.push_back(pair_at(bound.q, dim * v, unit));
      for (unsigned int e = 0; e < n_edges; ++e)
        of_edges.push_back(pair_at(bound.q, dim * (n_vertices + e), unit));
      for (unsigned int o = 0; o < given.scene.obstacles.list.size(); ++o)
        {
          const unsigned int first =
            dim * (n_vertices + n_edges) + n_motions * o;
          Json motion = pair_at(bound.q, first, unit);
          motion.push_back(bound.q[first + dim] * unit / given.units.length);
          of_obstacles.push_back(motion);
        }
      if (json["obstacles"].size() > of_obstacles.size()) // oblique sides
        of_obstacles.push_back({0., 0., 0.});
      json["velocity"] = {{"vertices", of_vertices},
                          {"middles", of_edges},
                          {"obstacles", of_obstacles}};
    }

    void
    add_mesh(const Triangles &triangles, Json &json)
    {
      Json vertices = Json::array(), edges = Json::array();
      for (const auto &x : triangles.vertices)
        vertices.push_back(pair(x[0], x[1]));
      for (const auto &edge : triangles.edges)
        edges.push_back(edge.vertices);
      json["vertices"]  = vertices;
      json["edges"]     = edges;
      json["triangles"] = triangles.cells;
      json["material"]  = triangles.material;
    }

    /** Loads and supports of an axisymmetric body. */
    void
    add_loads_and_supports(const AxisymmetricScene &scene, Json &json)
    {
      const BoundUnits &units = scene.bound.units;
      const auto in_units     = [](const Tensor<1, dim> &v, const double unit) {
        return pair(unit * v[0], unit * v[1]);
      };
      Json dead_forces = Json::array(), live_forces = Json::array();
      for (const auto &cell : scene.cells)
        {
          const double unit = units.stress / units.length;
          dead_forces.push_back(in_units(cell.body_force.dead, unit));
          live_forces.push_back(in_units(cell.body_force.live, unit));
        }
      json["body_force"] = {{"dead", dead_forces}, {"live", live_forces}};
      Json edges = Json::array(), held = Json::array(), dead = Json::array(),
           live = Json::array(), velocity = Json::array();
      for (unsigned int e = 0; e < scene.edges.size(); ++e)
        {
          const AxisymmetricScene::Edge &edge = scene.edges[e];
          if (edge.is_inner())
            continue;
          edges.push_back(e);
          held.push_back({edge.condition.holds(0), edge.condition.holds(1)});
          velocity.push_back(in_units(edge.condition.velocity, units.velocity));
          Json dead_at = Json::array(), live_at = Json::array();
          for (const auto &at_vertex : edge.traction)
            {
              dead_at.push_back(in_units(at_vertex.dead, units.stress));
              live_at.push_back(in_units(at_vertex.live, units.stress));
            }
          dead.push_back(dead_at);
          live.push_back(live_at);
        }
      json["boundary"] = {{"edge", edges},
                          {"held", held},
                          {"velocity", velocity},
                          {"dead", dead},
                          {"live", live}};
    }

    /** Coefficients of the stresses times r, (rr, zz, rz, tt) in Pa m, in the order of
     *  bernstein::functions_of_triangle(). */
    Json
    stresses_times_radius(const BoundScene &given, const Bound &bound)
    {
      const double unit   = given.units.stress * given.units.length;
      Json         stress = Json::array();
      for (unsigned int c = 0; c < given.triangles.cells.size(); ++c)
        {
          Json of_cell = Json::array();
          for (unsigned int i = 0; i < axisymmetric_stress::n; ++i)
            {
              const SpatialMandel &s =
                bound.stress[axisymmetric_stress::n * c + i];
              of_cell.push_back(
                {unit * s[0], unit * s[1], unit * s[2] / sqrt2, unit * s[3]});
            }
          stress.push_back(of_cell);
        }
      return stress;
    }

    /** Coefficients of u_r/r (1/s) and u_z (m/s). */
    Json
    axisymmetric_velocities(const BoundScene &given, const Bound &bound)
    {
      namespace space     = axisymmetric_velocity;
      const double unit   = given.units.velocity;
      Json         radial = Json::array(), axial = Json::array();
      for (unsigned int c = 0; c < given.triangles.cells.size(); ++c)
        {
          Json v = Json::array(), w = Json::array();
          for (const auto &a : bernstein::functions_of_triangle(space::order))
            v.push_back(unit / given.units.length *
                        bound.q[space::dof_of_v(c, a)]);
          for (const auto &a :
               bernstein::functions_of_triangle(space::order + 1))
            w.push_back(unit * bound.q[space::dof_of_w(c, a)]);
          radial.push_back(v);
          axial.push_back(w);
        }
      return {{"radial_over_radius", radial}, {"axial", axial}};
    }

    void
    write_axisymmetric_certificate(const std::string      &folder,
                                   const BoundScene       &given,
                                   const Bound            &bound,
                                   const CertificateClaim &claim)
    {
      const AxisymmetricScene scene(given);
      const bool is_reaction = given.factor == LoadFactor::velocity;
      Json       json        = claim.entries("limit analysis around an axis",
                                is_reaction ? 0. : bound.load,
                                is_reaction ? given.units.velocity : 0.);
      json["materials"]      = materials_with_strengths(
        given.scene, given.strengths, given.units.stress);
      add_mesh(given.triangles, json);
      add_loads_and_supports(scene, json);
      if (claim.is_lower)
        json["stress_times_radius"] = stresses_times_radius(given, bound);
      else
        json["velocity"] = axisymmetric_velocities(given, bound);
      claim.write(folder, json);
    }
  } // namespace

  void
  write_certificate(const std::string      &folder,
                    const BoundScene       &given,
                    const Bound            &bound,
                    const CertificateClaim &claim)
  {
    if (given.is_axisymmetric())
      return write_axisymmetric_certificate(folder, given, bound, claim);
    const bool         is_reaction = given.factor == LoadFactor::velocity;
    const BoundProblem problem     = lower_problem(given);
    Json               json        = claim.entries("plane limit analysis",
                              is_reaction ? 0. : bound.load,
                              is_reaction ? given.units.velocity : 0.);
    json["materials"]              = materials_of(given);
    json["obstacles"]              = obstacles_with_loads(given, problem);
    add_mesh(given.triangles, json);
    json["interfaces"] = interfaces_of(given);
    add_loads_and_supports(given, problem, json);
    if (claim.is_lower)
      add_stresses(given, bound, json);
    else
      add_velocities(given, bound, json);
    claim.write(folder, json);
  }
} // namespace geocone::GEOCONE_DIM
