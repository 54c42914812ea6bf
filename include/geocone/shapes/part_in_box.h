// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shapes_part_in_box_h
#define geocone_shapes_part_in_box_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  /** Clips the segment ab to a box given by two corners. Returns the end points
   *  of the clipped segment; no value if the segment does not intersect the
   *  box. */
  inline std::optional<std::array<dealii::Point<dim>, 2>>
  part_in_box(const std::array<dealii::Point<dim>, 2> &box,
              const dealii::Point<dim>                &a,
              const dealii::Point<dim>                &b)
  {
    const dealii::Tensor<1, dim> along = b - a;
    double                       from = 0., to = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double low = box[0][d] - a[d], high = box[1][d] - a[d];
        if (std::abs(along[d]) > 1e-12 * along.norm())
          {
            from = std::max(from, std::min(low / along[d], high / along[d]));
            to   = std::min(to, std::max(low / along[d], high / along[d]));
          }
        else if (low > 0. || high < 0.)
          return std::nullopt;
      }
    if (from > to)
      return std::nullopt;
    return std::array<dealii::Point<dim>, 2>{
      {dealii::Point<dim>(a + from * along),
       dealii::Point<dim>(a + to * along)}};
  }
} // namespace geocone::GEOCONE_DIM

#endif
