// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shapes_edge_normal_h
#define geocone_shapes_edge_normal_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

namespace geocone::GEOCONE_DIM
{
  /** Normal to the edge from a to b, on its right-hand side, with the length of
   *  the edge. It points outward if the body is on the left. */
  inline dealii::Tensor<1, dim>
  edge_normal(const dealii::Point<dim> &a, const dealii::Point<dim> &b)
  {
    dealii::Tensor<1, dim> n;
    n[0] = b[1] - a[1];
    n[1] = a[0] - b[0];
    return n;
  }
} // namespace geocone::GEOCONE_DIM

#endif
