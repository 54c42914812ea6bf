// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_low_rank_h
#define geocone_contact_low_rank_h

#include <Eigen/Dense>

namespace geocone
{
  /** Low-rank contribution U W' to a Jacobian, with two matrices U and W of few
   *  columns. The rows of U and W are the owned free dofs. */
  struct LowRank
  {
    Eigen::MatrixXd U, W;

    /** Rank of the matrix U W', i.e. the number of columns of U and of W. The
     *  same on all ranks. */
    unsigned int
    rank() const
    {
      return U.cols();
    }
  };
} // namespace geocone

#endif
