// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/scene/initial_state.h>
#include <geocone/scene/water.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /** Of the components of a given initial stress. */
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
                    std::string("Formula in ") + coordinates +
                      " (m) for the velocity (m/s) at t = 0, which only a body "
                      "with inertia can have.");
  }

  void
  InitialVelocity::prepare()
  {
    for (unsigned int c = 0; c < dim; ++c)
      components[c].prepare(
        texts[c], std::string("Initial velocity/Velocity ") + coordinate[c]);
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
    type.declare(*this, "Type", ": the stress before the first step.");
    texts.fill("0");
    for (unsigned int i = 0; i < texts.size(); ++i)
      add_parameter(name_of_stress(i),
                    texts[i],
                    i == 0 ? std::string("For 'given': formula in ") +
                               coordinates + " (Pa, tension positive)."
                           : std::string("As Stress xx."));
    if (dim == 2)
      add_parameter(
        "Stress zz", text_zz, "For 'given': as Stress xx; empty: equal to it.");
    add_parameter("K0",
                  k0_text,
                  "For 'geostatic': horizontal over vertical stress (-), > 0, "
                  "or automatic: of each material's own, Jaky's 1 - sin(phi), "
                  "which its strength always bears, or nu/(1 - nu) of a "
                  "linear elastic one.");
    add_parameter("Surface level",
                  surface,
                  "For 'geostatic': y of the ground surface (m).");
    add_parameter("Surcharge",
                  surcharge,
                  "For 'geostatic': vertical pressure on the surface (Pa).");
  }

  void
  InitialStress::prepare(const Gravity           &gravity,
                         const Geometry          &geometry,
                         const Regions           &regions,
                         const Water             &water_of_scene,
                         const std::vector<bool> &is_added_later)
  {
    water    = water_of_scene.acts() ? &water_of_scene : nullptr;
    is_added = is_added_later;
    if (type == Type::given)
      {
        for (unsigned int i = 0; i < texts.size(); ++i)
          components[i].prepare(texts[i],
                                "Initial stress/" + name_of_stress(i));
        if (!text_zz.empty())
          component_zz.prepare(text_zz, "Initial stress/Stress zz");
      }
    else if (type == Type::geostatic)
      {
        // The final value: a geostatic state is one under full gravity.
        const dealii::Tensor<1, dim> full = gravity.at(1e300);
        if (full[0] != 0. || full[1] > 0. || (dim == 3 && full[dim - 1] != 0.))
          throw InputError("Gravity/Acceleration",
                           dealii::Patterns::Tools::to_string(full),
                           "g_x = 0 and g_y <= 0 with a geostatic initial "
                           "stress",
                           "give the initial stress by formulas instead");
        prepare_k0();
        g = -full[1];
        if (regions.have_numbers())
          throw InputError("Initial stress/Type",
                           type.word(),
                           "zero | given, where materials are found by their "
                           "region numbers",
                           "give the stress by formulas, or the materials by "
                           "region polygons");
        check_level_ground(geometry);
        check_level_water();
      }
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
    // Nothing but a number: "0.5 or so" is none.
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

  void
  InitialStress::check_level_ground(const Geometry &geometry) const
  {
    // A box is level; the surface of a .msh file is the user's to know.
    if (dim == 3 || geometry.outline.empty())
      return;
    double top = geometry.outline[0][1];
    for (const dealii::Point<dim> &x : geometry.outline)
      top = std::max(top, x[1]);
    // Level ground: the highest vertices span the whole width.
    double left = 1e300, right = -1e300, left_top = 1e300, right_top = -1e300;
    for (const dealii::Point<dim> &x : geometry.outline)
      {
        left  = std::min(left, x[0]);
        right = std::max(right, x[0]);
        if (x[1] > top - 1e-9)
          {
            left_top  = std::min(left_top, x[0]);
            right_top = std::max(right_top, x[0]);
          }
      }
    if (left_top > left + 1e-9 || right_top < right - 1e-9)
      throw InputError("Initial stress/Type",
                       type.word(),
                       "zero | given, where the ground is not level",
                       "let gravity build up the stress of a slope in a stage "
                       "of its own");
    if (surface < top - 1e-9)
      throw InputError("Initial stress/Surface level",
                       surface,
                       ">= " + std::to_string(top) +
                         " m, the top of the domain",
                       "give the level of the ground");
  }

  Mandel
  InitialStress::at(const dealii::Point<dim> &x,
                    const unsigned int        material,
                    const Materials          &materials,
                    const Regions            &regions) const
  {
    if (type == Type::zero || is_added[material])
      return Mandel::Zero();
    if (type == Type::given)
      {
        std::array<double, n_mandel> values;
        for (int i = 0; i < n_mandel; ++i)
          values[i] = components[i].value(x, 0.);
        return mandel_of_components(values);
      }

    // Weight of the column above x, by a midpoint sum that is exact
    // for one material and within a 400th of the depth at layer boundaries.
    const double       depth = surface - x[1];
    const unsigned int n     = materials.size() == 1 ? 1 : 400;
    double             mass  = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        dealii::Point<dim> above = x;
        above[1] += depth * (i + 0.5) / n;
        if (const unsigned int m = regions.material_at(above, -1); !is_added[m])
          mass += materials.law(m).density() * depth / n;
      }
    double vertical = -(surcharge + g * mass);
    if (water != nullptr)
      {
        dealii::Point<dim> top = x;
        top[1]                 = surface;
        vertical += water->pressure(x) - water->pressure(top);
      }
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
    return type == Type::given && !text_zz.empty() && !is_added[material]
             ? component_zz.value(x, 0.)
             : in_plane[0];
  }
} // namespace geocone
