// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/point_matrix.h>

namespace geocone
{
  namespace
  {
    BlockMatrix::Set
    set_of(const PointStrains &strains)
    {
      BlockMatrix::Set set = {0, strains.n_points(), nullptr};
      if (set.n_blocks > 0)
        set.dofs = strains.dofs_of(0);
      strains.with_n_columns(
        [&](const auto size) { set.n_columns = decltype(size)::value; });
      return set;
    }
  } // namespace

  PointMatrix::PointMatrix(const std::vector<bool> &is_prescribed,
                           const PointStrains      &strains)
    : BlockMatrix(is_prescribed, {set_of(strains)})
    , strains(strains)
  {}

  bool
  PointMatrix::factorise(const Blocks &blocks)
  {
    clear();
    strains.with_n_columns([&](const auto size) {
      constexpr int               n = decltype(size)::value;
      Eigen::Matrix<double, 3, n> CB;
      Eigen::Matrix<double, n, n> BCB;
      for (unsigned int p = 0; p < strains.n_points(); ++p)
        {
          const auto B  = strains.matrix<n>(p);
          CB.noalias()  = blocks[p].lazyProduct(B);
          BCB.noalias() = B.transpose().lazyProduct(CB);
          add<n>(0, p, BCB);
        }
    });
    return BlockMatrix::factorise();
  }
} // namespace geocone
