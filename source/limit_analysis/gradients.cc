// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/base/constants.h>
#include <geocone/base/log.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/gradients.h>
#include <geocone/plane_bounds/bound_loads.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /** Derivatives of a point's dissipation with respect to its cone's k and cut_off, in
     *  which it is linear. */
    std::array<double, 2>
    rates_of_cone(const PointCone &cone, const Vector3d &e)
    {
      if (!cone.is_cut())
        return {{dissipation({cone.a, 1., cone.cut_off, cone.ellipse}, e), 0.}};
      return {
        {dissipation({cone.a, 1., 0.}, e), dissipation({cone.a, 0., 1.}, e)}};
    }

    /**
     * Powers of one bound at its fields, in units: of loads, and the dissipation per
     * given cohesion and tensile strength (Pa) and tan(phi). That of growing cohesion
     * and of obstacles is multiplied by their values.
     */
    struct Powers
    {
      struct OfMaterial
      {
        double cohesion = 0., growing = 0., tan_phi = 0., tension = 0.;
        Eigen::Vector2d ratios = {0., 0.}; ///< of strengths by direction
        double weight = 0.;
      };
      struct OfObstacle
      {
        double adhesion = 0., friction = 0., tension = 0.;
      };
      std::vector<OfMaterial> materials;
      std::vector<double>     tractions;
      std::vector<OfObstacle> obstacles;
      double                  others = 0.; ///< of all other loads
      double                  all    = 0.; ///< dissipation less dead loads
    };

    /** Adds the dissipation of the triangles. @param F by which strength is divided */
    void
    add_triangles(const BoundScene            &bound,
                  const BoundProblem          &problem,
                  const double                 F,
                  const std::vector<Vector3d> &s,
                  const std::vector<Vector3d> &e,
                  Powers                      &powers)
    {
      for (unsigned int p = 0; p < 3 * problem.n_triangles; ++p)
        {
          if (problem.B.is_removed(p))
            continue;
          const unsigned int m    = bound.triangles.material[p / 3];
          const PointCone   &cone = problem.cone[p];
          const auto [y, cut_off] = rates_of_cone(cone, e[p]);
          const double V = problem.volume[p], square = 1. - cone.a * cone.a;
          const double by = bound.scene.materials[m].is_reduced() ? F : 1.;
          const double per_unit  = V * sqrt2 / (by * bound.units.stress);
          Powers::OfMaterial &to = powers.materials[m];
          to.cohesion += per_unit * std::sqrt(square) * y;
          to.growing += V * y * (cone.k - bound.cones[m].k);
          if (cone.a > 0.)
            to.tan_phi += V * y * by_log_tan_phi(cone, s[p][0]) *
                          std::sqrt(square) / (cone.a * by);
          to.tension += per_unit * cut_off;
          if (!cone.ellipse.is_circle())
            to.ratios +=
              V * cone.k * cone.ellipse.dissipation_by_ratios(e[p].tail<2>());
        }
    }

    /** Adds the dissipation of the interfaces, whose cells follow the triangles. */
    void
    add_interfaces(const BoundScene            &bound,
                   const BoundProblem          &problem,
                   const std::vector<Vector3d> &s,
                   const std::vector<Vector3d> &e,
                   Powers                      &powers)
    {
      unsigned int p = 3 * problem.n_triangles;
      for (const Interface &interface : bound.interfaces)
        for (const Interface::Face &face : interface.faces)
          for (unsigned int i = 0; i < 3; ++i, ++p)
            {
              if (interface.obstacle < 0)
                continue;
              const PointCone    &cone = problem.cone[p];
              Powers::OfObstacle &of   = powers.obstacles[interface.obstacle];
              const double y = problem.volume[p] * rates_of_cone(cone, e[p])[0];
              (face.has_tangential ? of.adhesion : of.tension) += y * cone.k;
              if (face.has_tangential && face.has_normal)
                of.friction += y * s[p][0] * cone.a;
            }
    }

    /** Adds the power of the loads, live ones times the load.
     *  @param live_factor the load, over the work that it is normalised by */
    void
    add_loads(const BoundScene   &bound,
              const BoundProblem &problem,
              const BoundSide     side,
              const double        live_factor,
              const VectorXd     &q,
              Powers             &powers)
    {
      const Scene     &scene     = bound.scene;
      const Triangles &triangles = bound.triangles;
      powers.others = problem.dead.dot(q) + live_factor * problem.live.dot(q);
      const auto power = [&](const LoadFactor kind, const VectorXd &F) {
        const bool is_live =
          bound.factor == kind || bound.factor == LoadFactor::all;
        return (is_live ? live_factor : 1.) * F.dot(q);
      };
      VectorXd F(problem.n_dofs());
      for (unsigned int m = 0; m < powers.materials.size(); ++m)
        {
          F.setZero();
          for (unsigned int c = 0; c < triangles.cells.size(); ++c)
            if (triangles.material[c] == m)
              add_force_of_cell(bound, side, c, weight_of_cell(bound, c), F);
          powers.materials[m].weight = power(LoadFactor::weight, F);
          powers.others -= powers.materials[m].weight;
        }
      for (unsigned int i = 0; i < powers.tractions.size(); ++i)
        {
          F.setZero();
          add_tractions(bound, side, *scene.tractions.list[i], F);
          powers.tractions[i] = power(LoadFactor::tractions, F);
          powers.others -= powers.tractions[i];
        }
    }

    Powers
    powers_of(const SolvedBound &solved, const BoundSide side)
    {
      const BoundScene &bound = solved.scene;
      Powers            powers;
      powers.materials.resize(bound.scene.materials.size());
      powers.obstacles.resize(bound.scene.obstacles.list.size());
      powers.tractions.resize(bound.scene.tractions.list.size());
      if (!solved.side.bound.certified)
        return powers;
      const bool         is_lower = side == BoundSide::lower;
      const BoundProblem problem =
        is_lower ? lower_problem(bound) : upper_problem(bound);
      VectorXd q = is_lower ? solved.side.solution.q : solved.side.bound.q;
      // The dissipation of cut-offs is that of the whole rates.
      q.tail(problem.n_dofs() - problem.first_cut_dof).setZero();
      const auto &s = solved.side.solution.s;
      const auto  e = problem.B.rates(q);
      powers.all    = -problem.dead.dot(q);
      for (unsigned int p = 0; p < problem.first_cut_point(); ++p)
        if (!problem.B.is_removed(p))
          powers.all += problem.volume[p] * dissipation(problem.cone[p], e[p]);
      add_triangles(bound, problem, solved.F, s, e, powers);
      add_interfaces(bound, problem, s, e, powers);
      const double live_factor =
        problem.has_factor() ? powers.all / problem.live.dot(q) : 1.;
      add_loads(bound, problem, side, live_factor, q, powers);
      return powers;
    }

    /** Powers of a bound on the load of an axisymmetric body, in units. Those of
     *  strengths are multiplied by their values. */
    Powers
    axisymmetric_powers_of(const SolvedBound &solved, const BoundSide side)
    {
      const BoundScene       &bound = solved.scene;
      const AxisymmetricScene body(bound);
      Powers                  powers;
      powers.materials.resize(bound.scene.materials.size());
      powers.tractions.resize(bound.scene.tractions.list.size());
      if (!solved.side.bound.certified)
        return powers;
      const VectorXd &q =
        side == BoundSide::lower ? solved.side.solution.q : solved.side.bound.q;
      const ConicProblem forces = forces_of(body, side);
      powers.all                = -forces.dead.dot(q);
      for (unsigned int m = 0; m < powers.materials.size(); ++m)
        {
          const StrengthPower &power   = solved.side.strength_power[m];
          powers.materials[m].cohesion = power.cohesion;
          powers.materials[m].growing  = power.growth;
          powers.materials[m].tan_phi  = power.tan_phi;
          powers.all += power.cohesion + power.growth;
        }
      const double live_factor =
        forces.has_factor() ? powers.all / forces.live.dot(q) : 1.;
      powers.others = forces.dead.dot(q) + live_factor * forces.live.dot(q);
      const auto power_of = [&](const LoadFactor         kind,
                                const AxisymmetricScene &part) {
        const bool is_live =
          bound.factor == kind || bound.factor == LoadFactor::all;
        return (is_live ? live_factor : 1.) * forces_of(part, side).live.dot(q);
      };
      for (unsigned int m = 0; m < powers.materials.size(); ++m)
        {
          powers.materials[m].weight =
            power_of(LoadFactor::weight, body.with_weight_of(m));
          powers.others -= powers.materials[m].weight;
        }
      for (unsigned int i = 0; i < powers.tractions.size(); ++i)
        {
          powers.tractions[i] =
            power_of(LoadFactor::tractions,
                     body.with_traction(*bound.scene.tractions.list[i]));
          powers.others -= powers.tractions[i];
        }
      return powers;
    }

    /** Mean weight of a material per volume (N/m^3). */
    double
    mean_unit_weight(const BoundScene &bound, const unsigned int material)
    {
      const Triangles &triangles = bound.triangles;
      double           weight = 0., area = 0.;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        if (triangles.material[c] == material)
          {
            const double part =
              triangles.area(c) *
              (bound.is_axisymmetric() ? triangles.centre(c)[0] : 1.);
            weight += part * weight_of_cell(bound, c).norm();
            area += part;
          }
      return area > 0. ? weight / area * bound.units.stress / bound.units.length
                       : 0.;
    }

    /** The given strength of a material. */
    struct Strength
    {
      double cohesion, slope, tan_phi, tension;
      double multiple    = 0.;    ///< 1 where the cohesion is a formula
      bool   is_circular = false; ///< the cohesion is k of the circular cone

      Strength(const BoundScene &given, const unsigned int m)
      {
        if (given.is_axisymmetric())
          {
            const SpatialStrength &one     = given.strengths[m];
            const double           cos_phi = std::sqrt(1. - one.a * one.a);
            const double           unit =
              given.units.stress / (one.is_circular ? 1. : 2. * cos_phi);
            is_circular = one.is_circular;
            cohesion    = one.k * unit;
            slope       = one.growth.slope * unit;
            tan_phi     = is_circular ? 0. : one.a / cos_phi;
            tension     = infinite_tension;
            return;
          }
        const PointCone &cone    = given.cones[m];
        const double     cos_phi = std::sqrt(1. - cone.a * cone.a);
        const double     unit    = given.units.stress / sqrt2;
        cohesion                 = cone.k / cos_phi * unit;
        slope                    = given.growth[m].slope / cos_phi * unit;
        tan_phi                  = cone.a / cos_phi;
        tension                  = cone.cut_off * unit;
        multiple                 = given.enclosed.has(m) ? 1. : 0.;
      }
    };

    /** Collects gradients relative to the bounds, as the power of a parameter per unit
     *  of it over the whole power. */
    struct Collector
    {
      std::array<Powers, 2> of; ///< not certified: without power
      std::vector<Gradient> all;

      template <typename PowerOf>
      void
      add(const std::array<std::string, 3> &place,
          const std::string                &unit,
          const double                      value,
          const PowerOf                    &power_of)
      {
        constexpr double none     = std::numeric_limits<double>::quiet_NaN();
        Gradient         gradient = {place, unit, value, {}, {}};
        for (unsigned int i = 0; i < 2; ++i)
          {
            gradient.derivative[i] =
              of[i].all != 0. ? power_of(of[i]) / of[i].all : none;
            gradient.elasticity[i] = gradient.derivative[i] * value;
          }
        all.push_back(gradient);
      }
    };

    void
    add_material(const BoundScene &given, const unsigned int m, Collector &to)
    {
      const std::string &name = given.scene.materials.name(m);
      const Strength     strength(given, m);
      const bool         is_plane = !given.is_axisymmetric();
      if (strength.multiple > 0.)
        to.add({{"materials", name, "cohesion_formula"}},
               "times",
               strength.multiple,
               [&](const Powers &p) { return p.materials[m].growing; });
      else
        to.add({{"materials",
                 name,
                 strength.is_circular ? "strength_of_cone" : "cohesion"}},
               "Pa",
               strength.cohesion,
               [&](const Powers &p) {
                 return p.materials[m].cohesion /
                        (is_plane ? 1. : strength.cohesion);
               });
      if (strength.slope != 0.)
        to.add({{"materials", name, "cohesion_gradient"}},
               "Pa/m",
               strength.slope,
               [&](const Powers &p) {
                 return p.materials[m].growing / strength.slope;
               });
      if (const double tan_phi = strength.tan_phi; tan_phi > 0.)
        {
          const double phi  = std::atan(tan_phi) / radians(1.),
                       rate = (1. + tan_phi * tan_phi) * radians(1.);
          to.add({{"materials", name, "friction_angle"}},
                 "degree",
                 phi,
                 [&](const Powers &p) {
                   return p.materials[m].tan_phi * rate /
                          (is_plane ? 1. : tan_phi);
                 });
          for (double &one : to.all.back().elasticity)
            one *= tan_phi / (phi * rate);
        }
      if (std::isfinite(strength.tension))
        to.add({{"materials", name, "tensile_strength"}},
               "Pa",
               strength.tension,
               [&](const Powers &p) { return p.materials[m].tension; });
      if (is_plane && !given.cones[m].ellipse.is_circle())
        {
          const StrengthEllipse &ellipse = given.cones[m].ellipse;
          to.add({{"materials", name, "passive_strength_ratio"}},
                 "-",
                 2. * ellipse.compression - 1.,
                 [&](const Powers &p) { return p.materials[m].ratios[0]; });
          to.add({{"materials", name, "simple_shear_strength_ratio"}},
                 "-",
                 ellipse.shear,
                 [&](const Powers &p) { return p.materials[m].ratios[1]; });
        }
      if (const double weight = mean_unit_weight(given, m); weight > 0.)
        to.add(
          {{"materials", name, "unit_weight"}},
          "N/m3",
          weight,
          [&](const Powers &p) { return -p.materials[m].weight / weight; });
    }

    void
    add_obstacle(const Scene &scene, const unsigned int o, Collector &to)
    {
      const Obstacle     &obstacle = *scene.obstacles.list[o];
      const InterfaceLaw &law      = obstacle.law;
      const auto          add      = [&](const char  *parameter,
                           const char  *unit,
                           const double value,
                           const auto   member) {
        if (value > 0.)
          to.add(
            {{"obstacles", obstacle.name, parameter}},
            unit,
            value,
            [&](const Powers &p) { return p.obstacles[o].*member / value; });
      };
      using Of = Powers::OfObstacle;
      add("friction_coefficient", "-", law.friction, &Of::friction);
      add("adhesion", "Pa", law.adhesion, &Of::adhesion);
      if (!law.never_opens())
        add("tensile_strength", "Pa", law.tension, &Of::tension);
    }

    /** Gradients relative to the bounds of the load. */
    std::vector<Gradient>
    relative_gradients(const BoundScene  &given,
                       const SolvedBound &lower,
                       const SolvedBound &upper)
    {
      const Scene &scene = given.scene;
      const auto   powers =
        given.is_axisymmetric() ? axisymmetric_powers_of : powers_of;
      Collector to = {
        {{powers(lower, BoundSide::lower), powers(upper, BoundSide::upper)}},
        {}};
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        add_material(given, m, to);
      for (unsigned int i = 0; i < scene.tractions.list.size(); ++i)
        {
          const BoundaryCondition &load = *scene.tractions.list[i];
          if (const double largest = largest_traction(given, load);
              largest > 0.)
            to.add({{"tractions", load.name, "traction"}},
                   "Pa",
                   largest,
                   [&](const Powers &p) { return -p.tractions[i] / largest; });
        }
      for (unsigned int o = 0; o < scene.obstacles.list.size(); ++o)
        add_obstacle(scene, o, to);
      if (scene.water.acts() || !scene.obstacles.list.empty())
        to.add({{"others", "water_and_obstacles", "load"}},
               "-",
               1.,
               [](const Powers &p) { return -p.others; });
      return to.all;
    }
  } // namespace

  double
  by_log_tan_phi(const PointCone &cone, const double s_n)
  {
    // da = cos^3(phi) d tan(phi), and k is a constant times cos(phi).
    return cone.a * ((1. - cone.a * cone.a) * s_n - cone.a * cone.k);
  }

  std::vector<Gradient>
  gradients_of_load(const BoundScene  &given,
                    const SolvedBound &lower,
                    const SolvedBound &upper,
                    const double       load_unit)
  {
    std::vector<Gradient> all = relative_gradients(given, lower, upper);
    for (Gradient &one : all)
      {
        one.derivative[0] *= lower.side.bound.load * load_unit;
        one.derivative[1] *= upper.side.bound.load * load_unit;
      }
    return all;
  }

  std::vector<Gradient>
  gradients_of_safety(const BoundScene  &given,
                      const SolvedBound &lower,
                      const SolvedBound &upper)
  {
    std::vector<Gradient> all = relative_gradients(given, lower, upper);
    // -d ln lambda/d ln F: all strengths that are divided.
    std::array<double, 2> divided   = {{0., 0.}};
    const auto           &materials = given.scene.materials;
    for (const Gradient &one : all)
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (one.place[0] == "materials" && one.place[1] == materials.name(m) &&
            one.place[2] != "unit_weight" && one.unit != "-" &&
            materials[m].is_reduced())
          for (unsigned int i = 0; i < 2; ++i)
            divided[i] += one.elasticity[i];
    for (Gradient &one : all)
      for (unsigned int i = 0; i < 2; ++i)
        {
          one.derivative[i] *= (i == 0 ? lower : upper).F / divided[i];
          one.elasticity[i] /= divided[i];
        }
    return all;
  }

  Json
  topic_of(const std::vector<Gradient> &gradients)
  {
    const auto known = [](const double value) {
      return std::isfinite(value) ? Json(value) : Json();
    };
    Json topic = Json::object();
    for (const Gradient &one : gradients)
      topic[one.place[0]][one.place[1]][one.place[2]] = {
        {"value", one.value},
        {"unit", one.unit},
        {"lower", known(one.derivative[0])},
        {"upper", known(one.derivative[1])},
        {"elasticity_lower", known(one.elasticity[0])},
        {"elasticity_upper", known(one.elasticity[1])}};
    return topic;
  }

  std::string
  text_of(const std::vector<Gradient> &gradients, const std::string &bounded)
  {
    constexpr double least = 0.005; // of an elasticity that is shown
    struct Row
    {
      std::string           name;
      std::array<double, 2> elasticity;
      double                size;
    };
    const auto words = [](std::string name) {
      std::replace(name.begin(), name.end(), '_', ' ');
      return name;
    };
    std::vector<Row> rows;
    for (const Gradient &one : gradients)
      {
        double size = 0.;
        for (const double side : one.elasticity)
          size = std::max(size, std::isfinite(side) ? std::abs(side) : 0.);
        if (size >= least)
          rows.push_back(
            {(one.place[0] == "others" ? words(one.place[1]) : one.place[1]) +
               ": " +
               (one.place[2] == "friction_angle" ? "tan(friction angle)"
                                                 : words(one.place[2])),
             one.elasticity,
             size});
      }
    if (rows.empty())
      return "";
    std::stable_sort(rows.begin(), rows.end(), [](const Row &x, const Row &y) {
      return x.size > y.size;
    });
    std::string text = "  change of the " + bounded +
                       " in % where a parameter grows by 1 % "
                       "(lower bound, upper bound):";
    const auto shown = [](const double value) {
      return std::isfinite(value) ? format("%8.3f", value)
                                  : std::string("       ?");
    };
    for (const Row &row : rows)
      text += format("\n    %-40s", row.name.c_str()) +
              shown(row.elasticity[0]) + shown(row.elasticity[1]);
    return text;
  }
} // namespace geocone::GEOCONE_DIM
