// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/reduced/reduced_problem.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    Eigen::LLT<MatrixXd>
    factorised(const MatrixXd &L)
    {
      Eigen::LLT<MatrixXd> factors(L);
      if (factors.info() != Eigen::Success)
        throw RunError("The matrix of the constraints, H M^-1 H', is not "
                       "positive definite: constraints are redundant");
      return factors;
    }
  } // namespace

  VectorXd
  ReducedProblem::nodal(const VectorXd &s) const
  {
    return m.cwiseProduct(G.transpose() * s);
  }

  VectorXd
  ReducedProblem::multiply(const VectorXd &s) const
  {
    if (!has_factors())
      return W * s;
    return S.cwiseProduct(s) + G * nodal(s);
  }

  MandelMatrix
  ReducedProblem::diagonal_block(const unsigned int p) const
  {
    if (has_factors())
      {
        const Matrix rows     = G.middleRows(n_mandel * p, n_mandel);
        const Matrix weighted = rows * m.asDiagonal();
        MandelMatrix block    = MatrixXd(weighted * rows.transpose());
        block.diagonal() += S.segment<n_mandel>(n_mandel * p);
        return block;
      }
    return MatrixXd(W.block(n_mandel * p, n_mandel * p, n_mandel, n_mandel));
  }

  VectorXd
  ReducedProblem::z(const VectorXd &s, const VectorXd &lambda) const
  {
    VectorXd result = multiply(s) + q;
    if (n_multipliers() > 0)
      result -= C * lambda;
    return result;
  }

  VectorXd
  ReducedProblem::multipliers(const VectorXd &s) const
  {
    if (n_multipliers() == 0)
      return {};
    return factorised(L).solve(C.transpose() * s - d);
  }

  ReducedProblem
  ReducedProblem::projected() const
  {
    if (n_multipliers() == 0)
      return *this;
    const auto factors = factorised(L);
    MatrixXd   dense   = W;
    if (has_factors())
      {
        dense = G * Matrix(m.asDiagonal() * G.transpose());
        dense.diagonal() += S;
      }
    ReducedProblem result;
    result.cones = cones;
    result.S     = S;
    result.W     = (dense - C * factors.solve(C.transpose())).sparseView();
    result.q     = q + C * factors.solve(d);
    return result;
  }

  double
  ReducedProblem::natural_map_error(const VectorXd &s) const
  {
    const VectorXd zs    = z(s, multipliers(s));
    double         error = 0., size = 0., cohesion = 0.;
    for (unsigned int p = 0; p < n_cones(); ++p)
      {
        const Mandel sp = s.segment<n_mandel>(n_mandel * p);
        error           = std::max(error,
                         natural_map_norm(cones[p],
                                          sp,
                                          zs.segment<n_mandel>(n_mandel * p),
                                          natural_scale(diagonal_block(p))));
        size            = std::max(size, sp.norm());
        cohesion        = std::max(cohesion, cones[p].k);
      }
    if (!s.allFinite())
      return std::numeric_limits<double>::infinity();
    return error > 0. ? error / (size + cohesion) : 0.;
  }
} // namespace geocone::GEOCONE_DIM
