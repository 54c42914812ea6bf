// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_structured_mesh_h
#define geocone_mesh_structured_mesh_h

#include <geocone/mesh/coarse_mesh.h>
#include <geocone/mesh/mesh_parameters.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Number of cells in each direction of a uniform or graded box mesh, computed
   * without creating the mesh. Uniform: length / size, rounded, at least 1.
   * Graded: over a length L from a fine end, the sizes s, s g, s g^2, ..., of
   * which k = ceil(ln(l/s) / ln g) are smaller than the largest size l, sum up
   * to
   *   S_n = s (g^n - 1)/(g - 1) for n <= k, and S_k + (n - k) l beyond;
   * the number is the smallest n with S_n >= L. Between two grading points,
   * rounding can make it differ from grid_lines() by one.
   */
  std::array<double, dim>
  grid_size(const MeshParameters &parameters);

  /** Grid line coordinates of a uniform or graded mesh of a box (m). */
  std::array<std::vector<double>, dim>
  grid_lines(const MeshParameters &parameters);

  /** Creates a uniform or graded mesh of a box. */
  CoarseMesh
  structured_mesh(const MeshParameters &parameters);
} // namespace geocone::GEOCONE_DIM

#endif
