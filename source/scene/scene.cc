// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/units.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/scene/scene.h>
#include <geocone/shapes/part_in_box.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Points on the part of the sides of a body, a box or a polygon, in the
     *  box of a condition. */
    std::vector<dealii::Point<dim>>
    places_held_by(const BoundaryCondition &condition, const Geometry &geometry)
    {
      using Point = dealii::Point<dim>;
      std::vector<Point> places;
      const auto         add = [&](const Point &a, const Point &b) {
        constexpr unsigned int n    = 8;
        const auto             box  = condition.wide_box();
        const auto             part = box ? part_in_box(*box, a, b)
                                                  : std::optional(std::array<Point, 2>{{a, b}});
        if (part)
          for (unsigned int i = 0; i < n; ++i)
            places.push_back((*part)[0] +
                             (i + 0.5) / n * ((*part)[1] - (*part)[0]));
      };
      if (geometry.outline.empty())
        return places;
      for (const auto &[name, id] : geometry.sides)
        if (!condition.is_on_side(name))
          continue;
        else if (dim == 2)
          {
            const auto [a, b] = geometry.side_ends(id);
            add(a, b);
          }
        else
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int end = 0; end < 2; ++end)
              if (name == side_of_box[d][end])
                {
                  // Lines across the face, from corner to corner.
                  Point a = geometry.outline[0], b = geometry.outline[1];
                  a[d] = b[d] = geometry.outline[end][d];
                  add(a, b);
                  std::swap(a[(d + 1) % dim], b[(d + 1) % dim]);
                  add(a, b);
                }
      return places;
    }

    /**
     * Evaluates the formulas of conditions and obstacles in each stage, just
     * after its beginning and, unless it may end at failure, in its middle and
     * just before its end, at points of a body with known sides, so that
     * undefined values are detected before anything is written.
     */
    void
    check_values(const Scene &scene)
    {
      const auto check = [&](const BoundaryCondition  &condition,
                             const dealii::Point<dim> &x,
                             const double              t) {
        if (!condition.holds_at(x))
          return;
        for (const auto &component : condition.components)
          if (component)
            component->value(x, t);
        condition.vector_on_side(x, dealii::Tensor<1, dim>(), t);
      };
      const auto check_at = [&](const Stage &stage, const double t) {
        for (const auto &obstacle : scene.obstacles.list)
          {
            obstacle->velocity(t);
            obstacle->load(t);
          }
        for (const auto *conditions :
             {&scene.dirichlet, &scene.tractions, &scene.absorbing})
          for (const auto &condition : conditions->list)
            if (condition->stages.include(stage.name))
              for (const dealii::Point<dim> &x :
                   places_held_by(*condition, scene.geometry))
                check(*condition, x, t);
      };
      double begin = 0.;
      try
        {
          for (const auto &stage : scene.loading.list)
            {
              std::vector<double> parts = {1e-6};
              if (!stage->until_failure)
                parts.insert(parts.end(), {0.5, 1. - 1e-6});
              for (const double part : parts)
                check_at(*stage, begin + part * stage->duration);
              begin += stage->duration;
            }
        }
      catch (const RunError &error)
        {
          throw InputError(error.what());
        }
    }

    /** Refuses tensile strengths, which steps know in the plane alone. */
    [[maybe_unused]] void
    refuse_tension(const Materials &materials)
    {
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (const auto given = materials.law(m).plane_strain_strength();
            given && std::isfinite(given->tension))
          throw InputError(
            "Materials/" + materials.name(m) + "/Tensile strength",
            given->tension,
            "none with steps in three dimensions",
            "set 'Analysis/Kind' to limit load or strength reduction, or "
            "take a plane scene");
    }
  } // namespace

  Scene::Scene(const ParameterFile &file)
    : geometry(file)
    , materials(file)
    , regions(materials.names())
    , water(file)
    , dirichlet(
        file,
        "Boundary conditions",
        "Velocity",
        "Prescribed velocity [m/s]",
        "free",
        "Names of the conditions with prescribed velocities, comma-separated; "
        "each has a subsection of its name. Later conditions override earlier "
        "ones at the same component of a node.")
    , tractions(
        file,
        "Tractions",
        "Traction",
        "Traction [Pa]",
        "none",
        "Names of the conditions with prescribed tractions, comma-separated; "
        "each has a subsection of its name. Tractions are added.")
    , absorbing(file,
                "Absorbing boundaries",
                "Incoming velocity",
                "Velocity [m/s] of the incoming wave (a free surface moves "
                "twice as much)",
                "0",
                "Names of absorbing boundaries (dashpots of Lysmer and "
                "Kuhlemeyer), comma-separated; each has a subsection of its "
                "name. For runs with inertia.")
    , obstacles(file)
    , contacts(file)
    , loading(file)
    , structures(file)
  {}

  void
  Scene::prepare()
  {
    geometry.prepare();
    materials.prepare();
    if constexpr (dim == 3)
      refuse_tension(materials);
    if (geometry.is_axisymmetric())
      materials.set_axisymmetric();
    std::vector<int>  stage_that_adds;
    std::vector<bool> is_made;
    for (const std::string &name : materials.names())
      {
        stage_that_adds.push_back(loading.stage_that_adds(name));
        is_made.push_back(loading.replaces_by(name));
      }
    loading.prepare(materials.names(), tractions.names());
    regions.prepare(geometry, is_made);
    prepare_weight();
    for (const auto &stage : loading.list)
      if (stage->scales("weight") && !gravity.acts())
        throw InputError("Loading/" + stage->name + "/Scaled loads",
                         "weight",
                         "names of tractions where there is no gravity",
                         "set 'Gravity/Acceleration', e.g. 0, -9.81");
    water.prepare_stages(loading);
    initial_velocity.prepare();
    initial_stress.prepare(gravity, geometry, regions, water, stage_that_adds);
    prepare_conditions();
    dirichlet.check_stages(loading.names());
    obstacles.prepare();
    contacts.prepare(materials.names());
    structures.prepare(geometry, loading.names());
    std::vector<std::string> observable = supports();
    std::sort(observable.begin(), observable.end());
    const auto twice = std::adjacent_find(observable.begin(), observable.end());
    if (twice != observable.end())
      throw InputError((obstacles.list.empty() ? "Contacts" : "Obstacles") +
                         std::string("/Names"),
                       *twice,
                       "other names than those of boundary conditions, "
                       "obstacles and contacts",
                       "all can be observed by name: rename one of them");
    observation.prepare(supports(), materials, gravity, loading.scales_loads());
    if (observation.reference_name == "Prandtl")
      geometry.refuse_axis("'Observation/Reference' = Prandtl",
                           "it is the load of a strip; set it to none or to "
                           "the load of the round footing (N)");
    check_values(*this);
  }

  void
  Scene::prepare_conditions()
  {
    for (BoundaryConditions *const conditions :
         {&dirichlet, &tractions, &absorbing})
      {
        conditions->prepare();
        for (const auto &condition : conditions->list)
          condition->replace_groups(geometry.sides_of_hole);
      }
  }

  void
  Scene::prepare_weight()
  {
    gravity.prepare();
    materials.set_gravity(
      gravity.at(std::numeric_limits<double>::max()).norm());
    water.prepare(gravity, geometry);
  }

  double
  Scene::density(const unsigned int material, const dealii::Point<dim> &x) const
  {
    const ConstitutiveLaw &law = materials.law(material);
    return law.saturated_density() > law.density() && water.pressure(x) > 0.
             ? law.saturated_density()
             : law.density();
  }

  namespace
  {
    /** gamma H of a material (Pa), with its density and the full height of the
     *  body. */
    double
    weight_of_column(const Scene                    &scene,
                     const unsigned int              material,
                     const dealii::BoundingBox<dim> &body)
    {
      return scene.materials.law(material).density() *
             scene.gravity.at(std::numeric_limits<double>::max()).norm() *
             body.side_length(1);
    }
  } // namespace

  std::string
  text_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body)
  {
    std::string text = "body";
    for (unsigned int d = 0; d < dim; ++d)
      text += format(d == 0 ? " %g" : " x %g", body.side_length(d));
    text += " m";
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      if (const auto strength = scene.materials.law(m).plane_strain_strength())
        {
          text += format("; %s: c = %g Pa, phi = %g",
                         scene.materials.name(m).c_str(),
                         strength->c,
                         strength->phi);
          if (const double weight = weight_of_column(scene, m, body);
              weight > 0.)
            text += format(", c/(gamma H) = %.3g", strength->c / weight);
        }
    return text;
  }

  namespace
  {
    /** Warnings of gravity and water that are probably in other units, or act
     *  upwards. */
    std::vector<std::string>
    warn_of_gravity(const Scene &scene)
    {
      constexpr double largest_g      = 3000.; // m/s^2, in a centrifuge
      const double     lightest_water = 500. / mass_unit(), // kg/m^3
        heaviest_water                = 4. * lightest_water;
      std::vector<std::string>     warnings;
      const dealii::Tensor<1, dim> gravity =
        scene.gravity.at(std::numeric_limits<double>::max());
      const double g = gravity.norm();
      if (g > largest_g)
        warnings.push_back(
          format("gravity is %g m/s^2: accelerations are in m/s^2", g));
      if (gravity[1] > 0.5 * g)
        warnings.push_back(
          format("gravity acts upwards, with %g m/s^2 in y: usually it is "
                 "negative, e.g. 0, -9.81",
                 gravity[1]));
      if (const double weight = scene.water.weight();
          scene.water.acts() && g > 0. &&
          (weight < lightest_water * g || weight > heaviest_water * g))
        warnings.push_back(
          format("water weighs %g N/m^3 ('Water/Unit weight'), where its "
                 "weight in this gravity is about %g N/m^3",
                 weight,
                 2. * lightest_water * g));
      return warnings;
    }
  } // namespace

  std::vector<std::string>
  warn_of_magnitudes(const Scene &scene, const dealii::BoundingBox<dim> &body)
  {
    constexpr double largest_body = 1e3, smallest_body = 1e-3; // m
    const double     lightest = 100. / mass_unit(), heaviest = 100. * lightest;
    const double     in_kilopascals = 500. / mass_unit(); // rather kPa than Pa
    constexpr double least_strength = 1e-5; // over gamma H, frictionless
    constexpr double least_angle    = 1.5;  // degrees; half of a right angle in
                                            // radians is less
    std::vector<std::string> warnings = warn_of_gravity(scene);
    double                   size     = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      size = std::max(size, body.side_length(d));
    if (scene.gravity.acts() &&
        !(size >= smallest_body && size <= largest_body))
      warnings.push_back(
        format("the body is %g m large: is it meant in other units? Lengths "
               "are in m",
               size));
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const std::string name    = scene.materials.name(m);
        const double      density = scene.materials.law(m).density();
        if (scene.gravity.acts() && density > 0. &&
            !(density >= lightest && density <= heaviest))
          warnings.push_back(
            format("the density of '%s' is %g kg/m^3", name.c_str(), density));
        if (scene.materials.law(m).saturated_density() > density &&
            !scene.water.acts())
          warnings.push_back("the saturated unit weight of '" + name +
                             "' is not used: there is no water");
        const auto strength = scene.materials.law(m).plane_strain_strength();
        if (!strength)
          continue;
        if (strength->phi > 0. && strength->phi < least_angle)
          warnings.push_back(
            format("the friction angle of '%s' is %g degrees: angles are in "
                   "degrees, not in radians",
                   name.c_str(),
                   strength->phi));
        const double weight = weight_of_column(scene, m, body);
        if (strength->phi == 0. && strength->gradient == 0. &&
            strength->c < least_strength * weight)
          warnings.push_back(
            format("the cohesion of '%s' is %g Pa, where a column of it as "
                   "high as the body weighs %.3g Pa: strengths are in Pa",
                   name.c_str(),
                   strength->c,
                   weight));
        else if (size >= 1. && weight > 0. && strength->gradient == 0. &&
                 strength->c > 0. && strength->c < in_kilopascals)
          warnings.push_back(
            format("the cohesion of '%s' is %g Pa: is it meant in "
                   "larger units? Strengths are in Pa",
                   name.c_str(),
                   strength->c));
        const std::string stiffness =
          ParameterFile::value("Materials/" + name + "/Young modulus");
        if (const double E = std::strtod(stiffness.c_str(), nullptr);
            E > 0. && E < strength->c)
          warnings.push_back(
            format("Young's modulus of '%s', %g Pa, is smaller "
                   "than its cohesion, %g Pa",
                   name.c_str(),
                   E,
                   strength->c));
      }
    return warnings;
  }

  std::vector<std::string>
  Scene::supports() const
  {
    std::vector<std::string> names;
    for (const auto &condition : dirichlet.list)
      names.push_back(condition->name);
    for (const auto &obstacle : obstacles.list)
      names.push_back(obstacle->name);
    for (const auto &pair : contacts.list)
      names.push_back(pair->name);
    return names;
  }

  std::string
  Scene::warn_of_effective_loads() const
  {
    return water.acts() && !observation.conditions.empty()
             ? "loads and reactions are those of effective stresses: "
               "the pressure of the water on supports comes on top"
             : "";
  }

  std::string
  Scene::warn_of_time_histories() const
  {
    for (const auto *conditions : {&dirichlet, &tractions, &absorbing})
      for (const auto &condition : conditions->list)
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto &component = condition->components[d])
            if (const double end = component->constant_from();
                end < (1. - 1e-9) * loading.duration())
              return format(
                "the record of '%s' ends at t = %g s with %g, which "
                "stays until the end of the loading, %g s",
                condition->name.c_str(),
                end,
                component->value({}, end),
                loading.duration());
    return "";
  }
} // namespace geocone::GEOCONE_DIM
