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
  /** Convex shape of an obstacle, in the reference frame of the obstacle. */
  class ObstacleShape
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;

    virtual ~ObstacleShape() = default;

    /** Signed distance from a point to the boundary, and outward normal at the
     *  nearest boundary point. */
    struct Nearest
    {
      double distance; ///< signed (m), negative inside; infinite if covered
      Vector normal;   ///< outward, unit length
      bool   is_edge = false; ///< nearest point on an edge or vertex
    };

    /** Set of other obstacles that cover parts of the boundary of a shape. */
    struct Cover
    {
      /** Function that returns true if a point lies in another obstacle; empty
       *  without other obstacles. */
      std::function<bool(const Point &)> covers;
      double margin = 0.; ///< tolerance for adjacency (m)
    };

    /** Computes the signed distance from a point x to the boundary, and the
     *  normal at the nearest boundary point.
     *  @param approach direction of the motion relative to x: at an edge the
     *  approaching side is chosen */
    virtual Nearest
    nearest(const Point  &x,
            const Vector &approach,
            const Cover  &cover) const = 0;

    /** Centre of rotation. */
    virtual Point
    centre() const = 0;

    /** Greatest width (m). */
    virtual double
    width() const = 0;

    /** Extent of the shape in the direction n: the maximum of n.x (m). It can
     *  be infinite. */
    virtual double
    extent(const Vector &n) const = 0;

    /** @name Candidates for separating directions of two shapes */
    /** @{ */
    /** Outward unit normals of the flat sides. */
    virtual std::vector<Vector>
    side_normals() const
    {
      return {};
    }
    /** Unit vectors along the straight edges of a three-dimensional shape. */
    virtual std::vector<Vector>
    edge_directions() const
    {
      return {};
    }
    /** Vertices of the shape, or points on its curved edges. */
    virtual std::vector<Point>
    corners() const
    {
      return {};
    }
    /** @} */

    using Triangle = std::array<Point, 3>;

    /** Triangulation of the shape for visualisation. It covers the area of the
     *  shape or, in three dimensions, the surface; of an infinite shape only a
     *  part near a body.
     *  @param body a point in the body @param size width of the body (m) */
    virtual std::vector<Triangle>
    triangles(const Point &body, const double size) const = 0;
  };

  /** Half-space bounded by a plane, or half-plane bounded by a line. */
  class HalfSpace : public ObstacleShape
  {
  public:
    /** Creates the half-space behind a plane through a point.
     *  @param normal outward unit normal */
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
    extent(const Vector &n) const override;
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

  /** Ball, or disc in two dimensions. */
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
    extent(const Vector &n) const override;
    std::vector<Triangle>
    triangles(const Point &body, const double size) const override;

  private:
    const Point  middle;
    const double radius;
  };

  /** Solid circular cylinder in three dimensions. */
  class Cylinder : public ObstacleShape
  {
  public:
    /** Creates a cylinder from its axis, radius and height.
     *  @param middle midpoint of the axis @param axis unit vector along the
     *  axis */
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
    extent(const Vector &n) const override;
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

  /** Convex polygon, or convex polyhedron in three dimensions. */
  class Polytope : public ObstacleShape
  {
  public:
    /** Creates a convex polygon or polyhedron from its vertices.
     *  @param vertices of a polygon counterclockwise; of a polyhedron in any
     *  order
     *  @param[out] valid whether all vertices are vertices of a convex body */
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
    extent(const Vector &n) const override;
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
    /** Part of the boundary of a flat side: the edge ab of a face of a
     *  polyhedron, or an end point of a side of a polygon (then a = b). */
    struct End
    {
      Point  a, b;
      Vector outward; ///< in the plane of the side, normal to the edge

      Point
      nearest(const Point &x) const;

      /** Distance by which a point lies beyond this part of the boundary of the
       *  side (m). */
      double
      beyond(const Point &x) const
      {
        return (x - a) * outward;
      }
    };

    /** A flat side of the shape. */
    struct Side
    {
      Vector           normal; ///< outward, unit length
      Point            middle; ///< mean of the vertices
      std::vector<End> ends;

      /** Point of the side that is nearest to a point x.
       *  @param[out] is_end whether it is on an end of the side, farther than
       *  @p tolerance from the projection of x */
      Point
      nearest(const Point &x, const double tolerance, bool &is_end) const;

      /** Point of the side near @p p whose distance from the boundary of the
       *  side is at least @p by (m). If the side is too narrow, it is the
       *  midpoint. */
      Point
      inset(const Point &p, const double by) const;

      /** Distance from a covered point of a side to the uncovered part of the
       *  side (m). It is infinite if all ends of the side are covered. */
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

    /** Appends a side. @param around vertices of the side, counterclockwise as
     *  seen from outside */
    void
    add_side(const std::vector<Point> &around, const Vector &normal);

    const std::vector<Point> vertices;
    std::vector<Side>        sides;
  };
} // namespace geocone::GEOCONE_DIM

#endif
