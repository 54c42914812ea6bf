// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_cone_algebra_h
#define geocone_conic_cone_algebra_h

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

/** Jordan algebra of the second-order cone {|x_t| <= x_0} in N dimensions, for
 *  interior-point methods. */
namespace geocone::cone_algebra
{
  template <int N>
  using ConeVector = Eigen::Matrix<double, N, 1>;

  template <int N>
  double
  root_of_determinant(const ConeVector<N> &x)
  {
    const double t = x.template tail<N - 1>().norm();
    return std::sqrt(std::max((x[0] - t) * (x[0] + t), 0.));
  }

  /** Returns the Jordan product of u and v: (u.v, u_0 v_t + v_0 u_t). */
  template <int N>
  ConeVector<N>
  product(const ConeVector<N> &u, const ConeVector<N> &v)
  {
    ConeVector<N> p;
    p[0] = u.dot(v);
    p.template tail<N - 1>() =
      u[0] * v.template tail<N - 1>() + v[0] * u.template tail<N - 1>();
    return p;
  }

  /** Returns the solution y of product(l, y) = d, the inverse of the Jordan product. */
  template <int N>
  ConeVector<N>
  divide(const ConeVector<N> &l, const ConeVector<N> &d)
  {
    const double  t = l.template tail<N - 1>().norm();
    ConeVector<N> y;
    y[0] =
      (l[0] * d[0] - l.template tail<N - 1>().dot(d.template tail<N - 1>())) /
      ((l[0] - t) * (l[0] + t));
    y.template tail<N - 1>() =
      (d.template tail<N - 1>() - y[0] * l.template tail<N - 1>()) / l[0];
    return y;
  }

  /** Returns the largest step length for which l + step d is in the cone,
   *  capped at 1/0.99 (the solver takes 0.99 of it, at most 1). */
  template <int N>
  double
  step_in_cone(const ConeVector<N> &l, const ConeVector<N> &d)
  {
    // |l_t + a d_t|^2 = (l_0 + a d_0)^2: the smallest positive root.
    const double A = d[0] * d[0] - d.template tail<N - 1>().squaredNorm(),
                 B = l[0] * d[0] -
                     l.template tail<N - 1>().dot(d.template tail<N - 1>()),
                 t = l.template tail<N - 1>().norm(),
                 C = (l[0] - t) * (l[0] + t);
    double step    = 1. / 0.99;
    if (d[0] < 0.)
      step = std::min(step, -l[0] / d[0]);
    const double discriminant = B * B - A * C;
    if (discriminant >= 0.)
      {
        // A a^2 + 2 B a + C = 0, without cancellation.
        const double r = -(B + std::copysign(std::sqrt(discriminant), B));
        for (const double root : {A != 0. ? r / A : -1., r != 0. ? C / r : -1.})
          if (root > 0.)
            step = std::min(step, root);
      }
    return step;
  }

  /** Nesterov-Todd scaling W of a pair of cone vectors x and z, with W z = W^-1 x. The
   *  matrix is W = eta (w_0, w_t'; w_t, I + w_t w_t'/(1 + w_0)) with w_0^2 = 1 + |w_t|^2.
   *  Matrices are applied instead of stored, since loops over the points are limited by
   *  memory bandwidth. */
  template <int N>
  struct Scaling
  {
    double        eta;
    ConeVector<N> w;

    Scaling() = default;
    Scaling(const ConeVector<N> &x, const ConeVector<N> &z)
    {
      const double dx = root_of_determinant(x), dz = root_of_determinant(z);
      const ConeVector<N> u = x / dx, v = z / dz;
      const double        gamma = std::sqrt((1. + u.dot(v)) / 2.);
      w                         = u + v;
      w.template tail<N - 1>() =
        u.template tail<N - 1>() - v.template tail<N - 1>();
      w /= 2. * gamma;
      w[0] = std::sqrt(1. + w.template tail<N - 1>().squaredNorm());
      eta  = std::sqrt(dx / dz);
    }

    /** Returns the product W v of the Nesterov-Todd scaling W and a vector
     *  v. */
    ConeVector<N>
    times(const ConeVector<N> &v) const
    {
      return eta * turned(w.template tail<N - 1>(), v);
    }

    /** Returns the product W^-1 v of the inverse Nesterov-Todd scaling and a
     *  vector v. */
    ConeVector<N>
    inverse_times(const ConeVector<N> &v) const
    {
      return turned(-w.template tail<N - 1>(), v) / eta;
    }

    /** Returns the product of the squared Nesterov-Todd scaling and a vector,
     *  W^2 v = eta^2 (2 w w' - J) v, with J = diag(1, -1, ..., -1). */
    ConeVector<N>
    square_times(const ConeVector<N> &v) const
    {
      ConeVector<N> r = 2. * w.dot(v) * w;
      r[0] -= v[0];
      r.template tail<N - 1>() += v.template tail<N - 1>();
      return eta * eta * r;
    }

    /** Returns the squared Nesterov-Todd scaling W^2 as a matrix. */
    Eigen::Matrix<double, N, N>
    square() const
    {
      Eigen::Matrix<double, N, N> S = 2. * w * w.transpose();
      S(0, 0) -= 1.;
      for (int i = 1; i < N; ++i)
        S(i, i) += 1.;
      return eta * eta * S;
    }

    /** @name Elimination of z_0 for a cylinder, i.e. constant x_0 */
    /** @{ */
    Eigen::Matrix<double, N - 1, N - 1>
    tangential() const
    {
      return eta * eta *
             (Eigen::Matrix<double, N - 1, N - 1>::Identity() -
              2. * w.template tail<N - 1>() *
                w.template tail<N - 1>().transpose() /
                (1. + 2. * w.template tail<N - 1>().squaredNorm()));
    }
    ConeVector<N - 1>
    eliminated(const ConeVector<N> &r) const
    {
      return r.template tail<N - 1>() -
             2. * w[0] * r[0] /
               (1. + 2. * w.template tail<N - 1>().squaredNorm()) *
               w.template tail<N - 1>();
    }
    /** Returns the component dz_0 of a vector dz that satisfies (W^2 dz)_0 =
     *  r_0 for given components dz_t, with the Nesterov-Todd scaling W. */
    double
    first_rate(const double r_0, const ConeVector<N - 1> &dz_t) const
    {
      return (r_0 / (eta * eta) -
              2. * w[0] * w.template tail<N - 1>().dot(dz_t)) /
             (2. * w[0] * w[0] - 1.);
    }
    /** @} */

  private:
    /** Returns the product of the normalised Nesterov-Todd scaling W/eta (for
     *  the argument w_t), or of its inverse (for -w_t), and a vector v. */
    ConeVector<N>
    turned(const ConeVector<N - 1> &w_t, const ConeVector<N> &v) const
    {
      const double  along = w_t.dot(v.template tail<N - 1>());
      ConeVector<N> r;
      r[0] = w[0] * v[0] + along;
      r.template tail<N - 1>() =
        v.template tail<N - 1>() + (v[0] + along / (1. + w[0])) * w_t;
      return r;
    }
  };
} // namespace geocone::cone_algebra

#endif
