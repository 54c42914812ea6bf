// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/bounds/facet_condition.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string where_facets =
      dim == 3 ? "where loads are bounded in three dimensions"
               : "where loads are bounded around an axis";

    [[noreturn]] void
    refuse_difference(const BoundaryCondition &condition)
    {
      throw InputError(condition.parameter("Sides"),
                       condition.part(),
                       "one prescribed velocity where loads are bounded",
                       "two conditions differ on a face of the mesh: leave "
                       "one of them out there");
    }
  } // namespace

  namespace
  {
    using Weights = std::array<double, dim>; ///< of the vertices of a facet

    /** Calls @p f with the weights of the vertices of a facet, and of places inside: where
     *  formulas jump on an edge between two vertices, rounding would decide. */
    template <typename F>
    void
    visit_places(const F &f)
    {
      constexpr int n = dim == 3 ? 8 : 33; // parts of a side
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= (dim == 3 ? n - i : 0); ++j)
          {
            Weights weight = {};
            weight[0]      = double(i) / n;
            weight[dim - 2] += double(j) / n;
            weight[dim - 1]    = 1. - double(i + j) / n;
            const auto n_zeros = std::count(weight.begin(), weight.end(), 0.);
            if (n_zeros == 0 || n_zeros == dim - 1)
              f(weight);
          }
    }

    template <typename T>
    T
    weighted(const Weights &weight, const std::array<T, dim> &of_vertices)
    {
      T sum;
      for (unsigned int v = 0; v < dim; ++v)
        sum += weight[v] * of_vertices[v];
      return sum;
    }
  } // namespace

  double
  prescribed_on_facet(const BoundaryCondition           &condition,
                      const unsigned int                 component,
                      const std::array<Point<dim>, dim> &vertices)
  {
    const auto &function =
      component == dim ? condition.normal : condition.components[component];
    const double first = function->value(vertices[0], 0.);
    visit_places([&](const Weights &weight) {
      const double here = function->value(weighted(weight, vertices), 0.);
      if (std::abs(here - first) > 1e-12 * std::abs(first))
        throw InputError(
          condition.parameter(component == dim
                                ? std::string("Velocity normal")
                                : std::string("Velocity ") + "xyz"[component]),
          condition.formula(component),
          "one velocity for all that is pushed where loads are bounded",
          "the bounded load is the reaction to one translation: give a "
          "constant, and end the part where it ends");
    });
    return first;
  }

  double
  departure_from_linear(
    const std::function<Tensor<1, dim>(const Point<dim> &)> &field,
    const std::array<Point<dim>, dim>                       &vertices)
  {
    std::array<Tensor<1, dim>, dim> at_vertices;
    for (unsigned int v = 0; v < dim; ++v)
      at_vertices[v] = field(vertices[v]);
    double largest = 0.;
    visit_places([&](const Weights &weight) {
      largest = std::max(
        largest,
        (field(weighted(weight, vertices)) - weighted(weight, at_vertices))
          .norm());
    });
    return largest;
  }

  void
  HeldComponents::add(const BoundaryCondition &condition,
                      const FacetPlace        &place)
  {
    last           = &condition;
    const auto set = [&](const unsigned int d, const double v) {
      if (value[d] && std::abs(*value[d] - v) > 1e-12 * std::abs(v))
        refuse_difference(condition);
      value[d] = v;
    };
    for (unsigned int d = 0; d < dim; ++d)
      if (condition.components[d])
        set(d, prescribed_on_facet(condition, d, place.vertices));
    if (condition.normal)
      {
        if (prescribed_on_facet(condition, dim, place.vertices) != 0.)
          throw InputError(condition.parameter("Velocity normal"),
                           condition.formula(dim),
                           "0 where loads are bounded",
                           "push by Velocity x, y or z");
        bool is_along = false;
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(place.normal[d]) > 1. - 1e-12)
            {
              is_along = true;
              set(d, 0.);
            }
        if (!is_along && dim == 3)
          oblique = place.normal;
        else if (!is_along)
          throw InputError(condition.parameter("Velocity normal"),
                           0,
                           "a plane normal to an axis " + where_facets,
                           "turn the body, or hold all components there");
      }
  }

  FacetCondition
  HeldComponents::condition(const FacetPlace &place) const
  {
    FacetCondition held;
    unsigned int   n_held = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (value[d])
        {
          ++n_held;
          held.axis        = d;
          held.velocity[d] = *value[d];
        }
    if (oblique && n_held == dim &&
        std::abs(held.velocity * *oblique) > 1e-12 * held.velocity.norm())
      refuse_difference(*last);
    if (oblique && n_held == 0)
      {
        held.kind   = FacetCondition::Kind::plane;
        held.axis   = dim;
        held.normal = *oblique;
        return held;
      }
    if (n_held == 0)
      return held;
    held.kind =
      n_held == dim ? FacetCondition::Kind::fixed : FacetCondition::Kind::plane;
    if (n_held < dim && (oblique || n_held > 1 ||
                         std::abs(place.normal[held.axis]) < 1. - 1e-12))
      throw InputError(last->parameter("Velocity x"),
                       "components that are neither all of them nor that "
                       "normal to the side",
                       "all of them, or the normal one alone, on a plane "
                       "normal to an axis, " +
                         where_facets,
                       "hold all components, or set the others to free");
    return held;
  }

  std::optional<Tensor<1, dim>>
  prescribed_velocity(const std::vector<FacetCondition> &held)
  {
    std::optional<Tensor<1, dim>> velocity;
    for (const FacetCondition &facet : held)
      if (facet.velocity.norm() > 0.)
        {
          if (velocity &&
              (*velocity - facet.velocity).norm() > 1e-9 * velocity->norm())
            throw InputError("Boundary conditions/Names",
                             "several velocities that are not zero",
                             "one velocity for all that is pushed where loads "
                             "are bounded",
                             "the bounded load is the reaction to one "
                             "translation");
          velocity = facet.velocity;
        }
    return velocity;
  }

  std::array<Tensor<1, dim>, dim>
  tractions_at_vertices(const BoundaryCondition &load,
                        const FacetPlace        &place,
                        const FacetCondition    &held)
  {
    const auto traction = [&](const Point<dim> &x) {
      return load.vector_at(x, place.normal, 0.);
    };
    std::array<Tensor<1, dim>, dim> t;
    double                          largest = 0., on_held = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      {
        t[i]    = traction(place.vertices[i]);
        largest = std::max(largest, t[i].norm());
        on_held += held.held_part(t[i]).norm();
      }
    if (held.kind == FacetCondition::Kind::interface && largest > 0.)
      throw InputError(load.parameter("Sides"),
                       load.part(),
                       "tractions beside obstacles where loads are bounded",
                       "leave the traction out where an obstacle touches the "
                       "body");
    if (held.kind == FacetCondition::Kind::fixed ? largest > 0.
                                                 : on_held > 1e-12 * largest)
      throw InputError(load.parameter("Sides"),
                       load.part(),
                       "tractions along components that are free where loads "
                       "are bounded",
                       "leave the traction out where the velocity is "
                       "prescribed");
    if (departure_from_linear(traction, place.vertices) > 1e-9 * largest)
      {
        unsigned int c = 0; // a component that is given; dim: the normal one
        while (c < dim && !load.components[c])
          ++c;
        throw InputError(
          load.parameter(c == dim ? std::string("Traction normal")
                                  : std::string("Traction ") + "xyz"[c]),
          load.formula(c),
          "tractions that are linear in each face of the mesh "
          "where loads are bounded",
          "divide the side where its traction has a kink, or "
          "take finer cells there");
      }
    return t;
  }
} // namespace geocone::GEOCONE_DIM
