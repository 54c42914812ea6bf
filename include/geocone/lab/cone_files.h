// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_lab_cone_files_h
#define geocone_lab_cone_files_h

#include <geocone/reduced/reduced_problem.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Reads a problem in the text format of Siconos: dimension, number n of cones, type of
   * the model (only of plasticity: 1; absent in older files), storage of the matrix, its
   * rows and columns, the matrix W, q, and the coefficients of the cones. The matrix is
   * dense (storage 0: its numbers of rows and columns, and its rows), of blocks (storage
   * 1) or sparse (storage 2: 1, 2 or 3 for triplets, columns or rows, and what CSparse
   * prints of such a matrix).
   *  - Plasticity, dimension 3: for each cone an aperture eta = a, then for each a
   *    coefficient theta. The change of variable of the file is z + theta |z_t| n, so
   *    that theta = a - b. There is no cohesion: stresses are measured from the apex.
   *    Siconos' type 2, von Mises in plane stress, is no cone.
   *  - Contact with friction, dimension 2 or 3: for each cone mu = a, b = 0, and perhaps
   *    a flag. s are impulses, z relative velocities, n before t. In two dimensions the
   *    third direction is one in which nothing moves.
   * @throws InputError naming the file if it is missing, cut, has something that
   * is not a number, or describes anything else than the above
   */
  ReducedProblem
  read_siconos(const std::string &file_name);

  /** Whether a file is one of HDF5 that holds a problem of FCLib (Acary et al. 2014). */
  bool
  is_fclib(const std::string &file_name);

  /**
   * Reads a problem of contact with friction of FCLib, dimension 2 or 3: a local one,
   *   u = W r + q,
   * or a global one, M v = H r + f, u = H' v + w, of which W = H' M^-1 H and
   * q = H' M^-1 f + w are taken. mu = a, b = 0.
   * @throws RunError or InputError naming the file and what is wrong in it, or that it
   * has bilateral constraints or rolling friction
   */
  ReducedProblem
  read_fclib(const std::string &file_name);
} // namespace geocone::GEOCONE_DIM

#endif
