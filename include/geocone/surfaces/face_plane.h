// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_face_plane_h
#define geocone_surfaces_face_plane_h

#include <geocone/surfaces/side_part.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Face of a cell, projected onto a plane. */
  using FlatPart = Outline<dim - 1>;

  /** Returns the unit coordinates of a position in the projection of a face.
   *  Positions outside are moved onto the boundary of the outline. */
  dealii::Point<dim - 1>
  unit_place(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** Returns true if a position lies in the convex projection of a face. */
  bool
  is_in(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** Returns the length (m) of an interval, or the area (m^2) of a triangle. */
  double
  size_of(const FlatPart &simplex);

  /** Returns the intersection of two convex projections of faces, divided into
   *  intervals or triangles. */
  std::vector<FlatPart>
  shared_part(const FlatPart &a, const FlatPart &b);

  /** Plane of a face of a cell. For a warped quadrilateral it is the mean
   *  plane. */
  class FacePlane
  {
  public:
    /** Computes the plane of a face.
     *  @param face with corners counterclockwise as seen from outside of the
     *  body; in two dimensions the body is on the left of the line */
    explicit FacePlane(const SidePart &face);

    FlatPart
    project(const SidePart &face) const;

    /** Returns the signed distance of a position from the plane (m), positive
     *  outside the body. */
    double
    signed_distance(const dealii::Point<dim> &x) const
    {
      return (x - origin) * normal;
    }

    const dealii::Point<dim> &
    place() const
    {
      return origin;
    }

    dealii::Tensor<1, dim> normal;   ///< outward unit normal
    double                 size;     ///< length (m) or area (m^2)
    double                 diameter; ///< largest distance between corners (m)

  private:
    dealii::Point<dim>     origin; ///< first corner of the face
    dealii::Tensor<1, dim> axes[dim - 1];
  };
} // namespace geocone::GEOCONE_DIM

#endif
