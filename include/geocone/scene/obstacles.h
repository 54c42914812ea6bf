// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_obstacles_h
#define geocone_scene_obstacles_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/base/types.h>
#include <geocone/functions/expression.h>
#include <geocone/scene/interface_law.h>
#include <geocone/shapes/obstacle_shape.h>
#include <geocone/shapes/rigid_motion.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  class Obstacle;

  /** The obstacles beside one, which cover parts of its boundary: several convex ones
   *  that meet have one surface, without the sides that they share. */
  class Neighbours
  {
  public:
    /**
     * @param list all obstacles @param own the one that they are beside
     * @param moved what all have moved since the start; empty: nothing
     * @param margin distance up to which boundaries meet (m)
     */
    Neighbours(const std::vector<std::unique_ptr<Obstacle>> &list,
               const unsigned int                            own,
               const std::vector<RigidMotion>               &moved,
               const double                                  margin);

    /** Whether there are any. */
    bool
    exist() const
    {
      return list.size() > 1;
    }

    /** Whether a place is inside one of them. */
    bool
    cover(const dealii::Point<dim> &place) const;

    /** Whether one of them reaches a vertex, and is nearer to x than that. */
    bool
    go_on_from(const dealii::Point<dim> &vertex,
               const dealii::Point<dim> &x) const;

    const double margin;

  private:
    double
    distance(const unsigned int o, const dealii::Point<dim> &x) const;

    const std::vector<std::unique_ptr<Obstacle>> &list;
    const unsigned int                            own;
    const std::vector<RigidMotion>                moved;
  };

  /**
   * A rigid body that the soil may touch, rub on and leave, but not enter: a
   * half-plane, a disc or a convex polygon, in three dimensions a half-space, a ball, a
   * cylinder or a convex polyhedron, at rest, driven or free. Where they touch
   * the force r of the obstacle on the body and the relative velocity u obey
   * Signorini's and Coulomb's laws (see Contact). Each of its motions, of its centre
   * along the coordinates and about it, is driven by a formula or free; a free one obeys
   *   M dV/dt = F + M g - sum r,  J dw/dt = T - sum (x - X) x r,
   * in three dimensions with one J for all axes, that of a ball or a cube.
   */
  class Obstacle : public dealii::ParameterAcceptor
  {
  public:
    explicit Obstacle(const std::string &name);

    /** Checks its parameters. @throws InputError */
    void
    prepare();

    /** Where a place is beside it: infinitely far where it is hidden. */
    using Nearest = ObstacleShape::Nearest;

    /**
     * The distance is a convex function of the place, which its tangent along the
     * normal does not exceed.
     * @param x a place (m)
     * @param moved what the obstacle has moved since the start
     * @param approach direction in which it moves past x: at an edge the side that
     * comes nearer
     * @param beside others that hide parts of its boundary; none: it is alone
     */
    Nearest
    nearest(const dealii::Point<dim>     &x,
            const RigidMotion            &moved,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             *beside = nullptr) const;

    /**
     * The same of a point of a body that slides little: its distance along the normal
     * of the place that it had at the start (m), in the frame of the obstacle.
     * @param start where the point was at the start
     * @param step how far the obstacle may pass it in a step (m)
     * @param beside others, where they were at the start
     */
    Nearest
    nearest_to_start(const dealii::Point<dim>     &start,
                     const dealii::Point<dim>     &x,
                     const RigidMotion            &moved,
                     const dealii::Tensor<1, dim> &step,
                     const Neighbours             *beside = nullptr) const;

    /**
     * How far it is from another one at least, negative where they overlap (m); infinite
     * for two half-planes. Of convex shapes one of their sides parts them, or in three
     * dimensions a plane along an edge of each.
     * @param moved,its_moved what both have moved since the start
     */
    double
    distance_to(const Obstacle    &other,
                const RigidMotion &moved,
                const RigidMotion &its_moved) const;

    /** Its velocity at time t where it is driven, else 0. */
    RigidMotion
    velocity(const double t) const;

    /** Whether a motion is free, numbered as in RigidMotion. */
    bool
    is_free(const unsigned int k) const
    {
      return free[k];
    }
    bool
    is_free() const
    {
      return std::find(free.begin(), free.end(), true) != free.end();
    }

    /** Mass (kg/m), or moment of inertia (kg m), of a motion; in three dimensions kg,
     *  kg m^2. */
    double
    inertia(const unsigned int k) const
    {
      return k < dim ? mass : moment_of_inertia;
    }

    /** The given forces at time t, without weight. */
    RigidMotion
    load(const double t) const;

    /** Whether nodes keep the place on it that they first faced along its boundary: for
     *  slips that are small beside it, as strains are. */
    bool
    slides_little() const
    {
      return sliding == Sliding::small;
    }

    /** Its greatest width, infinite for a half-plane (m). */
    double
    width() const
    {
      return body->width();
    }

    /** ObstacleShape::triangles() after a motion. */
    std::vector<ObstacleShape::Triangle>
    triangles(const RigidMotion        &moved,
              const dealii::Point<dim> &body_of_soil,
              const double              size) const;

    /** A place that moves with it, which moments are about: the mean of a polygon's
     *  vertices, at the start. */
    dealii::Point<dim>
    centre() const
    {
      return body->centre();
    }

    /** @throws InputError if it moves otherwise than along y, the axis of a round body */
    void
    check_round() const;

    /** The full name of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** @throws InputError: at the start the body is in it.
     *  @param how deep, and what */
    [[noreturn]] void
    refuse_overlap(const std::string &how) const;

    const std::string name;
    InterfaceLaw      law;

  private:
    /** @name A place of its own frame, and where that has moved */
    /** @{ */
    dealii::Point<dim>
    own_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    dealii::Point<dim>
    moved_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    /** @} */

    /** How far it reaches along a direction after a motion (m). */
    double
    reach(const dealii::Tensor<1, dim> &n, const RigidMotion &moved) const;

    enum class Shape
    {
      half_space,
      ball,
      polytope,
      cylinder
    };

    static Choice<Shape>::Words
    shape_words();

    /** Declares what drives it, and the forces and masses where it is free. */
    void
    declare_motions();

    /** Makes the shape. @throws InputError */
    void
    make_shape();

    Choice<Shape> shape = {shape_words()};

    enum class Sliding
    {
      finite,
      small
    };

    Choice<Sliding> sliding = {
      {{"finite", Sliding::finite}, {"small", Sliding::small}}};

    dealii::Point<dim>              place;
    dealii::Tensor<1, dim>          normal = dealii::Point<dim>::unit_vector(1);
    double                          radius = 1., height = 1.;
    std::vector<dealii::Point<dim>> vertices;
    std::unique_ptr<ObstacleShape>  body; ///< as prepare() makes it

    std::array<std::string, n_motions> velocity_texts, load_texts;
    std::array<Expression, n_motions>  velocities, loads;
    std::array<bool, n_motions>        free = {};
    double                             mass = 0., moment_of_inertia = 0.;
  };

  /** The obstacles of a scene, named in the list "Obstacles/Names". */
  class Obstacles : public NamedList<Obstacle>
  {
  public:
    explicit Obstacles(const ParameterFile &file);

    /** Of each obstacle the others; of one that slides little as they were at the start.
     *  @param moved since the start @param margin see Neighbours */
    std::vector<Neighbours>
    neighbours(const std::vector<RigidMotion> &moved,
               const double                    margin) const;

    /** What obstacle is free and overlaps with which one, which it would not notice, as
     *  obstacles touch bodies only; empty: none. @param moved since the start
     *  @param margin that counts as none (m) */
    std::string
    overlap_of_free(const std::vector<RigidMotion> &moved,
                    const double                    margin) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
