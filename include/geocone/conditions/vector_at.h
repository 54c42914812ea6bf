// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_vector_at_h
#define geocone_conditions_vector_at_h

#include <geocone/base/types.h>

#include <deal.II/base/tensor.h>

namespace geocone::GEOCONE_DIM
{
  /** Reads the dim components of a vector from consecutive memory locations. The
   *  inverse is put(). */
  inline dealii::Tensor<1, dim>
  taken(const double *at)
  {
    dealii::Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = at[d];
    return x;
  }

  inline void
  put(const dealii::Tensor<1, dim> &x, double *at)
  {
    for (unsigned int d = 0; d < dim; ++d)
      at[d] = x[d];
  }
} // namespace geocone::GEOCONE_DIM

#endif
