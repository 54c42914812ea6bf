// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/functions/formula.h>
#include <geocone/scene/initial_state.h>
#include <geocone/scene/water.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_initial_state[] = {
      {"Initial stress/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Initial velocity/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Initial stress/Stress xx",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress yy",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress xy",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/Stress zz",
       "Initial stress/Type",
       {"given"},
       "Initial stress/Of added materials"},
      {"Initial stress/K0",
       "Initial stress/Type",
       {"geostatic"},
       "Initial stress/Of added materials"},
      {"Materials/*/K0",
       "Initial stress/Type",
       {"geostatic"},
       "Initial stress/Of added materials"},
      {"Initial stress/Surface level", "Initial stress/Type", {"geostatic"}},
      {"Initial stress/Surcharge", "Initial stress/Type", {"geostatic"}}};
  } // namespace

  namespace
  {
    /** Prepares a formula of the initial state, which is independent of
     *  time. */
    void
    prepare_initial(Expression        &formula,
                    const std::string &text,
                    const std::string &parameter)
    {
      check_formula(text, parameter, FormulaVariables::place);
      formula.prepare(text, parameter);
    }

    /** Parameter name of a component of a given initial stress. */
    std::string
    name_of_stress(const unsigned int component)
    {
      return std::string("Stress ") + tensor_component[component];
    }
  } // namespace

  InitialVelocity::InitialVelocity()
    : dealii::ParameterAcceptor("/Initial velocity")
  {
    texts.fill("0");
    for (unsigned int c = 0; c < dim; ++c)
      add_parameter(std::string("Velocity ") + coordinate[c],
                    texts[c],
                    std::string("Initial velocity [m/s] as a formula in ") +
                      coordinates + " (m). Only for bodies with inertia.");
  }

  void
  InitialVelocity::prepare()
  {
    for (unsigned int c = 0; c < dim; ++c)
      prepare_initial(components[c],
                      texts[c],
                      std::string("Initial velocity/Velocity ") +
                        coordinate[c]);
  }

  dealii::Tensor<1, dim>
  InitialVelocity::at(const dealii::Point<dim> &x) const
  {
    dealii::Tensor<1, dim> v;
    if (is_given())
      for (unsigned int c = 0; c < dim; ++c)
        v[c] = components[c].value(x, 0.);
    return v;
  }

  dealii::Tensor<2, dim>
  InitialVelocity::gradient(const dealii::Point<dim> &x,
                            const double              size) const
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      {
        dealii::Tensor<1, dim> r;
        r[d]                                = 1e-4 * size;
        const dealii::Tensor<1, dim> change = at(x + r) - at(x - r);
        for (unsigned int c = 0; c < dim; ++c)
          gradient[c][d] = change[c] / (2. * r[d]);
      }
    return gradient;
  }

  bool
  InitialVelocity::is_given() const
  {
    return std::any_of(
      texts.begin(), texts.end(), [](const auto &text) { return text != "0"; });
  }

  InitialStress::InitialStress()
    : dealii::ParameterAcceptor("/Initial stress")
  {
    type.declare(*this, "Type", ": stress before the first step.");
    texts.fill("0");
    for (unsigned int i = 0; i < texts.size(); ++i)
      add_parameter(
        name_of_stress(i),
        texts[i],
        i == 0
          ? std::string(
              "For 'given': stress [Pa], tension positive, as a formula in ") +
              coordinates + " (m)."
          : std::string("Stress [Pa], as 'Stress xx'."));
    of_added.declare(
      *this,
      "Of added materials",
      ": stress of materials that stages add ('Added materials'). Geostatic: "
      "from the weight of the materials added at the same time, and K0.");
    if (dim == 2)
      add_parameter("Stress zz",
                    text_zz,
                    "For 'given': stress [Pa], as 'Stress xx'. Empty: equal to "
                    "'Stress xx'.");
    add_parameter(
      "K0",
      k0_text,
      "For 'geostatic': ratio of horizontal to vertical effective stress [-], "
      "> 0, or automatic: for each material Jaky's 1 - sin(phi), which is "
      "always admissible, or nu/(1 - nu) if it is linear elastic.");
    add_parameter("Surface level",
                  surface,
                  "For 'geostatic': level y of the ground surface [m].");
    add_parameter(
      "Surcharge",
      surcharge,
      "For 'geostatic': vertical pressure on the ground surface [Pa].");
  }

  bool
  InitialStress::adds(const Type one) const
  {
    return of_added == one &&
           std::any_of(stage_of.begin(), stage_of.end(), [](const int stage) {
             return stage >= 0;
           });
  }

  void
  InitialStress::prepare(const Gravity          &gravity,
                         const Geometry         &geometry,
                         const Regions          &regions,
                         const Water            &water_of_scene,
                         const std::vector<int> &stage_that_adds)
  {
    water    = water_of_scene.acts() ? &water_of_scene : nullptr;
    stage_of = stage_that_adds;
    if (type == Type::given || adds(Type::given))
      {
        for (unsigned int i = 0; i < texts.size(); ++i)
          prepare_initial(
            components[i], texts[i], "Initial stress/" + name_of_stress(i));
        if (!text_zz.empty())
          prepare_initial(component_zz, text_zz, "Initial stress/Stress zz");
      }
    if (type == Type::geostatic || adds(Type::geostatic))
      {
        prepare_k0();
        // The final value: a geostatic state assumes full gravity.
        g = -gravity.at(1e300)[1];
      }
    if (type == Type::geostatic)
      {
        check_geostatic("Initial stress/Type", type.word(), gravity, regions);
        check_level_ground(geometry, regions);
        check_level_water();
      }
    if (adds(Type::geostatic))
      {
        const std::string parameter = "Initial stress/Of added materials";
        if (geometry.shape == Geometry::Shape::file)
          throw InputError(parameter,
                           of_added.word(),
                           "zero | given, where the body is that of a file",
                           "give the stress by formulas");
        check_geostatic(parameter, of_added.word(), gravity, regions);
        top = geometry.bounding_box().second[1];
      }
  }

  void
  InitialStress::check_geostatic(const std::string &parameter,
                                 const std::string &word,
                                 const Gravity     &gravity,
                                 const Regions     &regions) const
  {
    const dealii::Tensor<1, dim> full = gravity.at(1e300);
    if (full[0] != 0. || full[1] > 0. || (dim == 3 && full[dim - 1] != 0.))
      throw InputError("Gravity/Acceleration",
                       dealii::Patterns::Tools::to_string(full),
                       "g_x = 0 and g_y <= 0 with a geostatic initial "
                       "stress",
                       "give the initial stress by formulas instead");
    if (regions.have_groups())
      throw InputError(parameter,
                       word,
                       "zero | given, where materials are found by their "
                       "region numbers",
                       "give the stress by formulas, or the materials by "
                       "region polygons");
  }

  void
  InitialStress::check_level_water() const
  {
    if (water != nullptr && !water->is_level())
      throw InputError("Initial stress/Type",
                       type.word(),
                       "zero | given where the water is not level",
                       "water that flows pushes the soil sideways: let gravity "
                       "and water build up the stress in a stage of their own, "
                       "or give one level in 'Water/Table'");
  }

  void
  InitialStress::prepare_k0()
  {
    k0.reset();
    if (k0_text == "automatic")
      return;
    // A number only: "0.5 or so" is rejected.
    try
      {
        k0 = dealii::Utilities::string_to_double(k0_text);
      }
    catch (const dealii::ExceptionBase &)
      {}
    if (!k0 || !(*k0 > 0.) || !std::isfinite(*k0))
      throw InputError("Initial stress/K0",
                       k0_text,
                       "automatic | a number > 0",
                       "automatic takes 1 - sin(phi) of each material");
  }

  namespace
  {
    /** Boundary of a property that holds at @p low but not at @p high. */
    template <typename Property>
    double
    border(double low, double high, const Property &holds)
    {
      for (unsigned int step = 0; step < 50; ++step)
        {
          const double half          = (low + high) / 2.;
          (holds(half) ? low : high) = half;
        }
      return high;
    }

    /** Part of a column of soil with one material. */
    struct Layer
    {
      unsigned int material;
      double       low, high; ///< y (m)
    };

    /** Layers above x up to y = top, from below. Layers thinner than a 400th of
     *  the height can be missed. */
    std::vector<Layer>
    column_above(const dealii::Point<dim> &x,
                 const double              top,
                 const Materials          &materials,
                 const Regions            &regions)
    {
      const auto material_at = [&](const double y) {
        dealii::Point<dim> place = x;
        place[1]                 = y;
        return regions.material_at(place);
      };
      const unsigned int n    = materials.size() == 1 ? 1 : 400;
      const double       part = (top - x[1]) / n;
      std::vector<Layer> layers;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double       middle   = x[1] + (i + 0.5) * part;
          const unsigned int material = material_at(middle);
          if (layers.empty())
            layers.push_back({material, x[1], top});
          else if (material != layers.back().material)
            {
              const double above =
                border(middle - part, middle, [&](const double y) {
                  return material_at(y) != material;
                });
              layers.back().high = above;
              layers.push_back({material, above, top});
            }
        }
      return layers;
    }

    /** Places of vertical lines through the body: two between vertices that
     *  are neighbours along x, and a lattice. */
    std::vector<dealii::Point<dim>>
    columns_of(const Geometry &geometry)
    {
      const auto [low, high]   = geometry.bounding_box();
      std::vector<double>    x = {low[0], high[0]};
      constexpr unsigned int n = dim == 2 ? 100 : 10;
      for (unsigned int i = 1; i < n; ++i)
        x.push_back(low[0] + (high[0] - low[0]) * i / n);
      for (const dealii::Point<dim> &vertex : geometry.outline)
        x.push_back(vertex[0]);
      std::sort(x.begin(), x.end());
      std::vector<dealii::Point<dim>> columns;
      for (std::size_t i = 1; i < x.size(); ++i)
        for (const double part : {0.1, 0.9})
          if (x[i] > x[i - 1] + geometry.rounding())
            for (unsigned int k = 0; k < (dim == 2 ? 1 : n); ++k)
              {
                dealii::Point<dim> place = low;
                place[0]                 = x[i - 1] + part * (x[i] - x[i - 1]);
                if (dim == 3)
                  place[dim - 1] +=
                    (high[dim - 1] - low[dim - 1]) * (k + 0.5) / n;
                columns.push_back(place);
              }
      return columns;
    }
  } // namespace

  void
  InitialStress::check_level_ground(const Geometry &geometry,
                                    const Regions  &regions) const
  {
    // The surface of a .msh file is not checked.
    if (geometry.shape == Geometry::Shape::file)
      return;
    const auto [low, high] = geometry.bounding_box();
    const double rounding =
      std::max(geometry.rounding(), 1e-6 * (high[1] - low[1]));
    const auto is_soil = [&](const dealii::Point<dim> &x) {
      return geometry.contains(x) && stage_of[regions.material_at(x)] < 0;
    };
    std::vector<double> x, ground;
    for (dealii::Point<dim> place : columns_of(geometry))
      {
        const double part = (high[1] - low[1]) / 400;
        const auto   soil = [&](const double y) {
          place[1] = y;
          return is_soil(place);
        };
        double middle = high[1] - part / 2.;
        while (middle > low[1] && !soil(middle))
          middle -= part;
        if (!(middle > low[1]))
          continue; // beside the body
        x.push_back(place[0]);
        ground.push_back(border(middle, middle + part, soil));
      }
    if (ground.empty())
      return;
    const double highest = *std::max_element(ground.begin(), ground.end());
    const auto is_low = [&](const double y) { return y < highest - rounding; };
    // Upright steps are those of slots, e.g. for walls; others are slopes.
    bool slopes = is_low(ground.front()) || is_low(ground.back());
    for (std::size_t i = 1; i < x.size(); ++i)
      {
        const double step = std::abs(ground[i] - ground[i - 1]);
        slopes = slopes || (step > rounding && step < 5. * (x[i] - x[i - 1]));
      }
    if (slopes)
      throw InputError("Initial stress/Type",
                       type.word(),
                       "zero | given, where the ground is not level",
                       "let gravity build up the stress of a slope in a stage "
                       "of its own");
    if (surface < highest - rounding)
      throw InputError("Initial stress/Surface level",
                       surface,
                       ">= " + std::to_string(highest) +
                         " m, the top of the soil before the first stage",
                       "give the level of the ground");
  }

  double
  InitialStress::vertical_stress(const dealii::Point<dim> &x,
                                 const int                 stage,
                                 const Materials          &materials,
                                 const Regions            &regions) const
  {
    const auto pressure = [&](const double y) {
      dealii::Point<dim> place = x;
      place[1]                 = y;
      return water == nullptr ? 0. : water->pressure(place);
    };
    const auto saturates = [&](const double y) {
      dealii::Point<dim> place = x;
      place[1]                 = y;
      return water != nullptr && water->saturates(place);
    };
    double vertical =
      stage < 0 ? pressure(x[1]) - pressure(surface) - surcharge : 0.;
    for (const Layer &layer :
         column_above(x, stage < 0 ? surface : top, materials, regions))
      if (stage_of[layer.material] == stage)
        {
          const ConstitutiveLaw &law = materials.law(layer.material);
          double                 wet = layer.low; // up to here
          if (law.saturated_density() > law.density() && saturates(wet))
            wet = saturates(layer.high)
                    ? layer.high
                    : border(layer.low, layer.high, saturates);
          vertical -= g * (law.saturated_density() * (wet - layer.low) +
                           law.density() * (layer.high - wet));
          if (stage >= 0)
            vertical += pressure(layer.low) - pressure(layer.high);
        }
      else if (stage < 0) // water stands where soil is added later
        vertical -= pressure(layer.low) - pressure(layer.high);
    return vertical;
  }

  Mandel
  InitialStress::at(const dealii::Point<dim> &x,
                    const unsigned int        material,
                    const Materials          &materials,
                    const Regions            &regions) const
  {
    switch (type_of(material))
      {
        case Type::zero:
          return Mandel::Zero();
        case Type::given:
          {
            std::array<double, n_mandel> values;
            for (int i = 0; i < n_mandel; ++i)
              values[i] = components[i].value(x, 0.);
            return mandel_of_components(values);
          }
        case Type::geostatic:
          break;
      }
    const double vertical =
      vertical_stress(x, stage_of[material], materials, regions);
    const ConstitutiveLaw &law    = materials.law(material);
    const double           ratio  = law.given_k0() > 0. ? law.given_k0()
                                    : k0                ? *k0
                                         : law.earth_pressure_at_rest();
    Mandel                 stress = ratio * vertical * unit_tensor<n_mandel>();
    stress[1]                     = vertical;
    return stress;
  }

  double
  InitialStress::zz_at(const dealii::Point<dim> &x,
                       const unsigned int        material,
                       const Mandel             &in_plane) const
  {
    return type_of(material) == Type::given && !text_zz.empty()
             ? component_zz.value(x, 0.)
             : in_plane[0];
  }
} // namespace geocone::GEOCONE_DIM
