// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_text_of_place_h
#define geocone_base_text_of_place_h

#include <geocone/base/log.h>
#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Formats the components of a vector as a comma-separated list. Each
   *  component has the printf() format @p number. */
  inline std::string
  text_of_vector(const dealii::Tensor<1, dim> &x, const char *number)
  {
    std::string text;
    for (unsigned int c = 0; c < dim; ++c)
      text += (c == 0 ? "" : ", ") + format(number, x[c]);
    return text;
  }

  /** Formats the coordinates of a point as a comma-separated list, e.g.
   *  "0.5, -2". */
  inline std::string
  text_of_place(const dealii::Point<dim> &x)
  {
    return text_of_vector(x, "%g");
  }
} // namespace geocone::GEOCONE_DIM

#endif
