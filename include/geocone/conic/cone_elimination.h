// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_cone_elimination_h
#define geocone_conic_cone_elimination_h

#include <geocone/conic/small_matrices.h>

#include <Eigen/Dense>

#include <cmath>

namespace geocone
{
  /** Penalty stiffness, in the method of multipliers, of the strain rates that the flow
   *  rule constrains to zero. Strength, lengths and velocities are of order one. */
  constexpr double constrained_stiffness = 1e6;

  /**
   * Elimination of the cone variables of a point from the equations of Newton's
   * direction, which are, for an increment e of the strain rate,
   *   W^-T dX + W dZ = d, dX = -A dy, A'dZ = residual + (w e, 0).
   * Each strength law has such a class, with these members; this one is for any law. It
   * has the QR factors of the matrix A, scaled by the Nesterov-Todd scaling W: their
   * products are far more accurate than the inverse of A'W^-1W^-T A.
   */
  template <typename Law>
  class ConeElimination
  {
  public:
    static constexpr int rows = Law::rows, columns = Law::columns,
                         size = Law::size;
    using Y                   = typename Law::Y;
    using S                   = typename Law::S;
    using X                   = typename Law::X;
    using C                   = Eigen::Matrix<double, rows, rows>;

    typename Law::Cone::Scaling scaling;

    void
    scale(const Law &law, const X &x, const X &z, const double w)
    {
      scaling = typename Law::Cone::Scaling(x, z);
      Eigen::Matrix<double, size + 1, columns> scaled;
      for (int j = 0; j < columns; ++j)
        scaled.col(j).template head<size>() = scaling.x_hat(law.A.col(j));
      scaled.template bottomRows<1>() =
        std::sqrt(w / constrained_stiffness) * law.null_vector.transpose();
      small_matrices::factorise(
        size + 1, columns, scaled.data(), Q.data(), T_inverse.data());
      from_null.setZero();
      if (const int m = law.n_null; m > 0)
        {
          Eigen::Matrix<double, size, size> WN, Q_2, T_2, T_turned, N_T;
          for (int j = 0; j < m; ++j)
            WN.col(j) = scaling.z_hat(law.null.col(j));
          small_matrices::factorise(size, m, WN.data(), Q_2.data(), T_2.data());
          for (int i = 0; i < m; ++i)
            for (int j = 0; j < m; ++j)
              T_turned.data()[j + m * i] = T_2.data()[i + m * j];
          small_matrices::multiply_transpose(
            size, m, m, law.null.data(), T_turned.data(), 1., N_T.data());
          small_matrices::multiply_transpose(
            size, size, m, N_T.data(), Q_2.data(), 1., from_null.data());
        }
    }

    /** Returns the stiffness of the point: the stress increment for a strain rate
     *  increment. */
    C
    stiffness(const double w) const
    {
      C                                          c;
      const Eigen::Matrix<double, rows, columns> upper =
        T_inverse.template topRows<rows>();
      small_matrices::multiply_transpose(
        rows, rows, columns, upper.data(), upper.data(), w, c.data());
      return c;
    }

    /** Returns the increment of the variables y for a strain rate increment. */
    Y
    response(const S &e, const double w) const
    {
      return T_inverse * (T_inverse.transpose() * Law::extended(w * e));
    }

    /** Returns the stress increment for the right-hand side d, without a strain rate
     *  increment. */
    S
    given(const X &d, const Y &residual, const double)
    {
      g = T_inverse * (T_inverse.transpose() * residual -
                       Q.template topRows<size>().transpose() * d);
      return g.template head<rows>();
    }

    /** Computes the increments for the right-hand side of given() and a strain rate
     *  increment e. */
    void
    complete(const Law   &law,
             const X     &d,
             const Y     &residual,
             const S     &e,
             const double w,
             Y           &dy,
             X           &dx,
             X           &dz) const
    {
      dy = g + response(e, w);
      dx = -(law.A * dy);
      const Y goal =
        residual + Law::extended(w * e) -
        w / constrained_stiffness * law.null_vector * law.null_vector.dot(dy);
      // Flow exactly, whatever the accuracy of C; the rest from complementarity.
      const X least = law.pseudo_inverse * goal;
      dz            = least + from_null * (d - scaling.z_hat(least));
    }

  private:
    Eigen::Matrix<double, size + 1, columns> Q;
    Eigen::Matrix<double, columns, columns>  T_inverse;
    Eigen::Matrix<double, size, size>        from_null; ///< N T_2^-1 Q_2'
    Y                                        g;
  };
} // namespace geocone

#endif
