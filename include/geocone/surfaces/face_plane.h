// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_face_plane_h
#define geocone_surfaces_face_plane_h

#include <geocone/surfaces/side_part.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The projection of a face to a plane. */
  using FlatPart = Outline<dim - 1>;

  /** The unit coordinates of a place in a flat outline; of places outside those of one on
   *  its border. */
  dealii::Point<dim - 1>
  unit_place(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** Whether a place is in a convex flat outline. */
  bool
  is_in(const FlatPart &outline, const dealii::Point<dim - 1> &x);

  /** The length (m) of an interval, or the area (m^2) of a triangle. */
  double
  size_of(const FlatPart &simplex);

  /** The intervals or triangles, which do not overlap, that two convex flat outlines
   *  share. */
  std::vector<FlatPart>
  shared_part(const FlatPart &a, const FlatPart &b);

  /** The plane of a face, or the mean one of a quadrilateral that is not flat. */
  class FacePlane
  {
  public:
    /** @param face with its corners counterclockwise, seen from outside of the body; in
     *  the plane the body is on the left of the way */
    explicit FacePlane(const SidePart &face);

    FlatPart
    project(const SidePart &face) const;

    /** How far ahead a place is (m). */
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

    dealii::Tensor<1, dim> normal;   ///< outward, of length 1
    double                 size;     ///< length (m), or area (m^2)
    double                 diameter; ///< largest distance of corners (m)

  private:
    dealii::Point<dim>     origin; ///< the first corner
    dealii::Tensor<1, dim> axes[dim - 1];
  };
} // namespace geocone::GEOCONE_DIM

#endif
