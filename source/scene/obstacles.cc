// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/scene/edge_normal.h>
#include <geocone/scene/obstacles.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    Tensor<1, dim>
    turned(const Tensor<1, dim> &x, const double angle)
    {
      if (angle == 0.)
        return x;
      const double c = std::cos(angle), s = std::sin(angle);
      return Point<dim>(c * x[0] - s * x[1], s * x[0] + c * x[1]);
    }

    const char *const velocity_names[] = {
      "Velocity x", "Velocity y", "Angular velocity"};
    const char *const load_names[] = {"Force x", "Force y", "Moment"};
  } // namespace

  Obstacle::Obstacle(const std::string &name)
    : dealii::ParameterAcceptor("/Obstacles/" + name)
    , name(name)
  {
    shape.declare(
      *this,
      "Shape",
      ". What is behind a line ('Point', 'Normal'), inside a circle "
      "('Point' is its centre, 'Radius') or inside a convex polygon "
      "('Vertices').");
    sliding.declare(
      *this,
      "Sliding",
      " along it. Small (FEM): nodes keep the place on its boundary that they "
      "faced at the start, so that none slides off its edge, as strains are "
      "small, too; its load on a smooth footing is that of its full width.");
    add_parameter("Point",
                  place,
                  "A point x, y (m) of the line of a half-plane, or the centre "
                  "of a disc, at the start.");
    add_parameter(
      "Normal",
      normal,
      "Direction x, y out of a half-plane, towards the body; of any "
      "length.");
    add_parameter("Radius", radius, "Radius of a disc (m).");
    add_parameter("Vertices",
                  vertices,
                  "Vertices x, y; x, y; ... (m) of a convex polygon at the "
                  "start, counterclockwise.");
    for (unsigned int k = 0; k < n_motions; ++k)
      add_parameter(velocity_names[k],
                    velocity_texts[k],
                    std::string("Velocity of the obstacle") +
                      (k < dim
                         ? "'s centre (m/s)"
                         : " about its centre (rad/s), counterclockwise,") +
                      " as a formula in t (s); or free: it obeys the forces.");
    for (unsigned int k = 0; k < n_motions; ++k)
      add_parameter(load_names[k],
                    load_texts[k],
                    std::string("Force on a free obstacle") +
                      (k < dim ? ", at its centre (N/m)"
                               : ": moment about its centre (N)") +
                      ", beside its weight, as a formula in t (s).");
    add_parameter("Mass", mass, "Mass of a free obstacle (kg/m).");
    add_parameter(
      "Moment of inertia",
      moment_of_inertia,
      "About the centre, of an obstacle that is free to turn (kg m); "
      "of a rectangle M (a^2 + b^2)/12.");
    law.declare(*this);
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
        free[k] = velocity_texts[k] == "free";
        if (!free[k])
          velocities[k].prepare(velocity_texts[k],
                                parameter(velocity_names[k]));
        loads[k].prepare(load_texts[k], parameter(load_names[k]));
        if (!free[k] && load_texts[k] != "0")
          throw InputError(parameter(load_names[k]),
                           load_texts[k],
                           std::string("0 where '") + velocity_names[k] +
                             "' is not free",
                           "a motion has a velocity or a force: set it free");
        const char *const name = k < dim ? "Mass" : "Moment of inertia";
        if (free[k] && !(inertia(k) > 0. && std::isfinite(inertia(k))))
          throw InputError(parameter(name),
                           inertia(k),
                           std::string("> 0 where '") + velocity_names[k] +
                             "' is free",
                           "what moves by forces needs inertia, also where the "
                           "soil has none; a small one lets it follow fast");
      }
    if (!std::isfinite(place.square()))
      throw InputError(parameter("Point"),
                       dealii::Patterns::Tools::to_string(place),
                       "finite coordinates x, y (m)",
                       "give a point of the obstacle");
    if (shape == Shape::half_plane)
      {
        if (!(normal.norm() > 0.) || !std::isfinite(normal.norm()))
          throw InputError(parameter("Normal"),
                           dealii::Patterns::Tools::to_string(normal),
                           "a direction x, y other than 0, 0",
                           "it points from the obstacle to the body, e.g. 0, 1 "
                           "for the ground");
        normal /= normal.norm();
      }
    if (shape == Shape::disc && !(radius > 0. && std::isfinite(radius)))
      throw InputError(parameter("Radius"),
                       radius,
                       "> 0 m, finite",
                       "give the radius of the disc");
    if (shape == Shape::polygon)
      {
        const unsigned int n  = vertices.size();
        bool               ok = n >= 3;
        for (unsigned int i = 0; ok && i < n; ++i)
          {
            const Tensor<1, dim> edge = vertices[(i + 1) % n] - vertices[i],
                                 next = vertices[(i + 2) % n] -
                                        vertices[(i + 1) % n];
            ok = edge[0] * next[1] - edge[1] * next[0] > 0.;
          }
        if (!ok)
          throw InputError(parameter("Vertices"),
                           dealii::Patterns::Tools::to_string(vertices),
                           "three or more vertices of a convex polygon, "
                           "counterclockwise",
                           "turn their order round, leave out those inside its "
                           "sides, or make an obstacle of each convex part");
      }
    law.check(*this);
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

  double
  Obstacle::width() const
  {
    if (shape == Shape::half_plane)
      return std::numeric_limits<double>::infinity();
    if (shape == Shape::disc)
      return 2. * radius;
    double widest = 0.;
    for (const Point<dim> &a : vertices)
      for (const Point<dim> &b : vertices)
        widest = std::max(widest, a.distance(b));
    return widest;
  }

  Point<dim>
  Obstacle::centre() const
  {
    if (shape != Shape::polygon)
      return place;
    Point<dim> mean;
    for (const Point<dim> &vertex : vertices)
      mean += vertex / double(vertices.size());
    return mean;
  }

  Obstacle::Nearest
  Obstacle::nearest_to_start(const Point<dim>     &start,
                             const Point<dim>     &x,
                             const RigidMotion    &moved,
                             const Tensor<1, dim> &step) const
  {
    const Point<dim> X = centre();
    const Point<dim> now(X + turned(x - X - moved.centre, -moved.angle));
    // At a vertex it faces the side that has come, or comes, against it.
    const Tensor<1, dim> approach = start - now + turned(step, -moved.angle);
    const Tensor<1, dim> normal   = nearest(start, {}, approach).normal;
    Nearest              found    = nearest(
      Point<dim>(start + ((now - start) * normal) * normal), {}, approach);
    found.normal = turned(found.normal, moved.angle);
    return found;
  }

  Obstacle::Nearest
  Obstacle::nearest(const Point<dim>     &x,
                    const RigidMotion    &moved,
                    const Tensor<1, dim> &approach) const
  {
    if (moved.angle != 0.)
      {
        // In the frame that turns with it.
        const Point<dim> X = centre();
        Nearest          found =
          nearest(Point<dim>(X + turned(x - X - moved.centre, -moved.angle)),
                  {},
                  turned(approach, -moved.angle));
        found.normal = turned(found.normal, moved.angle);
        return found;
      }
    const Point<dim> at = x - moved.centre;
    if (shape == Shape::half_plane)
      return {(at - place) * normal, normal};
    if (shape == Shape::disc)
      {
        const Tensor<1, dim> from = at - place;
        const double         r    = from.norm();
        return {r - radius, r > 0. ? from / r : Point<dim>(0., 1.)};
      }
    // Inside and on the border the nearest side, outside it or a vertex.
    const unsigned int n         = vertices.size();
    const double       tolerance = 1e-9 * width();
    Nearest            best{-std::numeric_limits<double>::infinity(), {}};
    double             least = std::numeric_limits<double>::infinity();
    Tensor<1, dim>     to_border;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Point<dim>    &a = vertices[i], &b = vertices[(i + 1) % n];
        const Tensor<1, dim> edge     = b - a;
        const Tensor<1, dim> N        = edge_normal(a, b) / edge.norm();
        const double         distance = (at - a) * N;
        if (distance > best.distance + tolerance ||
            (distance > best.distance - tolerance &&
             N * approach > best.normal * approach))
          best = {distance, N};
        const double along =
          std::clamp(((at - a) * edge) / edge.norm_square(), 0., 1.);
        const Tensor<1, dim> from = at - (a + along * edge);
        if (from.norm() < least)
          {
            least     = from.norm();
            to_border = from;
          }
      }
    if (best.distance > tolerance)
      best = {least, to_border / least};
    return best;
  }

  Obstacles::Obstacles(const ParameterFile &file)
    : dealii::ParameterAcceptor("/Obstacles")
    , names(file.named_sections("Obstacles", "Names", ""))
  {
    add_parameter(
      "Names",
      names,
      "Names of rigid bodies that the soil touches, rubs on and may "
      "leave, comma-separated; each has a subsection of that name. "
      "Implicit FEM and MPM.");
    for (const std::string &obstacle : names)
      list.push_back(std::make_unique<Obstacle>(obstacle));
  }

  void
  Obstacles::prepare()
  {
    for (const auto &obstacle : list)
      obstacle->prepare();
  }

  void
  Obstacles::refuse(const std::string &what, const std::string &remedy) const
  {
    if (!list.empty())
      throw InputError("Obstacles/Names",
                       dealii::Patterns::Tools::to_string(names),
                       "none with " + what,
                       remedy);
  }
} // namespace geocone
