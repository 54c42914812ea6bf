// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_obstacles_h
#define geocone_boundary_obstacles_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/base/types.h>
#include <geocone/boundary/interface_law.h>
#include <geocone/functions/expression.h>
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

  /** Neighbours of an obstacle: the other obstacles adjacent to this obstacle.
   *  Neighbours cover parts of the boundary of the obstacle: adjacent convex
   *  obstacles form one surface without the common sides. */
  class Neighbours
  {
  public:
    /**
     * Constructs the list of the neighbours of an obstacle.
     * @param list all obstacles
     * @param own index of the obstacle with these neighbours
     * @param moved displacements of all obstacles since the start; empty: zero
     * @param margin distance below which boundaries are adjacent (m)
     */
    Neighbours(const std::vector<std::unique_ptr<Obstacle>> &list,
               const unsigned int                            own,
               const std::vector<RigidMotion>               &moved,
               const double                                  margin);

    /** Returns true if the obstacle has neighbours. */
    bool
    exist() const
    {
      return list.size() > 1;
    }

    /** Returns true if a point lies inside a neighbour of the obstacle. */
    bool
    cover(const dealii::Point<dim> &place) const;

    /** Returns true if a neighbour continues the surface of the obstacle beyond
     *  a vertex. The neighbour contains the vertex and is nearer to x than the
     *  vertex. */
    bool
    continue_beyond(const dealii::Point<dim> &vertex,
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
   * Rigid body in frictional, unilateral contact with the soil. The shape is a
   * half-plane, a disc or a convex polygon, in three dimensions a half-space, a
   * ball, a cylinder or a convex polyhedron. In contact the force r of the
   * obstacle on the body and the relative velocity u satisfy the Signorini and
   * Coulomb laws (see Contact). Each component of motion, i.e. a translation of
   * the centre or a rotation about it, is driven by a formula or free; a free
   * component obeys
   *   M dV/dt = F + M g - sum r,  J dw/dt = T - sum (x - X) x r,
   * in three dimensions with the same J about all axes, as for a ball or a
   * cube.
   */
  class Obstacle : public dealii::ParameterAcceptor
  {
  public:
    explicit Obstacle(const std::string &name);

    /** Checks the parameters of the obstacle. @throws InputError */
    void
    prepare();

    /** Distance from a point to the obstacle and unit normal at the nearest
     *  boundary point. The distance is infinite if neighbours cover that
     *  boundary point. */
    using Nearest = ObstacleShape::Nearest;

    /**
     * Returns the distance from a point to the obstacle, and the normal of the
     * obstacle. The distance is a convex function of the position, bounded
     * below by its linearisation along the normal.
     * @param x a point (m)
     * @param moved displacement of the obstacle since the start
     * @param approach direction of the motion of the obstacle relative to x: at
     * an edge, the approaching side is chosen
     * @param beside neighbours that cover parts of the boundary; null: none
     */
    Nearest
    nearest(const dealii::Point<dim>     &x,
            const RigidMotion            &moved,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             *beside = nullptr) const;

    /**
     * Returns the distance (m) from a point to the obstacle, and the normal,
     * under the assumption of small sliding. The distance is measured along the
     * normal at the initial position of the point, in the frame of the
     * obstacle.
     * @param start initial position of the point
     * @param step largest relative displacement in a step (m)
     * @param beside neighbours at their initial positions; null: none
     */
    Nearest
    nearest_to_start(const dealii::Point<dim>     &start,
                     const dealii::Point<dim>     &x,
                     const RigidMotion            &moved,
                     const dealii::Tensor<1, dim> &step,
                     const Neighbours             *beside = nullptr) const;

    /**
     * Returns a lower bound on the distance to another obstacle (m). The bound
     * is negative if the obstacles overlap, and infinite for two half-planes.
     * Convex shapes are separated by one of their sides or, in three
     * dimensions, by a plane along an edge of each.
     * @param moved,its_moved displacements of both obstacles since the start
     */
    double
    distance_to(const Obstacle    &other,
                const RigidMotion &moved,
                const RigidMotion &its_moved) const;

    /** Returns the prescribed velocity of the obstacle at time t. Free
     *  components are zero. */
    RigidMotion
    velocity(const double t) const;

    /** Returns true if component k of the rigid-body motion is free. Without an
     *  argument, returns true if any component is free. Components are numbered
     *  as in RigidMotion. */
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

    /** Returns the mass (translation) or moment of inertia (rotation) for
     *  component k of the rigid-body motion. Units are kg/m and kg m in two
     *  dimensions, kg and kg m^2 in three dimensions. */
    double
    inertia(const unsigned int k) const
    {
      return k < dim ? mass : moment_of_inertia;
    }

    /** Returns the prescribed forces and moments on the obstacle at time t,
     *  without its weight. */
    RigidMotion
    load(const double t) const;

    /** Returns true if small sliding is assumed along the obstacle. Nodes then
     *  retain their initial projection onto the boundary, because slip is small
     *  compared with the obstacle. */
    bool
    has_small_sliding() const
    {
      return sliding == Sliding::small;
    }

    /** Returns the largest width of the obstacle (m). It is infinite for a
     *  half-plane. */
    double
    width() const
    {
      return body->width();
    }

    /** Returns the surface of the displaced obstacle as triangles for
     *  visualisation, see ObstacleShape::triangles(). */
    std::vector<ObstacleShape::Triangle>
    triangles(const RigidMotion        &moved,
              const dealii::Point<dim> &body_of_soil,
              const double              size) const;

    /** Returns the initial position of the centre of the obstacle, the
     *  reference point of moments. The centre of a polygon is the mean of the
     *  vertices. */
    dealii::Point<dim>
    centre() const
    {
      return body->centre();
    }

    /** Checks that an obstacle is admissible in axisymmetry. @throws InputError
     *  if it moves other than along the axis y */
    void
    check_round() const;

    /** Returns the full name of a parameter of the obstacle, for error
     *  messages. */
    std::string
    parameter(const std::string &entry) const;

    /** Throws an exception for an obstacle that overlaps with the body in the
     *  initial state.
     *  @throws InputError
     *  @param how depth and position of the overlap, for the message */
    [[noreturn]] void
    refuse_overlap(const std::string &how) const;

    const std::string name;
    InterfaceLaw      law;

  private:
    /** @name Coordinates of a point in the frame of the obstacle, and current
     *  position of a point of the obstacle */
    /** @{ */
    dealii::Point<dim>
    own_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    dealii::Point<dim>
    moved_place(const dealii::Point<dim> &x, const RigidMotion &moved) const;
    /** @} */

    /** Returns the support function of the displaced obstacle for a direction
     *  n: the maximum of n.x (m). */
    double
    extent(const dealii::Tensor<1, dim> &n, const RigidMotion &moved) const;

    enum class Shape
    {
      half_space,
      ball,
      polytope,
      cylinder
    };

    static Choice<Shape>::Words
    shape_words();

    /** Declares the parameters of driven motions (velocities) and of free
     *  motions (forces, mass and moment of inertia). */
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

  /** List of all obstacles of a scene, from the parameter "Obstacles/Names". */
  class Obstacles : public NamedList<Obstacle>
  {
  public:
    explicit Obstacles(const ParameterFile &file);

    /** Returns the neighbours of each obstacle. For obstacles with small
     *  sliding, neighbours are at their initial positions.
     *  @param moved displacements since the start @param margin see
     *  Neighbours */
    std::vector<Neighbours>
    neighbours(const std::vector<RigidMotion> &moved,
               const double                    margin) const;

    /** Returns the names of two overlapping obstacles, at least one of which is
     *  free. The text is empty if there are none. Contact between obstacles is
     *  not computed.
     *  @param moved displacements since the start
     *  @param margin tolerance for overlap (m) */
    std::string
    overlap_of_free(const std::vector<RigidMotion> &moved,
                    const double                    margin) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
