// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/text_of_place.h>
#include <geocone/bounds/facet_condition.h>
#include <geocone/laws/mohr_coulomb.h>
#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/materials/retention.h>
#include <geocone/mesh/empty_regions.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** @throws InputError if a rigid motion of the body is free
     *  @param problem of quadratic velocities, without structures
     *  @param ties anchors and struts, which hold the body at fixed points */
    void
    check_supports(const BoundScene                    &bound,
                   const BoundProblem                  &problem,
                   const std::vector<PlasticBars::Tie> &ties)
    {
      // Rigid motions of the prescribed dofs: two translations and a rotation.
      Eigen::Matrix3d  squares   = Eigen::Matrix3d::Zero();
      const Triangles &triangles = bound.triangles;
      // About the body's centre, since a rotation about a distant point resembles a
      // translation.
      const Point<dim> centre =
        dealii::BoundingBox<dim>(triangles.vertices).center();
      const auto hold = [&](const Point<dim> &x, const Tensor<1, dim> &n) {
        const Tensor<1, dim>  arm = x - centre;
        const Eigen::Vector3d row(
          n[0], n[1], (arm[0] * n[1] - arm[1] * n[0]) / bound.units.length);
        squares += row * row.transpose();
      };
      const auto add = [&](const unsigned int node, const Point<dim> &x) {
        for (unsigned int d = 0; d < dim; ++d)
          if (problem.is_prescribed[dim * node + d])
            hold(x, Point<dim>::unit_vector(d));
      };
      std::vector<bool> is_used(triangles.vertices.size(), false);
      for (const auto &cell : triangles.cells)
        for (const unsigned int v : cell)
          is_used[v] = true;
      for (unsigned int v = 0; v < triangles.vertices.size(); ++v)
        if (is_used[v])
          add(v, triangles.vertices[v]);
      for (unsigned int e = 0; e < triangles.edges.size(); ++e)
        {
          const auto       &ends = triangles.edges[e].vertices;
          const Point<dim> &a    = triangles.vertices[ends[0]],
                           &b    = triangles.vertices[ends[1]];
          add(triangles.vertices.size() + e, Point<dim>(a + (b - a) / 2.));
        }
      for (const Interface &interface : bound.interfaces)
        for (const unsigned int v :
             triangles.edges[interface.held.edge].vertices)
          if (interface.obstacle < 0 ||
              !bound.scene.obstacles.list[interface.obstacle]->is_free())
            for (const Interface::Face &face : interface.faces)
              {
                const Tensor<1, dim> &n = interface.normal;
                if (face.has_normal)
                  hold(triangles.vertices[v], n);
                if (face.has_tangential)
                  hold(triangles.vertices[v], Tensor<1, dim>({-n[1], n[0]}));
              }
      for (const PlasticBars::Tie &tie : ties)
        if (const auto &[first, last] = tie.vertices; first < 0 || last < 0)
          hold(triangles.vertices[std::max(first, last)], tie.along);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
      if (solver.eigenvalues()[0] > 1e-10 * solver.eigenvalues()[2])
        return;
      const Eigen::Vector3d free = solver.eigenvectors().col(0);
      throw InputError(
        "Boundary conditions/Names",
        "conditions that leave a rigid motion free",
        "supports that hold the body against translation and rotation",
        std::string("nothing resists a ") +
          (std::abs(free[2]) > 0.1   ? "rotation"
           : std::abs(free[0]) > 0.7 ? "translation along x"
           : std::abs(free[1]) > 0.7 ? "translation along y"
                                     : "translation") +
          " of the body, so no load has a limit: hold another side");
    }

    /** @throws InputError if a fixed vertex is in the way of an obstacle
     *  @param problem of quadratic velocities */
    void
    check_ways(const BoundScene &bound, const BoundProblem &problem)
    {
      const Triangles &triangles = bound.triangles;
      for (const Interface &interface : bound.interfaces)
        for (const unsigned int v :
             triangles.edges[interface.held.edge].vertices)
          {
            if (interface.obstacle < 0)
              continue;
            const Obstacle &obstacle =
              *bound.scene.obstacles.list[interface.obstacle];
            if (obstacle.is_free())
              continue;
            const Tensor<1, dim> V       = obstacle.velocity(0.).centre;
            double               u_N     = 0.;
            bool                 is_free = false;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double n = interface.normal[d];
                if (std::abs(n) < 1e-9)
                  continue;
                is_free = is_free || !problem.is_prescribed[dim * v + d];
                u_N +=
                  n * (problem.prescribed[dim * v + d] * bound.units.velocity -
                       V[d]);
              }
            if (!is_free && u_N < -1e-9 * bound.units.velocity)
              throw InputError(
                obstacle.parameter("Velocity x"),
                dealii::Patterns::Tools::to_string(V),
                "a motion that the body can yield to",
                format("the body is held at (%g, %g), where the obstacle "
                       "touches it: let it slide there; a rough side can be an "
                       "obstacle, too, with 'Friction coefficient' = tan(phi)",
                       triangles.vertices[v][0],
                       triangles.vertices[v][1]));
          }
    }

    /** Strengths of a material by direction. @throws InputError beside structures */
    StrengthEllipse
    ellipse_of(const Scene &scene, const unsigned int material)
    {
      const auto *const law =
        dynamic_cast<const MohrCoulomb *>(&scene.materials[material]);
      if (law == nullptr || !law->undrained_anisotropy().acts())
        return {};
      if (!scene.structures.list.empty())
        throw InputError("Structures/Names",
                         scene.structures.list.front()->name,
                         "none in soil whose strength depends on the direction",
                         "leave the ratios of strength of '" +
                           scene.materials.name(material) + "' out");
      return law->undrained_anisotropy().ellipse();
    }
  } // namespace

  void
  BoundedLoad::prepare(const Scene &scene, const Triangles &triangles)
  {
    take_strengths(scene);
    choose(prescribed_velocity(scene, triangles), scene.gravity.acts());
    refuse_pore_pressures(scene);
    check_loads(scene, triangles);
  }

  void
  BoundedLoad::prepare_reduction(const Scene       &scene,
                                 const Triangles   &triangles,
                                 const std::string &kind)
  {
    take_strengths(scene);
    check_reducible(scene, strengths);
    choose_all(prescribed_velocity(scene, triangles).has_value(), kind);
    if (!scene.geometry.is_axisymmetric() &&
        std::all_of(flow_cones.begin(),
                    flow_cones.end(),
                    [](const FlowCone &cone) { return cone.k == 0.; }) &&
        std::all_of(growth.begin(),
                    growth.end(),
                    [](const auto &more) { return more.slope == 0.; }) &&
        std::none_of(formulas.begin(), formulas.end(), [](const auto &one) {
          return one.has_value();
        }))
      throw InputError("Materials/" + scene.materials.name(0) + "/Cohesion",
                       0,
                       "> 0 Pa for some material where the strength is reduced",
                       "without cohesion loads have no factor: give a small "
                       "one, e.g. a thousandth of the weight times the height");
    check_loads(scene, triangles);
  }

  void
  BoundedLoad::prepare_tractions(const Scene       &scene,
                                 const Triangles   &triangles,
                                 const std::string &kind)
  {
    take_strengths(scene);
    choose_tractions(prescribed_velocity(scene, triangles).has_value(), kind);
    refuse_pore_pressures(scene);
    check_loads(scene, triangles);
  }

  void
  BoundedLoad::check_strength(const Scene     &scene,
                              const Triangles &triangles) const
  {
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        const Material     &law = scene.materials[triangles.material[c]];
        std::vector<double> history(law.n_history());
        for (const unsigned int v : triangles.cells[c])
          law.initialise_at(triangles.vertices[v], history.data());
      }
  }

  void
  BoundedLoad::check_loads(const Scene &scene, const Triangles &triangles)
  {
    std::vector<unsigned int> n_cells(scene.materials.size());
    for (const unsigned int material : triangles.material)
      ++n_cells[material];
    refuse_empty_regions(scene, n_cells);
    refuse_cut_cells(scene, triangles);
    if (scene.geometry.is_axisymmetric())
      return check_axisymmetric_loads(scene, triangles);
    check_strength(scene, triangles);
    choose_units(scene, triangles);
    BoundScene bound = on(scene, triangles);
    const auto ties  = bound.bars.ties;
    bound.bars       = {}; // others only tie parts of the body together
    const BoundProblem problem = upper_problem(bound);
    check_supports(bound, problem, ties);
    check_ways(bound, problem);
    if (!is_reaction() && !may_vanish && !problem.has_factor())
      refuse_zero_load();
  }

  void
  BoundedLoad::check_axisymmetric_loads(const Scene     &scene,
                                        const Triangles &triangles)
  {
    double area  = 0.;
    units.stress = 0.;
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        area += triangles.area(c);
        for (const unsigned int v : triangles.cells[c])
          units.stress = std::max(
            units.stress,
            positive_strength(
              scene, strengths, triangles.material[c], triangles.vertices[v]));
      }
    units.length     = std::sqrt(area) / 8.;
    unit_of_reaction = scene.geometry.unit(unit_of_reaction);
    if (is_reaction()) // of the whole body, 2 pi radians
      load_unit = 2. * M_PI * units.stress * units.length * units.length *
                  std::abs(scene.observation.factor);
    const BoundScene        bound = on(scene, triangles);
    const AxisymmetricScene body(bound);
    body.check_support();
    if (!is_reaction() && !body.has_live_load())
      refuse_zero_load();
  }

  void
  BoundedLoad::take_strengths(const Scene &scene)
  {
    strengths.clear();
    less_dilatant = false;
    if (!scene.geometry.is_axisymmetric())
      return take_cones(scene);
    strengths = spatial_strengths(scene);
    for (const SpatialStrength &one : strengths)
      less_dilatant = less_dilatant || !one.is_associated;
  }

  void
  BoundedLoad::take_cones(const Scene &scene)
  {
    scene.materials.check_closed_form("limit load");
    flow_cones.clear();
    ellipses.clear();
    growth.clear();
    formulas.clear();
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const auto        cone = scene.materials[m].initial_cone();
        const std::string parameter =
          "Materials/" + scene.materials.name(m) + "/Type";
        if (!cone)
          throw InputError(
            parameter,
            ParameterFile::value(parameter),
            "Mohr-Coulomb | Tresca where loads are bounded",
            "bounds are those of laws of the plane; what cannot "
            "yield carries any load: leave it out of the domain");
        if (scene.materials[m].hardens())
          throw InputError(parameter,
                           "a law that hardens",
                           "Mohr-Coulomb | Tresca where loads are bounded",
                           "take the strength that counts, initial or final");
        const std::string formula = scene.materials[m].strength_formula();
        if (formula == "Cohesion ratio")
          throw InputError(
            "Materials/" + scene.materials.name(m) + "/" + formula,
            ParameterFile::value("Materials/" + scene.materials.name(m) + "/" +
                                 formula),
            "a 'Cohesion gradient' or 'Cohesion formula' where "
            "loads are bounded",
            "the initial stresses of steps are unknown here: "
            "give the cohesion that they lead to");
        if (cone->cut_off == 0.)
          throw InputError("Materials/" + scene.materials.name(m) +
                             "/Tensile strength",
                           0,
                           "none, or > 0 Pa where loads are bounded",
                           "free surfaces would be at their strength whatever "
                           "the load: give a small one, e.g. a hundredth of "
                           "the cohesion");
        if (!scene.structures.list.empty() &&
            scene.materials.law(m).retention().adds_strength())
          throw InputError("Structures/Names",
                           scene.structures.list.front()->name,
                           "none in soil with suction where loads are bounded",
                           "the strength by suction between structures and "
                           "soil is unknown: leave the suction out");
        flow_cones.push_back(*cone);
        ellipses.push_back(ellipse_of(scene, m));
        growth.push_back(scene.materials[m].growth());
        formulas.emplace_back();
        if (!formula.empty())
          {
            formulas.back().emplace(ParameterFile::value(
              "Materials/" + scene.materials.name(m) + "/" + formula));
            flow_cones.back().k = 0.; // given by the formula alone
          }
        less_dilatant = less_dilatant || cone->b < cone->a * (1. - 1e-12);
      }
  }

  std::optional<Tensor<1, dim>>
  BoundedLoad::prescribed_velocity(const Scene     &scene,
                                   const Triangles &triangles) const
  {
    std::optional<Tensor<1, dim>> velocity;
    const std::string             one_velocity =
      "one velocity for all that is pushed, with 'Analysis/Kind' = limit load";
    const std::string remedy = "the bounded load is the reaction to one "
                               "translation";
    for (const auto &obstacle : scene.obstacles.list)
      if (obstacle->velocity(0.).rotation.norm() != 0.)
        throw InputError(obstacle->parameter("Angular velocity"),
                         obstacle->velocity(0.).rotation[0],
                         "0 or free, with 'Analysis/Kind' = limit load",
                         remedy);
      else if (const Tensor<1, dim> own = obstacle->velocity(0.).centre;
               own.norm() > 0.)
        {
          if (velocity && (*velocity - own).norm() > 1e-9 * own.norm())
            throw InputError(obstacle->parameter("Velocity x"),
                             dealii::Patterns::Tools::to_string(own[0]),
                             one_velocity,
                             remedy);
          velocity = own;
        }
    for (const auto &condition : scene.dirichlet.list)
      for (const auto &held : triangles.held_edges(*condition))
        {
          std::array<Point<dim>, dim> ends;
          for (unsigned int i = 0; i < dim; ++i)
            ends[i] =
              triangles.vertices[triangles.edges[held.edge].vertices[i]];
          Tensor<1, dim> here;
          for (unsigned int d = 0; d < dim; ++d)
            if (condition->components[d])
              here[d] = prescribed_on_facet(*condition, d, ends);
          if (condition->normal &&
              prescribed_on_facet(*condition, dim, ends) != 0.)
            throw InputError(condition->parameter("Velocity normal"),
                             condition->formula(dim),
                             "0 with 'Analysis/Kind' = limit load",
                             "push by Velocity x or y");
          if (here.norm() == 0.)
            continue;
          if (velocity && (*velocity - here).norm() > 1e-9 * here.norm())
            throw InputError(
              condition->parameter(here[1] != 0. ? "Velocity y" : "Velocity x"),
              condition->formula(here[1] != 0. ? 1 : 0),
              one_velocity,
              remedy);
          velocity = here;
        }
    return velocity;
  }

  void
  BoundedLoad::choose_units(const Scene &scene, const Triangles &triangles)
  {
    double area = 0., height = 0.;
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        area += triangles.area(c);
        for (const unsigned int v : triangles.cells[c])
          {
            lowest  = std::min(lowest, triangles.vertices[v][1]);
            highest = std::max(highest, triangles.vertices[v][1]);
          }
      }
    height       = highest - lowest;
    units.length = std::sqrt(area) / 8.;
    units.stress = 0.;
    for (unsigned int m = 0; m < flow_cones.size(); ++m)
      for (const double y : {lowest, highest})
        units.stress =
          std::max(units.stress, flow_cones[m].k + growth[m].at(y));
    const EnclosedCohesion enclosed = enclosed_cohesion(scene, triangles);
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      if (const unsigned int m = triangles.material[c]; enclosed.has(m))
        for (const double cohesion : enclosed.cohesion[c].above)
          units.stress =
            std::max(units.stress, enclosed.k_per_cohesion[m] * cohesion);
    double dead = stress_of_weight(scene, height); // the largest dead load
    for (const auto &load : scene.tractions.list)
      for (const auto &held : triangles.held_edges(*load))
        for (const unsigned int v : triangles.edges[held.edge].vertices)
          {
            const Point<dim> &x = triangles.vertices[v];
            for (unsigned int d = 0; d < dim; ++d)
              if (load->components[d])
                dead =
                  std::max(dead, std::abs(load->components[d]->value(x, 0.)));
            for (const auto *along : {&load->normal, &load->tangential})
              if (*along)
                dead = std::max(dead, std::abs((*along)->value(x, 0.)));
          }
    if (units.stress == 0.)
      {
        if (dead == 0.)
          throw InputError("Materials/" + scene.materials.name(0) + "/Cohesion",
                           0,
                           "> 0 Pa where there is no weight or load",
                           "nothing resists in this scene");
        units.stress = dead / 8.;
      }
    if (!scene.structures.list.empty())
      add_units_of_structures(scene.structures, dead);
    if (is_reaction())
      load_unit =
        units.stress * units.length * std::abs(scene.observation.factor);
  }

  void
  BoundedLoad::add_units_of_structures(const Structures &structures,
                                       const double      dead)
  {
    // Forces in structures exceed the strength of weak soil by orders of magnitude. The
    // largest strengths are as good as unlimited.
    units.stress      = std::max(units.stress, dead);
    const double most = 1e2 * units.stress;
    for (const auto &structure : structures.list)
      {
        double length = 0.;
        for (std::size_t i = 1; i < structure->points.size(); ++i)
          length += structure->points[i].distance(structure->points[i - 1]);
        const auto [least, greatest] = structure->axial_strength();
        for (const double strength :
             {-least / length,
              greatest / length,
              structure->is_plate()
                ? structure->moment_capacity() / (length * length)
                : 0.})
          if (strength < most)
            units.stress = std::max(units.stress, strength);
      }
  }

  EnclosedCohesion
  BoundedLoad::enclosed_cohesion(const Scene     &scene,
                                 const Triangles &triangles) const
  {
    EnclosedCohesion enclosed;
    if (std::none_of(formulas.begin(), formulas.end(), [](const auto &one) {
          return one.has_value();
        }))
      return enclosed;
    for (unsigned int m = 0; m < formulas.size(); ++m)
      {
        const double a = flow_cones[m].a;
        enclosed.k_per_cohesion.push_back(
          formulas[m] ? sqrt2 * std::sqrt(1. - a * a) : 0.);
      }
    enclosed.cohesion.resize(triangles.cells.size());
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        const unsigned int m = triangles.material[c];
        if (!formulas[m])
          continue;
        const auto &corners = triangles.cells[c];
        enclosed.cohesion[c] =
          formulas[m]->on_simplex({{triangles.vertices[corners[0]],
                                    triangles.vertices[corners[1]],
                                    triangles.vertices[corners[2]]}});
        for (unsigned int i = 0; i < 3; ++i)
          if (!(enclosed.cohesion[c].below[i] > 0.) ||
              !std::isfinite(enclosed.cohesion[c].above[i]))
            {
              const std::string parameter =
                "Materials/" + scene.materials.name(m) + "/Cohesion formula";
              throw InputError(
                parameter,
                ParameterFile::value(parameter),
                "a formula that interval arithmetic bounds, above 0 Pa, where "
                "loads are bounded; in the triangle at (" +
                  text_of_place(triangles.centre(c)) +
                  format(") it is between %g and %g Pa",
                         enclosed.cohesion[c].below[i],
                         enclosed.cohesion[c].above[i]),
                "limit it from below, e.g. max(1000, ...), and write each "
                "coordinate as seldom as possible; smaller cells bound it more "
                "closely");
            }
      }
    return enclosed;
  }

  BoundScene
  BoundedLoad::on(const Scene &scene, const Triangles &triangles) const
  {
    BoundScene bound = {scene,
                        triangles,
                        factor(),
                        units,
                        {},
                        interfaces(scene, triangles),
                        {},
                        enclosed_cohesion(scene, triangles),
                        {},
                        {}};
    for (double &k : bound.enclosed.k_per_cohesion)
      k /= units.stress;
    for (unsigned int m = 0; m < flow_cones.size(); ++m)
      {
        bound.cones.push_back({flow_cones[m].a,
                               flow_cones[m].k / units.stress,
                               flow_cones[m].cut_off / units.stress,
                               ellipses[m]});
        bound.growth.push_back(
          {growth[m].slope / units.stress, growth[m].level});
      }
    for (SpatialStrength one : strengths)
      {
        one.scale(units.stress);
        bound.strengths.push_back(one);
      }
    std::vector<bool> is_frictional;
    for (const FlowCone &cone : flow_cones)
      is_frictional.push_back(cone.a > 0.);
    bound.bars = PlasticBars(scene, triangles, bound.interfaces, is_frictional);
    return bound;
  }

  BoundScene
  BoundedLoad::reduced(BoundScene bound, const double F) const
  {
    const Materials &materials = bound.scene.materials;
    for (unsigned int m = 0; m < bound.strengths.size(); ++m)
      if (materials[m].is_reduced())
        bound.strengths[m].reduce(F);
    for (unsigned int m = 0; m < flow_cones.size(); ++m)
      if (materials[m].is_reduced())
        {
          const double a = flow_cones[m].a, cos_phi = std::sqrt(1. - a * a);
          bound.change(m, a / cos_phi / F, 1. / cos_phi / F, 1. / F);
        }
    return bound;
  }

  BoundScene
  BoundedLoad::by_davis(BoundScene         bound,
                        const double       F,
                        const DavisVariant variant) const
  {
    for (unsigned int m = 0; m < flow_cones.size(); ++m)
      {
        const FlowCone &cone   = flow_cones[m];
        const double    by     = bound.scene.materials[m].is_reduced() ? F : 1.;
        const auto      cosine = [](const double sine) {
          return std::sqrt(1. - sine * sine);
        };
        const auto reduced_sine = [&](const double sine) {
          return sine / std::hypot(by * cosine(sine), sine);
        };
        double a = cone.a, b = cone.b;
        if (variant != DavisVariant::A)
          a = reduced_sine(a);
        if (variant == DavisVariant::B)
          b = reduced_sine(b);
        b                 = std::min(a, b);
        const double part = cosine(a) * cosine(b) / (1. - a * b) / by;
        bound.change(
          m, part * cone.a / cosine(cone.a), part / cosine(cone.a), 1. / by);
      }
    return bound;
  }
} // namespace geocone::GEOCONE_DIM
