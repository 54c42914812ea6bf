// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_cone_algebra_h
#define geocone_limit_analysis_cone_algebra_h

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

/** Jordan algebra of the cone {|x_t| <= x_0} of three components, and the pointwise
 *  operations of an interior-point method in it. */
namespace geocone::cone_algebra
{
  inline double
  root_of_determinant(const Eigen::Vector3d &x)
  {
    const double t = x.tail<2>().norm();
    return std::sqrt(std::max((x[0] - t) * (x[0] + t), 0.));
  }

  /** The Jordan product. */
  inline Eigen::Vector3d
  product(const Eigen::Vector3d &u, const Eigen::Vector3d &v)
  {
    Eigen::Vector3d p;
    p[0]        = u.dot(v);
    p.tail<2>() = u[0] * v.tail<2>() + v[0] * u.tail<2>();
    return p;
  }

  /** Solution y of product(l, y) = d. */
  inline Eigen::Vector3d
  divide(const Eigen::Vector3d &l, const Eigen::Vector3d &d)
  {
    const double    t = l.tail<2>().norm();
    Eigen::Vector3d y;
    y[0] =
      (l[0] * d[0] - l.tail<2>().dot(d.tail<2>())) / ((l[0] - t) * (l[0] + t));
    y.tail<2>() = (d.tail<2>() - y[0] * l.tail<2>()) / l[0];
    return y;
  }

  /** Largest step with l + step d in the cone, at most 1/0.99. */
  inline double
  step_in_cone(const Eigen::Vector3d &l, const Eigen::Vector3d &d)
  {
    // |l_t + a d_t|^2 = (l_0 + a d_0)^2: the smallest positive root.
    const double A = d[0] * d[0] - d.tail<2>().squaredNorm(),
                 B = l[0] * d[0] - l.tail<2>().dot(d.tail<2>()),
                 t = l.tail<2>().norm(), C = (l[0] - t) * (l[0] + t);
    double step = 1. / 0.99;
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

  /** Nesterov-Todd scaling of a point: W z = W^-1 x, with W = eta (w_0, w_t'; w_t, I +
   *  w_t w_t'/(1 + w_0)), w_0^2 = 1 + |w_t|^2. The matrices are applied instead of
   *  stored, since loops over the points are limited by memory bandwidth. */
  struct Scaling
  {
    double          eta;
    Eigen::Vector3d w;

    Scaling(const Eigen::Vector3d &x, const Eigen::Vector3d &z)
    {
      const double dx = root_of_determinant(x), dz = root_of_determinant(z);
      const Eigen::Vector3d u = x / dx, v = z / dz;
      const double          gamma = std::sqrt((1. + u.dot(v)) / 2.);
      w                           = u + v;
      w.tail<2>()                 = u.tail<2>() - v.tail<2>();
      w /= 2. * gamma;
      w[0] = std::sqrt(1. + w.tail<2>().squaredNorm());
      eta  = std::sqrt(dx / dz);
    }

    /** W v. */
    Eigen::Vector3d
    times(const Eigen::Vector3d &v) const
    {
      return eta * turned(w.tail<2>(), v);
    }

    /** W^-1 v. */
    Eigen::Vector3d
    inverse_times(const Eigen::Vector3d &v) const
    {
      return turned(-w.tail<2>(), v) / eta;
    }

    /** W^2 v = eta^2 (2 w w' - J) v. */
    Eigen::Vector3d
    square_times(const Eigen::Vector3d &v) const
    {
      Eigen::Vector3d r = 2. * w.dot(v) * w;
      r[0] -= v[0];
      r.tail<2>() += v.tail<2>();
      return eta * eta * r;
    }

    /** W^2. */
    Eigen::Matrix3d
    square() const
    {
      Eigen::Matrix3d S = 2. * w * w.transpose();
      S(0, 0) -= 1.;
      S(1, 1) += 1.;
      S(2, 2) += 1.;
      return eta * eta * S;
    }

    /** @name For a cylinder, with constant x_0 */
    /** @{ */
    Eigen::Matrix2d
    tangential() const
    {
      return eta * eta *
             (Eigen::Matrix2d::Identity() -
              2. * w.tail<2>() * w.tail<2>().transpose() /
                (1. + 2. * w.tail<2>().squaredNorm()));
    }
    Eigen::Vector2d
    eliminated(const Eigen::Vector3d &r) const
    {
      return r.tail<2>() - 2. * w[0] * r[0] /
                             (1. + 2. * w.tail<2>().squaredNorm()) *
                             w.tail<2>();
    }
    /** Rate dz_0 with (W^2 dz)_0 = r_0 for a given dz_t. */
    double
    first_rate(const double r_0, const Eigen::Vector2d &dz_t) const
    {
      return (r_0 / (eta * eta) - 2. * w[0] * w.tail<2>().dot(dz_t)) /
             (2. * w[0] * w[0] - 1.);
    }
    /** @} */

  private:
    /** W v/eta, or its inverse for the other sign of w_t. */
    Eigen::Vector3d
    turned(const Eigen::Vector2d &w_t, const Eigen::Vector3d &v) const
    {
      const double    along = w_t.dot(v.tail<2>());
      Eigen::Vector3d r;
      r[0]        = w[0] * v[0] + along;
      r.tail<2>() = v.tail<2>() + (v[0] + along / (1. + w[0])) * w_t;
      return r;
    }
  };
} // namespace geocone::cone_algebra

#endif
