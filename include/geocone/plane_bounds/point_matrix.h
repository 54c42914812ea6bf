// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_point_matrix_h
#define geocone_plane_bounds_point_matrix_h

#include <geocone/conic/block_matrix.h>
#include <geocone/plane_bounds/point_strains.h>

#include <vector>

namespace geocone
{
  /** Sparse symmetric stiffness matrix sum_p B_p' C_p B_p of the free dofs,
   *  with its Cholesky factors. The matrices C_p of the points are symmetric 3
   *  x 3 matrices. */
  class PointMatrix : public BlockMatrix
  {
  public:
    /** Creates the sparsity pattern of the matrix. @param is_prescribed by dof */
    PointMatrix(const std::vector<bool> &is_prescribed,
                const PointStrains      &strains);

    /** Symmetric 3 x 3 stiffness matrices C_p of all points. */
    using Blocks = std::vector<Eigen::Matrix3d>;

    /** Assembles the matrix and computes the Cholesky factorisation.
     *  @return true if the matrix is positive definite */
    bool
    factorise(const Blocks &blocks);

  private:
    const PointStrains &strains;
  };
} // namespace geocone

#endif
