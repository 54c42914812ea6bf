// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_face_plane_h
#define geocone_surfaces_face_plane_h

#include <geocone/surfaces/side_part.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Projection of a face onto a plane. */
  using FlatPart = Outline<dim - 1>;

  /** Unit coordinates of a position in a flat outline; positions outside are
   *  moved onto the boundary of the outline. */
  dealii::Point<dim - 1>
  unit_place(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** Whether a position is in a convex flat outline. */
  bool
  is_in(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** Length (m) of an interval, or area (m^2) of a triangle. */
  double
  size_of(const FlatPart &simplex);

  /** Intersection of two convex flat outlines, as disjoint intervals or
   *  triangles. */
  std::vector<FlatPart>
  shared_part(const FlatPart &a, const FlatPart &b);

  /** Plane of a face; the mean plane of a warped quadrilateral. */
  class FacePlane
  {
  public:
    /** @param face with corners counterclockwise as seen from outside of the
     *  body; in two dimensions the body is on the left of the line */
    explicit FacePlane(const SidePart &face);

    FlatPart
    project(const SidePart &face) const;

    /** Signed distance of a position from the plane, positive outside of the
     *  body (m). */
    double
    ahead(const dealii::Point<dim> &x) const
    {
      return (x - origin) * normal;
    }

    const dealii::Point<dim> &
    place() const
    {
      return origin;
    }

    dealii::Tensor<1, dim> normal;   ///< outward unit normal
    double                 size;     ///< length (m), or area (m^2)
    double                 diameter; ///< largest distance between corners (m)

  private:
    dealii::Point<dim>     origin; ///< the first corner
    dealii::Tensor<1, dim> axes[dim - 1];
  };
} // namespace geocone::GEOCONE_DIM

#endif
