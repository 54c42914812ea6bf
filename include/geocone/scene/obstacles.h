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

  /** Neighbouring obstacles, which cover parts of the boundary of an obstacle:
   *  adjacent convex obstacles have one common surface, without their shared
   *  sides. */
  class Neighbours
  {
  public:
    /**
     * @param list all obstacles
     * @param own the obstacle whose neighbours these are
     * @param moved displacements of all since the start; empty: zero
     * @param margin distance up to which boundaries touch (m)
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

    /** Whether a point is inside one of them. */
    bool
    cover(const dealii::Point<dim> &place) const;

    /** Whether one of them contains a vertex, and is nearer to x than the
     *  vertex. */
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
   * A rigid body in frictional, unilateral contact with the soil: a half-plane,
   * a disc or a convex polygon, in three dimensions a half-space, a ball, a
   * cylinder or a convex polyhedron, at rest, driven or free. In contact the
   * force r of the obstacle on the body and the relative velocity u satisfy the
   * Signorini and Coulomb laws (see Contact). Each of its motions, of its
   * centre along the coordinates and about it, is driven by a formula or free;
   * a free one obeys
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

    /** Position of a point relative to it: infinite distance if covered. */
    using Nearest = ObstacleShape::Nearest;

    /**
     * Distance and normal at a point. The distance is a convex function of the
     * point, bounded below by its tangent along the normal.
     * @param x a point (m)
     * @param moved displacement of the obstacle since the start
     * @param approach direction of its motion relative to x: at an edge, the
     * approaching side is chosen
     * @param beside others that cover parts of its boundary; none: it is alone
     */
    Nearest
    nearest(const dealii::Point<dim>     &x,
            const RigidMotion            &moved,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             *beside = nullptr) const;

    /**
     * The same for a point of a body with small sliding: its distance along the
     * normal at its initial position (m), in the frame of the obstacle.
     * @param start initial position of the point
     * @param step largest relative displacement in a step (m)
     * @param beside others, at their initial positions
     */
    Nearest
    nearest_to_start(const dealii::Point<dim>     &start,
                     const dealii::Point<dim>     &x,
                     const RigidMotion            &moved,
                     const dealii::Tensor<1, dim> &step,
                     const Neighbours             *beside = nullptr) const;

    /**
     * Lower bound of the distance to another obstacle, negative if they overlap
     * (m); infinite for two half-planes. Convex shapes are separated by one of
     * their sides or, in three dimensions, by a plane along an edge of each.
     * @param moved,its_moved displacements of both since the start
     */
    double
    distance_to(const Obstacle    &other,
                const RigidMotion &moved,
                const RigidMotion &its_moved) const;

    /** Velocity at time t if driven, otherwise 0. */
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

    /** Mass (kg/m) or moment of inertia (kg m) of a motion; in three dimensions
     *  kg, kg m^2. */
    double
    inertia(const unsigned int k) const
    {
      return k < dim ? mass : moment_of_inertia;
    }

    /** The given forces at time t, without weight. */
    RigidMotion
    load(const double t) const;

    /** Small sliding: whether nodes retain their initial projection onto its
     *  boundary, for slip that is small compared with its size. */
    bool
    slides_little() const
    {
      return sliding == Sliding::small;
    }

    /** Greatest width, infinite for a half-plane (m). */
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

    /** Point moving with it, the reference of moments: the mean of a polygon's
     *  vertices, at the start. */
    dealii::Point<dim>
    centre() const
    {
      return body->centre();
    }

    /** @throws InputError if it moves other than along y, the axis of
     *  axisymmetric scenes */
    void
    check_round() const;

    /** Full name of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** @throws InputError because it overlaps with the body at the start.
     *  @param how deep, and with what */
    [[noreturn]] void
    refuse_overlap(const std::string &how) const;

    const std::string name;
    InterfaceLaw      law;

  private:
    /** @name A point in its own frame, and its present position */
    /** @{ */
    dealii::Point<dim>
    own_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    dealii::Point<dim>
    moved_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    /** @} */

    /** Extent in a direction after a motion (m). */
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

    /** Declares the driving motions, and the forces and masses of free ones. */
    void
    declare_motions();

    /** Creates the shape. @throws InputError */
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
    std::unique_ptr<ObstacleShape>  body; ///< created by prepare()

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

    /** The neighbours of each obstacle; for obstacles with small sliding at the
     *  start.
     *  @param moved since the start @param margin see Neighbours */
    std::vector<Neighbours>
    neighbours(const std::vector<RigidMotion> &moved,
               const double                    margin) const;

    /** Names of two overlapping obstacles, one of which is free, as contact
     *  between obstacles is not computed; empty: none. @param moved since the
     *  start @param margin tolerated overlap (m) */
    std::string
    overlap_of_free(const std::vector<RigidMotion> &moved,
                    const double                    margin) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
