// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/boundary/obstacles.h>
#include <geocone/functions/formula.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Names of the parameters of a motion. */
    std::string
    velocity_name(const unsigned int k)
    {
      if (k < dim)
        return std::string("Velocity ") + coordinate[k];
      return dim == 2 ? "Angular velocity"
                      : "Angular velocity " + axis_of_rotation(k - dim);
    }

    std::string
    load_name(const unsigned int k)
    {
      if (k < dim)
        return std::string("Force ") + coordinate[k];
      return dim == 2 ? "Moment" : "Moment " + axis_of_rotation(k - dim);
    }
  } // namespace

  Choice<Obstacle::Shape>::Words
  Obstacle::shape_words()
  {
    if (dim == 2)
      return {{"half-plane", Shape::half_space},
              {"disc", Shape::ball},
              {"polygon", Shape::polytope}};
    return {{"half-space", Shape::half_space},
            {"ball", Shape::ball},
            {"polyhedron", Shape::polytope},
            {"cylinder", Shape::cylinder}};
  }

  Obstacle::Obstacle(const std::string &name)
    : dealii::ParameterAcceptor("/Obstacles/" + name)
    , name(name)
  {
    const std::string coordinates_of = coordinates;
    shape.declare(
      *this,
      "Shape",
      dim == 2
        ? ". Half-plane: behind a line ('Point', 'Normal'). Disc: 'Point' is "
          "its centre, with 'Radius'. Polygon: convex, with 'Vertices'."
        : ". Half-space: behind a plane ('Point', 'Normal'). Ball: 'Point' is "
          "its centre, with 'Radius'. Polyhedron: convex, with 'Vertices'. "
          "Cylinder: 'Point' is its centre, 'Normal' its axis, with 'Radius' "
          "and 'Height'.");
    sliding.declare(*this,
                    "Sliding",
                    ": sliding along the boundary. Small (FEM): nodes keep "
                    "their initial projection on the boundary, consistent with "
                    "small strains, so that none slides off its edge; the load "
                    "of a smooth footing is that of its full width.");
    add_parameter(
      "Point",
      place,
      "Initial position: a point " + coordinates_of +
        (dim == 2 ? " [m] of the line of a half-plane, or the centre of a disc."
                  : " [m] of the plane of a half-space, or the centre of a "
                    "ball or of a cylinder."));
    add_parameter(
      "Normal",
      normal,
      "Direction " + coordinates_of +
        (dim == 2 ? " out of a half-plane, towards the body; of any length [-]."
                  : " out of a half-space, towards the body, or of the axis of "
                    "a cylinder; of any length [-]."));
    add_parameter("Radius",
                  radius,
                  dim == 2 ? "Radius of a disc [m]."
                           : "Radius of a ball or a cylinder [m].");
    if (dim == 3)
      add_parameter(
        "Height", height, "Height of a cylinder [m], centred at 'Point'.");
    add_parameter("Vertices",
                  vertices,
                  dim == 2 ? "Initial vertices x, y; x, y; ... [m] of a convex "
                             "polygon, counterclockwise."
                           : "Initial vertices x, y, z; x, y, z; ... [m] of a "
                             "convex polyhedron, in any order.");
    declare_motions();
    law.declare(*this);
  }

  void
  Obstacle::declare_motions()
  {
    velocity_texts.fill("0");
    load_texts.fill("0");
    for (unsigned int k = 0; k < n_motions; ++k)
      add_parameter(
        velocity_name(k),
        velocity_texts[k],
        std::string("Velocity of the obstacle") +
          (k < dim ? "'s centre [m/s]"
                   : " about its centre [rad/s], counterclockwise,") +
          " as a formula in t (s); or free: from the equations of motion.");
    for (unsigned int k = 0; k < n_motions; ++k)
      add_parameter(
        load_name(k),
        load_texts[k],
        std::string("Force on a free obstacle") +
          (k < dim ? ", at its centre" : ": moment about its centre") +
          (dim == 2 ? (k < dim ? " [N/m]" : " [N]")
                    : (k < dim ? " [N]" : " [N m]")) +
          ", in addition to its weight, as a formula in t (s).");
    add_parameter("Mass",
                  mass,
                  dim == 2
                    ? "Mass of a free obstacle [kg/m]; in kg if axisymmetric."
                    : "Mass of a free obstacle [kg].");
    add_parameter("Moment of inertia",
                  moment_of_inertia,
                  dim == 2
                    ? "Moment of inertia about the centre of an obstacle that "
                      "rotates freely [kg m]; M (a^2 + b^2)/12 for a rectangle."
                    : "Moment of inertia about each axis through the centre of "
                      "an obstacle that rotates freely [kg m^2]; M a^2/6 for a "
                      "cube, 2/5 M R^2 for a ball. It is the same for all "
                      "axes, so that the rotation of elongated or flat bodies "
                      "is approximate; their equilibrium is not affected.");
  }

  void
  Obstacle::refuse_overlap(const std::string &how) const
  {
    throw InputError("Obstacles/Names",
                     name,
                     "an obstacle that does not overlap with the body at the "
                     "start",
                     how + ": move it, or turn 'Normal' round");
  }

  std::string
  Obstacle::parameter(const std::string &entry) const
  {
    return get_section_name().substr(1) + "/" + entry;
  }

  void
  Obstacle::prepare()
  {
    for (unsigned int k = 0; k < n_motions; ++k)
      {
        free[k]            = velocity_texts[k] == "free";
        const auto prepare = [&](Expression        &formula,
                                 const std::string &text,
                                 const std::string &entry) {
          check_formula(text, parameter(entry), FormulaVariables::time);
          formula.prepare(text, parameter(entry));
        };
        if (!free[k])
          prepare(velocities[k], velocity_texts[k], velocity_name(k));
        prepare(loads[k], load_texts[k], load_name(k));
        if (!free[k] && load_texts[k] != "0")
          throw InputError(parameter(load_name(k)),
                           load_texts[k],
                           "0 where '" + velocity_name(k) + "' is not free",
                           "a motion has a velocity or a force: set it free");
        const char *const name = k < dim ? "Mass" : "Moment of inertia";
        if (free[k] && !(inertia(k) > 0. && std::isfinite(inertia(k))))
          throw InputError(parameter(name),
                           inertia(k),
                           "> 0 where '" + velocity_name(k) + "' is free",
                           "what moves by forces needs inertia, also where the "
                           "soil has none; a small one lets it follow fast");
      }
    make_shape();
    law.check(*this);
  }

  void
  Obstacle::make_shape()
  {
    if (!std::isfinite(place.square()))
      throw InputError(parameter("Point"),
                       dealii::Patterns::Tools::to_string(place),
                       std::string("finite coordinates ") + coordinates +
                         " (m)",
                       "give a point of the obstacle");
    if (shape == Shape::half_space || shape == Shape::cylinder)
      {
        if (!(normal.norm() > 0.) || !std::isfinite(normal.norm()))
          throw InputError(
            parameter("Normal"),
            dealii::Patterns::Tools::to_string(normal),
            std::string("a direction ") + coordinates + " that is not zero",
            std::string("it points from the obstacle to the "
                        "body, e.g. ") +
              (dim == 2 ? "0, 1" : "0, 1, 0") + " for the ground");
        normal /= normal.norm();
      }
    for (const auto &[entry, length] :
         {std::pair{"Radius", radius}, std::pair{"Height", height}})
      if ((shape == Shape::cylinder ||
           (shape == Shape::ball && length == radius)) &&
          !(length > 0. && std::isfinite(length)))
        throw InputError(parameter(entry),
                         length,
                         "> 0 m, finite",
                         "give the size of the obstacle");
    bool valid = true;
    switch (shape.get())
      {
        case Shape::half_space:
          body = std::make_unique<HalfSpace>(place, normal);
          break;
        case Shape::ball:
          body = std::make_unique<Ball>(place, radius);
          break;
        case Shape::cylinder:
          body = std::make_unique<Cylinder>(place, normal, radius, height);
          break;
        case Shape::polytope:
          body = std::make_unique<Polytope>(vertices, valid);
          break;
      }
    if (!valid)
      throw InputError(
        parameter("Vertices"),
        dealii::Patterns::Tools::to_string(vertices),
        dim == 2 ? "three or more vertices of a convex polygon, "
                   "counterclockwise"
                 : "four or more vertices of a convex polyhedron, none inside",
        std::string(dim == 2 ? "turn their order round, leave" : "leave") +
          " out those inside its sides, or make an obstacle of each convex "
          "part");
  }

  void
  Obstacle::check_round() const
  {
    for (const unsigned int k : {0U, unsigned(dim)})
      if (velocity_texts[k] != "0")
        throw InputError(parameter(velocity_name(k)),
                         velocity_texts[k],
                         "0 where Geometry/Symmetry = axisymmetric",
                         "what goes round the axis moves along it: set "
                         "'Velocity y'");
  }

  RigidMotion
  Obstacle::velocity(const double t) const
  {
    RigidMotion v;
    for (unsigned int k = 0; k < n_motions; ++k)
      if (!free[k])
        v[k] = velocities[k].value(place, t);
    return v;
  }

  RigidMotion
  Obstacle::load(const double t) const
  {
    RigidMotion force;
    for (unsigned int k = 0; k < n_motions; ++k)
      force[k] = loads[k].value(place, t);
    return force;
  }

  Point<dim>
  Obstacle::own_place(const Point<dim> &x, const RigidMotion &moved) const
  {
    if (moved.rotation.norm() == 0.)
      return x - moved.centre;
    const Point<dim> X = centre();
    return X + moved.turned(x - X - moved.centre, true);
  }

  Point<dim>
  Obstacle::moved_place(const Point<dim> &x, const RigidMotion &moved) const
  {
    const Point<dim> X = centre();
    return X + moved.centre + moved.turned(x - X);
  }

  std::vector<ObstacleShape::Triangle>
  Obstacle::triangles(const RigidMotion &moved,
                      const Point<dim>  &body_of_soil,
                      const double       size) const
  {
    auto all = body->triangles(own_place(body_of_soil, moved), size);
    for (ObstacleShape::Triangle &triangle : all)
      for (Point<dim> &x : triangle)
        x = moved_place(x, moved);
    return all;
  }

  Obstacle::Nearest
  Obstacle::nearest_to_start(const Point<dim>     &start,
                             const Point<dim>     &x,
                             const RigidMotion    &moved,
                             const Tensor<1, dim> &step,
                             const Neighbours     *beside) const
  {
    const Point<dim> now = own_place(x, moved);
    // At an edge, it faces the side that has approached or is approaching it.
    const Tensor<1, dim> approach = start - now + moved.turned(step, true);
    const Nearest        first    = nearest(start, {}, approach, beside);
    if (std::isinf(first.distance))
      return first;
    const Tensor<1, dim> normal = first.normal;
    Nearest              found =
      nearest(Point<dim>(start + ((now - start) * normal) * normal),
              {},
              approach,
              beside);
    found.normal = moved.turned(found.normal);
    return found;
  }

  Obstacle::Nearest
  Obstacle::nearest(const Point<dim>     &x,
                    const RigidMotion    &moved,
                    const Tensor<1, dim> &approach,
                    const Neighbours     *beside) const
  {
    ObstacleShape::Cover cover;
    if (beside != nullptr && beside->exist())
      cover = {[&](const Point<dim> &place) {
                 return beside->cover(moved_place(place, moved));
               },
               beside->margin};
    Nearest found =
      body->nearest(own_place(x, moved), moved.turned(approach, true), cover);
    found.normal = moved.turned(found.normal);
    if (found.is_edge && cover.covers &&
        beside->continue_beyond(x - found.distance * found.normal, x))
      found.distance = std::numeric_limits<double>::infinity();
    return found;
  }

  double
  Obstacle::extent(const Tensor<1, dim> &n, const RigidMotion &moved) const
  {
    const Point<dim>     X     = centre();
    const Tensor<1, dim> n_own = moved.turned(n, true);
    return (X + moved.centre) * n - X * n_own + body->extent(n_own);
  }

  double
  Obstacle::distance_to(const Obstacle    &other,
                        const RigidMotion &moved,
                        const RigidMotion &its_moved) const
  {
    if (shape == Shape::ball)
      return other.nearest(place + moved.centre, its_moved, {}).distance -
             radius;
    if (other.shape == Shape::ball)
      return other.distance_to(*this, its_moved, moved);
    if (shape == Shape::half_space && other.shape == Shape::half_space)
      return std::numeric_limits<double>::infinity();
    // Candidates for the separating direction: out of this obstacle.
    std::vector<Tensor<1, dim>> directions;
    const auto                  add_of = [&directions](const Obstacle    &own,
                                      const RigidMotion &own_moved,
                                      const Obstacle    &its,
                                      const RigidMotion &its_moved,
                                      const double       sign) {
      for (const auto &n : own.body->side_normals())
        directions.push_back(sign * own_moved.turned(n));
      if (dim == 3)
        for (const auto &corner : its.body->corners())
          directions.push_back(
            sign *
            own.nearest(its.moved_place(corner, its_moved), own_moved, {})
              .normal);
    };
    add_of(*this, moved, other, its_moved, 1.);
    add_of(other, its_moved, *this, moved, -1.);
    if constexpr (dim == 3)
      for (const auto &a : body->edge_directions())
        for (const auto &b : other.body->edge_directions())
          if (const auto n =
                cross_product_3d(moved.turned(a), its_moved.turned(b));
              n.norm() > 1e-6)
            for (const double sign : {1., -1.})
              directions.push_back(sign / n.norm() * n);
    double most = -std::numeric_limits<double>::infinity();
    for (const auto &n : directions)
      most = std::max(most, -other.extent(-n, its_moved) - extent(n, moved));
    return most;
  }

  Neighbours::Neighbours(const std::vector<std::unique_ptr<Obstacle>> &list,
                         const unsigned int                            own,
                         const std::vector<RigidMotion>               &moved,
                         const double                                  margin)
    : margin(margin)
    , list(list)
    , own(own)
    , moved(moved)
  {}

  double
  Neighbours::distance(const unsigned int o, const Point<dim> &x) const
  {
    return list[o]
      ->nearest(x, moved.empty() ? RigidMotion() : moved[o], {})
      .distance;
  }

  bool
  Neighbours::cover(const Point<dim> &place) const
  {
    for (unsigned int o = 0; o < list.size(); ++o)
      if (o != own && distance(o, place) < -margin / 2.)
        return true;
    return false;
  }

  bool
  Neighbours::continue_beyond(const Point<dim> &vertex,
                              const Point<dim> &x) const
  {
    const double own_distance = vertex.distance(x);
    for (unsigned int o = 0; o < list.size(); ++o)
      if (o != own && distance(o, vertex) < margin &&
          distance(o, x) < (1. - 1e-9) * own_distance)
        return true;
    return false;
  }

  Obstacles::Obstacles(const ParameterFile &file)
    : NamedList(
        file,
        "Obstacles",
        "Names of rigid bodies in frictional contact with the soil, "
        "comma-separated; each has a subsection of its name. FEM, implicit "
        "and explicit MPM.")
  {
    make();
  }

  std::vector<Neighbours>
  Obstacles::neighbours(const std::vector<RigidMotion> &moved,
                        const double                    margin) const
  {
    std::vector<Neighbours> all;
    for (unsigned int o = 0; o < list.size(); ++o)
      all.emplace_back(list,
                       o,
                       list[o]->has_small_sliding() ? std::vector<RigidMotion>()
                                                    : moved,
                       margin);
    return all;
  }

  std::string
  Obstacles::overlap_of_free(const std::vector<RigidMotion> &moved,
                             const double                    margin) const
  {
    for (std::size_t a = 0; a < list.size(); ++a)
      for (std::size_t b = 0; b < list.size(); ++b)
        if (a != b && list[a]->is_free())
          if (const double distance =
                list[a]->distance_to(*list[b], moved[a], moved[b]);
              distance < -margin)
            return format("the free obstacle '%s' is %.3g m inside '%s': "
                          "obstacles touch soil, and not each other",
                          list[a]->name.c_str(),
                          -distance,
                          list[b]->name.c_str());
    return "";
  }
} // namespace geocone::GEOCONE_DIM
