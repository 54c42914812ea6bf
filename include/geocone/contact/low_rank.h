// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_low_rank_h
#define geocone_contact_low_rank_h

#include <Eigen/Dense>

namespace geocone
{
  /** Low-rank part U W' of a Jacobian, by the owned free rows and columns. */
  struct LowRank
  {
    Eigen::MatrixXd U, W;

    /** Number of columns, the same on all ranks. */
    unsigned int
    rank() const
    {
      return U.cols();
    }
  };
} // namespace geocone

#endif
