// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conic/small_matrices.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace geocone::small_matrices
{
  void
  factorise(
    const int m, const int n, const double *A, double *Q, double *R_inverse)
  {
    double R[most * most], reflector[most * most];
    std::copy(A, A + m * n, R);
    std::fill(reflector, reflector + m * n, 0.);
    // Applies 1 - 2 v v', where v is zero before the row j.
    const auto reflect = [m](const double *v, const int j, double *x) {
      double along = 0.;
      for (int i = j; i < m; ++i)
        along += v[i] * x[i];
      for (int i = j; i < m; ++i)
        x[i] -= 2. * along * v[i];
    };
    for (int j = 0; j < n; ++j)
      {
        double *const v    = reflector + m * j;
        double        norm = 0.;
        for (int i = j; i < m; ++i)
          {
            v[i] = R[i + m * j];
            norm += v[i] * v[i];
          }
        v[j] += std::copysign(std::sqrt(norm), v[j]);
        norm = 0.;
        for (int i = j; i < m; ++i)
          norm += v[i] * v[i];
        if (norm > 0.)
          for (int i = j; i < m; ++i)
            v[i] /= std::sqrt(norm);
        for (int c = j; c < n; ++c)
          reflect(v, j, R + m * c);
      }
    for (int c = 0; c < n; ++c)
      {
        double *const q = Q + m * c;
        std::fill(q, q + m, 0.);
        q[c] = 1.;
        for (int j = n - 1; j >= 0; --j)
          reflect(reflector + m * j, j, q);
        double *const x = R_inverse + n * c;
        std::fill(x, x + n, 0.);
        x[c] = 1. / R[c + m * c];
        for (int i = c - 1; i >= 0; --i)
          {
            double sum = 0.;
            for (int j = i + 1; j <= c; ++j)
              sum += R[i + m * j] * x[j];
            x[i] = -sum / R[i + m * i];
          }
      }
  }

  void
  multiply_transpose(const int     m,
                     const int     n,
                     const int     k,
                     const double *A,
                     const double *B,
                     const double  factor,
                     double       *out)
  {
    std::fill(out, out + m * n, 0.);
    for (int l = 0; l < k; ++l)
      for (int j = 0; j < n; ++j)
        {
          const double b = factor * B[j + n * l];
          for (int i = 0; i < m; ++i)
            out[i + m * j] += b * A[i + m * l];
        }
  }

  void
  congruence(const int     m,
             const int     n,
             const double *B,
             const double *C,
             const double  factor,
             double       *out)
  {
    double CB[most];
    for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < m; ++i)
          {
            CB[i] = 0.;
            for (int k = 0; k < m; ++k)
              CB[i] += C[k + m * i] * B[k + m * j];
            CB[i] *= factor;
          }
        for (int i = 0; i < n; ++i)
          {
            double sum = 0.;
            for (int k = 0; k < m; ++k)
              sum += B[k + m * i] * CB[k];
            out[i + n * j] = sum;
          }
      }
  }

  int
  pseudo_inverse_of_transpose(
    const int m, const int n, const double *A, double *result, double *null)
  {
    using Eigen::MatrixXd;
    const Eigen::JacobiSVD<MatrixXd> svd(Eigen::Map<const MatrixXd>(A, m, n),
                                         Eigen::ComputeFullU |
                                           Eigen::ComputeFullV);
    const Eigen::VectorXd            values = svd.singularValues();
    MatrixXd                         sum    = MatrixXd::Zero(m, n);
    int                              rank   = 0;
    for (; rank < values.size() && values[rank] > 1e-10 * values[0]; ++rank)
      sum += svd.matrixU().col(rank) * svd.matrixV().col(rank).transpose() /
             values[rank];
    const MatrixXd rest = svd.matrixU().rightCols(m - rank);
    std::copy(sum.data(), sum.data() + sum.size(), result);
    std::copy(rest.data(), rest.data() + rest.size(), null);
    return m - rank;
  }
} // namespace geocone::small_matrices
