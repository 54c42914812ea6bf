// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_small_matrices_h
#define geocone_limit_analysis_small_matrices_h

/** Algebra of matrices of a point, column by column in memory, whose sizes are known at run
 *  time: compiled once for all laws. */
namespace geocone::small_matrices
{
  constexpr int most = 16; ///< rows and columns

  /** Householder's A = Q R, m >= n.
   *  @param[out] Q m x n @param[out] R_inverse n x n, upper triangle, zero below */
  void
  factorise(
    const int m, const int n, const double *A, double *Q, double *R_inverse);

  /** out = factor A B', A m x k, B n x k. */
  void
  multiply_transpose(const int     m,
                     const int     n,
                     const int     k,
                     const double *A,
                     const double *B,
                     const double  factor,
                     double       *out);

  /** out = factor B' C B, C m x m, symmetric, B m x n. */
  void
  congruence(const int     m,
             const int     n,
             const double *B,
             const double *C,
             const double  factor,
             double       *out);

  /**
   * Pseudo-inverse of A', m x n as A, and an orthonormal basis of the null space of A'.
   * @param[out] null m x m, of which the columns are used that are returned
   * @return number of columns of the basis
   */
  int
  pseudo_inverse_of_transpose(
    const int m, const int n, const double *A, double *result, double *null);
} // namespace geocone::small_matrices

#endif
