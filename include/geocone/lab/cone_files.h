// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_lab_cone_files_h
#define geocone_lab_cone_files_h

#include <geocone/reduced/reduced_problem.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Reads a second-order-cone complementarity problem from a file in the text format of
   * Siconos. The file contains the dimension, the number n of cones, the model type
   * (plasticity only: 1; absent in older files), the matrix storage, the numbers of
   * rows and columns, the matrix W, the vector q, and the coefficients of the cones.
   * The matrix is dense (storage 0: numbers of rows and columns, rows), block-sparse
   * (storage 1) or sparse (storage 2: 1, 2 or 3 for triplets, columns or rows, and the
   * matrix as printed by CSparse).
   *  - Plasticity, dimension 3: for each cone an aperture eta = a, then for each a
   *    coefficient theta. The change of variable of the file is z + theta |z_t| n, so
   *    that theta = a - b. There is no cohesion: stresses are relative to the apex.
   *    Siconos' type 2, von Mises in plane stress, is not a cone.
   *  - Frictional contact, dimension 2 or 3: for each cone mu = a, b = 0, and
   *    optionally a flag. s are impulses, z relative velocities, n before t. In two
   *    dimensions there is no motion in the third direction.
   * @throws InputError naming the file if it is missing, truncated, contains
   * non-numbers, or describes another problem
   */
  ReducedProblem
  read_siconos(const std::string &file_name);

  /** Returns true if a file is an HDF5 file in the format of FCLib (Acary et al.
   *  2014). */
  bool
  is_fclib(const std::string &file_name);

  /**
   * Reads a two- or three-dimensional frictional contact problem from a file in the
   * format of FCLib. The problem is either local,
   *   u = W r + q,
   * or global, M v = H r + f, u = H' v + w, and then reduced to W = H' M^-1 H and q =
   * H' M^-1 f + w. Coefficients of the cones: a = mu, b = 0.
   * @throws RunError or InputError naming the file and the error in it, also for
   * bilateral constraints and rolling friction
   */
  ReducedProblem
  read_fclib(const std::string &file_name);
} // namespace geocone::GEOCONE_DIM

#endif
