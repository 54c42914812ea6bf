// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shapes_obstacle_shape_h
#define geocone_shapes_obstacle_shape_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The convex shape of an obstacle, in its own frame. */
  class ObstacleShape
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;

    virtual ~ObstacleShape() = default;

    /** What of the boundary is nearest to a place. */
    struct Nearest
    {
      double distance; ///< negative inside (m); infinite: nothing is bare
      Vector normal;   ///< outward, unit length
      bool   is_edge = false; ///< where sides end
    };

    /** The others that hide parts of the boundary. */
    struct Cover
    {
      /** Whether a place is in one of them; empty: none is. */
      std::function<bool(const Point &)> covers;
      double margin = 0.; ///< distance up to which boundaries meet (m)
    };

    /** @param approach direction of the motion past x: at an edge the side counts that
     *  comes nearer */
    virtual Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const = 0;

    /** What it turns about. */
    virtual Point
    centre() const = 0;

    /** Its greatest width (m). */
    virtual double
    width() const = 0;

    /** How far it reaches along a direction: max n.x (m); may be infinite. */
    virtual double
    reach(const Vector &n) const = 0;

    /** @name For finding a direction that parts two shapes */
    /** @{ */
    /** Normals of its flat sides. */
    virtual std::vector<Vector>
    side_normals() const
    {
      return {};
    }
    /** Directions of its straight edges, in three dimensions. */
    virtual std::vector<Vector>
    edge_directions() const
    {
      return {};
    }
    /** Places on its edges. */
    virtual std::vector<Point>
    corners() const
    {
      return {};
    }
    /** @} */

    using Triangle = std::array<Point, 3>;

    /** What pictures show: triangles that fill it, in three dimensions those of its
     *  surface. Of what has no end a part beside a body.
     *  @param body a place in it @param size its width (m) */
    virtual std::vector<Triangle>
    triangles(const Point &body, const double size) const = 0;
  };

  /** What is behind a plane; in two dimensions behind a line. */
  class HalfSpace : public ObstacleShape
  {
  public:
    /** @param normal out of it, of unit length */
    HalfSpace(const Point &place, const Vector &normal);

    Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const override;
    Point
    centre() const override
    {
      return place;
    }
    double
    width() const override;
    double
    reach(const Vector &n) const override;
    std::vector<Triangle>
    triangles(const Point &body, const double size) const override;
    std::vector<Vector>
    side_normals() const override
    {
      return {normal};
    }

  private:
    const Point  place;
    const Vector normal;
  };

  /** A ball; in two dimensions a disc. */
  class Ball : public ObstacleShape
  {
  public:
    Ball(const Point &centre, const double radius);

    Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const override;
    Point
    centre() const override
    {
      return middle;
    }
    double
    width() const override
    {
      return 2. * radius;
    }
    double
    reach(const Vector &n) const override;
    std::vector<Triangle>
    triangles(const Point &body, const double size) const override;

  private:
    const Point  middle;
    const double radius;
  };

  /** The solid cylinder around an axis, in three dimensions. */
  class Cylinder : public ObstacleShape
  {
  public:
    /** @param middle of its axis @param axis its direction, of unit length */
    Cylinder(const Point  &middle,
             const Vector &axis,
             const double  radius,
             const double  height);

    Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const override;
    Point
    centre() const override
    {
      return middle;
    }
    double
    width() const override;
    double
    reach(const Vector &n) const override;
    std::vector<Triangle>
    triangles(const Point &body, const double size) const override;
    std::vector<Vector>
    side_normals() const override
    {
      return {axis, -axis};
    }
    std::vector<Point>
    corners() const override;

  private:
    const Point  middle;
    const Vector axis;
    const double radius, half_height;
  };

  /** A convex polygon, or polyhedron. */
  class Polytope : public ObstacleShape
  {
  public:
    /** @param vertices of a polygon counterclockwise; of a polyhedron in any order
     *  @param valid whether they are those of a convex body, each of them one */
    Polytope(const std::vector<Point> &vertices, bool &valid);

    Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const override;
    Point
    centre() const override;
    double
    width() const override;
    double
    reach(const Vector &n) const override;
    std::vector<Triangle>
    triangles(const Point &body, const double size) const override;
    std::vector<Vector>
    side_normals() const override;
    std::vector<Vector>
    edge_directions() const override;
    std::vector<Point>
    corners() const override
    {
      return vertices;
    }

  private:
    /** An end of a side: an edge; of a polygon a vertex, a = b. */
    struct End
    {
      Point  a, b;
      Vector outward; ///< in the side, across the edge

      Point
      nearest(const Point &x) const;

      /** How far a place is beyond it (m). */
      double
      beyond(const Point &x) const
      {
        return (x - a) * outward;
      }
    };

    /** A flat side. */
    struct Side
    {
      Vector           normal; ///< outward, unit length
      Point            middle; ///< the mean of its vertices
      std::vector<End> ends;

      /** Its nearest place, and whether that is at one of its ends, farther than a
       *  tolerance from straight ahead of x. */
      Point
      nearest(const Point &x, const double tolerance, bool &is_end) const;

      /** A place on it, at least so far from its ends, or its middle. */
      Point
      inset(const Point &p, const double by) const;

      /** The distance from a covered place on it to what is bare; infinite if all is
       *  covered towards its ends. */
      double
      way_to_bare(const Point &from, const Cover &cover) const;

      bool
      is_covered(const Point &p, const Cover &cover) const
      {
        return cover.covers(
          Point(inset(p, cover.margin) + cover.margin * normal));
      }
    };

    bool
    make_sides_of_polygon();
    bool
    make_sides_of_polyhedron();

    /** Makes the side of the vertices around it, counterclockwise as seen from outside.
     */
    void
    add_side(const std::vector<Point> &around, const Vector &normal);

    const std::vector<Point> vertices;
    std::vector<Side>        sides;
  };
} // namespace geocone::GEOCONE_DIM

#endif
