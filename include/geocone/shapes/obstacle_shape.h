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
  /** Convex shape of an obstacle, in the frame of the obstacle. */
  class ObstacleShape
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;

    virtual ~ObstacleShape() = default;

    /** Signed distance and normal at the nearest point of the boundary. */
    struct Nearest
    {
      double distance; ///< signed (m), negative inside; infinite if covered
      Vector normal;   ///< outward, unit length
      bool   is_edge = false; ///< nearest point on an edge or vertex
    };

    /** Other obstacles that cover parts of the boundary. */
    struct Cover
    {
      /** Whether a point lies in another obstacle; empty function: no
       *  others. */
      std::function<bool(const Point &)> covers;
      double margin = 0.; ///< tolerance for adjacency (m)
    };

    /** Signed distance and normal at x.
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

    /** Extent in the direction n: max n.x over the shape (m); can be
     *  infinite. */
    virtual double
    reach(const Vector &n) const = 0;

    /** @name Candidates for separating directions of two shapes */
    /** @{ */
    /** Outward normals of flat sides. */
    virtual std::vector<Vector>
    side_normals() const
    {
      return {};
    }
    /** Unit vectors along straight edges, in three dimensions. */
    virtual std::vector<Vector>
    edge_directions() const
    {
      return {};
    }
    /** Vertices, or points on curved edges. */
    virtual std::vector<Point>
    corners() const
    {
      return {};
    }
    /** @} */

    using Triangle = std::array<Point, 3>;

    /** Triangles for visualisation: of the area of the shape, in three
     *  dimensions of its surface; for infinite shapes, of a part near a body.
     *  @param body a point in the body @param size width of the body (m) */
    virtual std::vector<Triangle>
    triangles(const Point &body, const double size) const = 0;
  };

  /** The half-space behind a plane; in two dimensions, behind a line. */
  class HalfSpace : public ObstacleShape
  {
  public:
    /** @param normal outward unit normal */
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

  /** A solid cylinder, in three dimensions. */
  class Cylinder : public ObstacleShape
  {
  public:
    /** @param middle midpoint of the axis @param axis unit vector along the
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

  /** A convex polygon; in three dimensions a convex polyhedron. */
  class Polytope : public ObstacleShape
  {
  public:
    /** @param vertices of a polygon counterclockwise; of a polyhedron in any
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
    /** An end of a flat side: an edge; for a polygon a vertex (a = b). */
    struct End
    {
      Point  a, b;
      Vector outward; ///< in the plane of the side, normal to the edge

      Point
      nearest(const Point &x) const;

      /** Distance of a point beyond the end (m). */
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

      /** Nearest point of the side.
       *  @param[out] is_end whether it is on an end of the side, farther than
       *  @p tolerance from the projection of x */
      Point
      nearest(const Point &x, const double tolerance, bool &is_end) const;

      /** Point of the side near @p p with the minimum distance @p by from the
       *  ends, or the midpoint of the side. */
      Point
      inset(const Point &p, const double by) const;

      /** Distance from a covered point of the side to the uncovered part of the
       *  side (m); infinite if all ends of the side are covered. */
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
