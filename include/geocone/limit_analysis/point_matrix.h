// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_point_matrix_h
#define geocone_limit_analysis_point_matrix_h

#include <geocone/limit_analysis/block_matrix.h>
#include <geocone/limit_analysis/point_strains.h>

#include <vector>

namespace geocone
{
  /** Matrix sum_p B_p' C_p B_p of the free dofs of some points, C_p symmetric 3 x 3,
   *  with its Cholesky factors. */
  class PointMatrix : public BlockMatrix
  {
  public:
    /** Creates the sparsity pattern. @param is_prescribed by dof */
    PointMatrix(const std::vector<bool> &is_prescribed,
                const PointStrains      &strains);

    /** Blocks C_p of all points. */
    using Blocks = std::vector<Eigen::Matrix3d>;

    /** Assembles and factorises.
     *  @return whether the matrix is positive definite */
    bool
    factorise(const Blocks &blocks);

  private:
    const PointStrains &strains;
  };
} // namespace geocone

#endif
