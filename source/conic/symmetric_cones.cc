// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conic/symmetric_cones.h>

namespace geocone
{
  SemidefiniteCone::V
  SemidefiniteCone::raised(const V &x, const double least)
  {
    const Eigen::SelfAdjointEigenSolver<M> solver(matrix(x));
    const Eigen::Vector3d l = solver.eigenvalues().cwiseMax(least);
    return vector(solver.eigenvectors() * l.asDiagonal() *
                  solver.eigenvectors().transpose());
  }

  double
  SemidefiniteCone::excess(const V &x)
  {
    return std::max(
      -Eigen::SelfAdjointEigenSolver<M>(matrix(x), Eigen::EigenvaluesOnly)
         .eigenvalues()[0],
      0.);
  }

  SemidefiniteCone::V
  SemidefiniteCone::correction(const V &v, const double target)
  {
    const Eigen::SelfAdjointEigenSolver<M> solver(matrix(v));
    Eigen::Vector3d                        c = solver.eigenvalues();
    for (double &value : c)
      value = correction_of_eigenvalue(value, target);
    return vector(solver.eigenvectors() * c.asDiagonal() *
                  solver.eigenvectors().transpose());
  }

  SemidefiniteCone::Scaling::Scaling(const V &x, const V &z)
  {
    const M L_1 = matrix(x).llt().matrixL(), L_2 = matrix(z).llt().matrixL();
    // Iterates that are not finite must stay so, to be found.
    l.setConstant(std::nan(""));
    R = R_inverse = M::Constant(std::nan(""));
    lambda.setConstant(std::nan(""));
    const Eigen::JacobiSVD<M> svd(L_2.transpose() * L_1,
                                  Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.info() != Eigen::Success)
      return;
    l                       = svd.singularValues();
    const Eigen::Vector3d r = l.cwiseSqrt().cwiseInverse();
    R                       = L_1 * svd.matrixV() * r.asDiagonal();
    R_inverse = r.asDiagonal() * svd.matrixU().transpose() * L_2.transpose();
    lambda    = vector(M(l.asDiagonal()));
  }

  double
  SemidefiniteCone::Scaling::step(const V &d) const
  {
    const Eigen::Vector3d r = l.cwiseSqrt().cwiseInverse();
    const M               m = r.asDiagonal() * matrix(d) * r.asDiagonal();
    const double          least =
      Eigen::SelfAdjointEigenSolver<M>(m, Eigen::EigenvaluesOnly)
        .eigenvalues()[0];
    return least < -0.99 ? -1. / least : 1. / 0.99;
  }
} // namespace geocone
