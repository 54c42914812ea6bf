// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_face_plane_h
#define geocone_surfaces_face_plane_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * What is between the corners of a face of a cell in order around it: of an edge, a
   * triangle, or a quadrilateral, on which x is linear in each unit coordinate. The same
   * of their projections to a plane, of one dimension less.
   */
  template <int n>
  class FaceOutline
  {
  public:
    explicit FaceOutline(std::vector<dealii::Point<n>> corners)
      : corners(std::move(corners))
    {}

    /** The place of unit coordinates. */
    dealii::Point<n>
    at(const dealii::Point<dim - 1> &s) const
    {
      const dealii::Point<n> &origin = corners[0];
      dealii::Tensor<1, n>    x      = s[0] * (corners[1] - origin);
      if constexpr (dim == 3)
        {
          x += s[1] * (corners.back() - origin);
          if (corners.size() == 4)
            x +=
              s[0] * s[1] * ((corners[2] - corners[1]) - (corners[3] - origin));
        }
      return origin + x;
    }

    const std::vector<dealii::Point<n>> corners;
  };

  using FlatOutline = FaceOutline<dim - 1>;

  /** The unit coordinates of a place in a flat outline; of places outside those of one on
   *  its border. */
  dealii::Point<dim - 1>
  unit_place(const FlatOutline &outline, const dealii::Point<dim - 1> &x);

  /** Whether a place is in a convex flat outline. */
  bool
  is_in(const FlatOutline &outline, const dealii::Point<dim - 1> &x);

  /** An interval, or a triangle. */
  using FlatSimplex = std::array<dealii::Point<dim - 1>, dim>;

  /** Its length (m), or area (m^2). */
  double
  size_of(const FlatSimplex &simplex);

  /** What two convex flat outlines share, in pieces that do not overlap. */
  std::vector<FlatSimplex>
  shared_part(const FlatOutline &a, const FlatOutline &b);

  /** The plane of a face, or the mean one of a quadrilateral that is not flat. */
  class FacePlane
  {
  public:
    /** @param face with its corners counterclockwise, seen from outside of the body; in
     *  the plane the body is on the left of the way */
    explicit FacePlane(const FaceOutline<dim> &face);

    FlatOutline
    project(const FaceOutline<dim> &face) const;

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
