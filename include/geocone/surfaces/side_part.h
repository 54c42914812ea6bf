// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_side_part_h
#define geocone_surfaces_side_part_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Part of a line or quadrilateral, defined by a range of unit
   *  coordinates. */
  struct UnitPart
  {
    dealii::Point<dim - 1> lower, upper;

    static UnitPart
    whole();
  };

  /**
   * Part of a boundary segment: a line, a triangle or a quadrilateral. The
   * corners are stored in order; the map of a quadrilateral is linear in each
   * unit coordinate.
   * @tparam n dim, or dim - 1 for the projection onto a plane
   */
  template <int n>
  struct Outline
  {
    dealii::Point<n>
    at(const dealii::Point<dim - 1> &s) const
    {
      dealii::Tensor<1, n> x = s[0] * edge(0);
      if constexpr (dim == 3)
        {
          x += s[1] * edge(1);
          if (corners.size() == 4)
            x += s[0] * s[1] * ((corners[2] - corners[1]) - edge(1));
        }
      return corners[0] + x;
    }

    /** Returns the edge vector from the first corner along the unit coordinate
     *  @p k. */
    dealii::Tensor<1, n>
    edge(const unsigned int k) const
    {
      return (k == 0 ? corners[1] : corners.back()) - corners[0];
    }

    /** Returns the mean of the corners of the boundary part. */
    dealii::Point<n>
    middle() const
    {
      dealii::Point<n> sum;
      for (const dealii::Point<n> &corner : corners)
        sum += corner / double(corners.size());
      return sum;
    }

    /** Decomposes the boundary part into simplices (lines or triangles). In two
     *  dimensions the simplex is the line itself; in three dimensions triangles
     *  share the first corner of the convex polygon. */
    std::vector<Outline>
    simplices() const
    {
      if (dim == 2)
        return {*this};
      std::vector<Outline> all;
      for (std::size_t i = 2; i < corners.size(); ++i)
        all.push_back({{corners[0], corners[i - 1], corners[i]}});
      return all;
    }

    std::vector<dealii::Point<n>> corners;
  };

  /** Oriented part of a boundary segment of the body. In two dimensions the
   *  body is on the left of the line; in three dimensions the corners are
   *  counterclockwise as seen from outside. */
  using SidePart = Outline<dim>;

  /** Returns the outward normal vector of a boundary part, scaled by the length
   *  (m) or area (m^2). */
  dealii::Tensor<1, dim>
  area_of(const SidePart &part);

  /** @name Conversion between a line (in three dimensions a parallelogram) and
   *  the first corner with the other ends of the adjacent edges */
  /** @{ */
  SidePart
  spanned_by(const std::array<dealii::Point<dim>, dim> &ends);

  std::array<dealii::Point<dim>, dim>
  ends_of(const SidePart &part);
  /** @} */

  /** Returns the part of a line or quadrilateral in a given range of unit
   *  coordinates. */
  SidePart
  part_of(const SidePart &whole, const UnitPart &part);

  /** Divides a line or quadrilateral into n[k] equal parts along each edge
   *  k. */
  std::vector<SidePart>
  parts_of(const SidePart &whole, const std::array<unsigned int, dim - 1> &n);
} // namespace geocone::GEOCONE_DIM

#endif
