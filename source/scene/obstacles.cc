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

    /**
     * How far a side is covered on from a covered place, towards its nearer bare part (m);
     * infinite if there is none.
     * @param is_covered of a part of the side, from 0 to 1 @param along of the place
     * @param length of the side (m) @param accuracy (m)
     */
    template <typename IsCovered>
    double
    way_to_bare(const IsCovered &is_covered,
                const double     along,
                const double     length,
                const double     accuracy)
    {
      double least = std::numeric_limits<double>::infinity();
      for (const double end : {0., 1.})
        if (!is_covered(end))
          {
            double covered = along, bare = end;
            while (std::abs(bare - covered) * length > accuracy)
              {
                const double middle                   = (covered + bare) / 2.;
                (is_covered(middle) ? covered : bare) = middle;
              }
            least = std::min(least, std::abs(bare - along) * length);
          }
      return least;
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
                             const Tensor<1, dim> &step,
                             const Neighbours     *beside) const
  {
    const Point<dim> X = centre();
    const Point<dim> now(X + turned(x - X - moved.centre, -moved.angle));
    // At a vertex it faces the side that has come, or comes, against it.
    const Tensor<1, dim> approach = start - now + turned(step, -moved.angle);
    const Nearest        first    = nearest(start, {}, approach, beside);
    if (std::isinf(first.distance))
      return first;
    const Tensor<1, dim> normal = first.normal;
    Nearest              found =
      nearest(Point<dim>(start + ((now - start) * normal) * normal),
              {},
              approach,
              beside);
    found.normal = turned(found.normal, moved.angle);
    return found;
  }

  Obstacle::Nearest
  Obstacle::nearest(const Point<dim>     &x,
                    const RigidMotion    &moved,
                    const Tensor<1, dim> &approach,
                    const Neighbours     *beside) const
  {
    const bool       turns = moved.angle != 0.;
    const Point<dim> X     = turns ? centre() : Point<dim>();
    Cover            cover;
    double           margin = 0.;
    if (beside != nullptr && beside->exist())
      {
        margin = beside->margin;
        cover  = [&](const Point<dim> &place) {
          return beside->cover(turns ? X + moved.centre +
                                         turned(place - X, moved.angle)
                                     : place + moved.centre);
        };
      }
    OnBoundary found =
      turns ? nearest_of_shape(
                Point<dim>(X + turned(x - X - moved.centre, -moved.angle)),
                turned(approach, -moved.angle),
                cover,
                margin)
            : nearest_of_shape(x - moved.centre, approach, cover, margin);
    if (turns)
      found.normal = turned(found.normal, moved.angle);
    if (found.is_vertex && cover &&
        beside->go_on_from(x - found.distance * found.normal, x))
      found.distance = std::numeric_limits<double>::infinity();
    return found;
  }

  std::vector<Point<dim>>
  Obstacle::moved_vertices(const RigidMotion &moved) const
  {
    const Point<dim>        X = centre();
    std::vector<Point<dim>> places;
    if (shape == Shape::polygon)
      for (const Point<dim> &vertex : vertices)
        places.push_back(X + moved.centre + turned(vertex - X, moved.angle));
    return places;
  }

  double
  Obstacle::parted_by_sides(const std::vector<Point<dim>> &places,
                            const RigidMotion             &moved) const
  {
    const auto beyond = [&](const Point<dim>     &on_side,
                            const Tensor<1, dim> &N) {
      double least = std::numeric_limits<double>::infinity();
      for (const Point<dim> &x : places)
        least = std::min(least, (x - on_side) * N);
      return least;
    };
    if (shape == Shape::half_plane)
      return beyond(place + moved.centre, turned(normal, moved.angle));
    double     most = -std::numeric_limits<double>::infinity();
    const auto own  = moved_vertices(moved);
    const auto n    = own.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        const Point<dim>    &a = own[i], &b = own[(i + 1) % n];
        const Tensor<1, dim> N = edge_normal(a, b);
        most                   = std::max(most, beyond(a, N / N.norm()));
      }
    return most;
  }

  double
  Obstacle::distance_to(const Obstacle    &other,
                        const RigidMotion &moved,
                        const RigidMotion &its_moved) const
  {
    if (shape == Shape::disc)
      return other.nearest(place + moved.centre, its_moved, {}).distance -
             radius;
    if (other.shape == Shape::disc)
      return other.distance_to(*this, its_moved, moved);
    if (shape == Shape::half_plane && other.shape == Shape::half_plane)
      return std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    if (other.shape == Shape::polygon)
      most = parted_by_sides(other.moved_vertices(its_moved), moved);
    if (shape == Shape::polygon)
      most =
        std::max(most, other.parted_by_sides(moved_vertices(moved), its_moved));
    return most;
  }

  Obstacle::OnBoundary
  Obstacle::nearest_of_shape(const Point<dim>     &x,
                             const Tensor<1, dim> &approach,
                             const Cover          &cover,
                             const double          margin) const
  {
    if (shape == Shape::polygon)
      return nearest_of_polygon(x, approach, cover, margin);
    if (shape == Shape::half_plane)
      return {{(x - place) * normal, normal}};
    const Tensor<1, dim> from = x - place;
    const double         r    = from.norm();
    return {{r - radius, r > 0. ? from / r : Point<dim>(0., 1.)}};
  }

  Obstacle::OnBoundary
  Obstacle::nearest_of_polygon(const Point<dim>     &x,
                               const Tensor<1, dim> &approach,
                               const Cover          &cover,
                               const double          margin) const
  {
    // Inside and on the border the nearest side, outside it or a vertex.
    constexpr double   infinity  = std::numeric_limits<double>::infinity();
    const unsigned int n         = vertices.size();
    const double       tolerance = 1e-9 * width();
    double             outmost   = -infinity;
    Nearest            best{-infinity, {}};
    OnBoundary         border{{infinity, {}}};
    for (unsigned int i = 0; i < n; ++i)
      {
        const Point<dim>    &a = vertices[i], &b = vertices[(i + 1) % n];
        const Tensor<1, dim> edge     = b - a;
        const double         l        = edge.norm();
        const Tensor<1, dim> N        = edge_normal(a, b) / l;
        double               distance = (x - a) * N;
        outmost                       = std::max(outmost, distance);
        const double part             = ((x - a) * edge) / edge.norm_square();
        const double along            = std::clamp(part, 0., 1.);
        if (cover)
          {
            const auto is_covered = [&](const double s) {
              const double inset = std::min(margin / l, 0.5);
              return cover(a + std::clamp(s, inset, 1. - inset) * edge +
                           margin * N);
            };
            if (is_covered(along))
              {
                // What is deep inside is pushed out through what is bare of the side.
                if (distance > -margin)
                  continue;
                distance = -std::hypot(
                  distance, way_to_bare(is_covered, along, l, margin / 2.));
                if (std::isinf(distance))
                  continue;
              }
          }
        if (distance > best.distance + tolerance ||
            (distance > best.distance - tolerance &&
             N * approach > best.normal * approach))
          best = {distance, N};
        const Tensor<1, dim> from = x - (a + along * edge);
        if (from.norm() < border.distance)
          border = {{from.norm(), from},
                    std::abs(part - along) * l > tolerance};
      }
    if (outmost > tolerance)
      {
        if (std::isfinite(border.distance))
          border.normal /= border.distance;
        return border;
      }
    if (std::isinf(best.distance))
      best.distance = infinity;
    return {best};
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
  Neighbours::go_on_from(const Point<dim> &vertex, const Point<dim> &x) const
  {
    const double own_distance = vertex.distance(x);
    for (unsigned int o = 0; o < list.size(); ++o)
      if (o != own && distance(o, vertex) < margin &&
          distance(o, x) < (1. - 1e-9) * own_distance)
        return true;
    return false;
  }

  Obstacles::Obstacles(const ParameterFile &file)
    : dealii::ParameterAcceptor("/Obstacles")
    , names(file.named_sections("Obstacles", "Names", ""))
  {
    if (dim == 3)
      refuse("Geometry/Dimension = 3",
             "they are for plane scenes so far: leave them out");
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

  std::vector<Neighbours>
  Obstacles::neighbours(const std::vector<RigidMotion> &moved,
                        const double                    margin) const
  {
    std::vector<Neighbours> all;
    for (unsigned int o = 0; o < list.size(); ++o)
      all.emplace_back(list,
                       o,
                       list[o]->slides_little() ? std::vector<RigidMotion>()
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

  void
  Obstacles::refuse(const std::string &what, const std::string &remedy) const
  {
    if (!names.empty())
      throw InputError("Obstacles/Names",
                       dealii::Patterns::Tools::to_string(names),
                       "none with " + what,
                       remedy);
  }
} // namespace geocone
