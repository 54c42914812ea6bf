// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/units.h>
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
        condition.vector_at(x, dealii::Tensor<1, dim>(), t);
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

    /** Refuses free upright sides where pore pressures follow from the soil
     *  columns: they are not zero there, and would support the side as those of
     *  free water. Sides that an obstacle or another body can hold, and tied
     *  ones, are not checked. */
    void
    refuse_free_upright_sides(const Scene &scene)
    {
      const Geometry &geometry = scene.geometry;
      if (!scene.water.scales_with_weight() || scene.has_contact() ||
          !ParameterFile::value("Discretisation/Tied sides").empty())
        return;
      const auto check = [&](const std::string        &name,
                             const unsigned int        normal,
                             const dealii::Point<dim> &foot) {
        for (const auto *conditions : {&scene.dirichlet, &scene.tractions})
          for (const auto &condition : conditions->list)
            if (condition->is_on_side(name) &&
                (condition->components[normal] || condition->normal))
              return;
        throw InputError(
          "Water/Pore pressure ratio",
          ParameterFile::value("Water/Pore pressure ratio"),
          "0 with a free upright side, '" + name + "'",
          format("pore pressures of up to %.3g Pa would support it as those of "
                 "free water: prescribe its normal velocity or a traction, or "
                 "incline it over a small distance",
                 scene.water.pressure(foot)));
      };
      const auto [low, high] = geometry.bounding_box();
      for (const auto &[name, id] : geometry.sides)
        if constexpr (dim == 2)
          {
            const auto [a, b] = geometry.side_ends(id);
            if (std::abs(a[0] - b[0]) < geometry.rounding() &&
                !(geometry.is_axisymmetric() && a[0] < geometry.rounding()))
              check(name, 0, a[1] < b[1] ? a : b);
          }
        else
          for (const unsigned int d : {0, 2})
            if (name == side_of_box[d][0] || name == side_of_box[d][1])
              check(name, d, low);
    }

    /** Gives tractions of the pore pressure the field of the scene's water.
     *  @throws InputError where there is none, or it is not known */
    void
    give_pore_pressures(Scene &scene)
    {
      const Water &water = scene.water;
      for (const auto &load : scene.tractions.list)
        {
          if (!load->is_pore_pressure())
            continue;
          if (!water.acts())
            throw InputError(load->parameter("Traction normal"),
                             load->formula(dim),
                             "a formula where there is no water",
                             "give its pressures by 'Water' or 'Seepage'");
          if (water.varies_in_cells() &&
              ParameterFile::value("Discretisation/Method") != "FEM")
            throw InputError(load->parameter("Traction normal"),
                             load->formula(dim),
                             "a formula where the body moves through pressures "
                             "that are known within its start alone",
                             "give the pressures by 'Water/Table', or set "
                             "'Discretisation/Method' = FEM");
          for (const auto &stage : scene.loading.list)
            if (stage->scales(load->name))
              throw InputError("Loading/" + stage->name + "/Scaled loads",
                               load->name,
                               "loads other than pore pressures",
                               "scale the tractions of other conditions");
          load->normal->set_field(
            [&water](const dealii::Point<dim> &x, const double t) {
              return water.pressure(x, t);
            });
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
    give_pore_pressures(*this);
    refuse_free_upright_sides(*this);
  }

  void
  Scene::prepare_weight()
  {
    gravity.prepare();
    materials.set_gravity(
      gravity.at(std::numeric_limits<double>::max()).norm());
    water.prepare(gravity, geometry, regions, materials);
  }

  double
  Scene::density(const unsigned int material, const dealii::Point<dim> &x) const
  {
    const ConstitutiveLaw &law = materials.law(material);
    return law.saturated_density() > law.density() && water.saturates(x)
             ? law.saturated_density()
             : law.density();
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
    const double full = gravity.at(std::numeric_limits<double>::max()).norm(),
                 last = gravity.at(loading.duration()).norm();
    if (last < (1. - 1e-9) * full)
      return format("gravity grows to %.3g of its value by the end of the "
                    "loading, %g s: 'Gravity/Ramp duration' is longer",
                    last / full,
                    loading.duration());
    for (const auto *conditions : {&dirichlet, &tractions, &absorbing})
      for (const auto &condition : conditions->list)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto &component = condition->components[d];
            const auto  record =
              component ? component->recorded() : std::nullopt;
            if (!record)
              continue;
            const auto [begin, end] = *record;
            if (begin >= loading.duration())
              return format("the record of '%s' begins at t = %g s, when the "
                            "loading has ended: its first value, %g, acts in "
                            "all steps",
                            condition->name.c_str(),
                            begin,
                            component->value({}, begin));
            if (const double last = component->value({}, end);
                last != 0. && end < (1. - 1e-9) * loading.duration())
              return format(
                "the record of '%s' ends at t = %g s with %g, which "
                "stays until the end of the loading, %g s",
                condition->name.c_str(),
                end,
                last,
                loading.duration());
          }
    return "";
  }
} // namespace geocone::GEOCONE_DIM
