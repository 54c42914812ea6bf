// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_small_matrices_h
#define geocone_conic_small_matrices_h

/** Algebra of small matrices with sizes known at run time, stored by columns. The
 *  functions are compiled once for all strength laws. */
namespace geocone::small_matrices
{
  constexpr int most = 16; ///< maximum number of rows or columns

  /** Computes the QR factorisation A = Q R of an m x n matrix, m >= n, by Householder
   *  reflections.
   *  @param[out] Q m x n @param[out] R_inverse n x n, upper triangle, zero below */
  void
  factorise(
    const int m, const int n, const double *A, double *Q, double *R_inverse);

  /** Computes out = factor A B' for matrices A (m x k) and B (n x k). */
  void
  multiply_transpose(const int     m,
                     const int     n,
                     const int     k,
                     const double *A,
                     const double *B,
                     const double  factor,
                     double       *out);

  /** Computes out = factor B' C B for a symmetric matrix C (m x m) and a matrix B (m x
   *  n). */
  void
  congruence(const int     m,
             const int     n,
             const double *B,
             const double *C,
             const double  factor,
             double       *out);

  /**
   * Computes the pseudo-inverse of A' and an orthonormal basis of the null space of A'.
   * The pseudo-inverse is m x n, like A.
   * @param[out] null m x m matrix, whose first columns are the basis
   * @return number of columns of the basis
   */
  int
  pseudo_inverse_of_transpose(
    const int m, const int n, const double *A, double *result, double *null);
} // namespace geocone::small_matrices

#endif
