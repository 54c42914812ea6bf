// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_cone_algebra_h
#define geocone_limit_analysis_cone_algebra_h

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

/** The Jordan algebra of the cone {|x_t| <= x_0} of three components, and what an
 *  interior point method does with it, point by point. */
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

  /** y with product(l, y) = d. */
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

  /** The largest step with l + step d in the cone, at most 1/0.99. */
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

  /** Nesterov's and Todd's scaling of a point: W z = W^-1 x. */
  struct Scaling
  {
    double          eta2;
    Eigen::Vector3d w;
    Eigen::Matrix3d W, inverse, square;

    Scaling(const Eigen::Vector3d &x, const Eigen::Vector3d &z)
    {
      const double dx = root_of_determinant(x), dz = root_of_determinant(z);
      const Eigen::Vector3d u = x / dx, v = z / dz;
      const double          gamma = std::sqrt((1. + u.dot(v)) / 2.);
      w                           = u + v;
      w.tail<2>()                 = u.tail<2>() - v.tail<2>();
      w /= 2. * gamma;
      w[0]                = std::sqrt(1. + w.tail<2>().squaredNorm());
      eta2                = dx / dz;
      const double    eta = std::sqrt(eta2);
      Eigen::Matrix3d S;
      S(0, 0)             = w[0];
      S.block<1, 2>(0, 1) = w.tail<2>().transpose();
      S.block<2, 1>(1, 0) = w.tail<2>();
      S.block<2, 2>(1, 1) = Eigen::Matrix2d::Identity() +
                            w.tail<2>() * w.tail<2>().transpose() / (1. + w[0]);
      W = eta * S;
      S.block<1, 2>(0, 1) *= -1.;
      S.block<2, 1>(1, 0) *= -1.;
      inverse = S / eta;
      square  = 2. * w * w.transpose();
      square(0, 0) -= 1.;
      square(1, 1) += 1.;
      square(2, 2) += 1.;
      square *= eta2;
    }

    /** @name Of a cylinder, whose x_0 does not change */
    /** @{ */
    Eigen::Matrix2d
    tangential() const
    {
      return eta2 * (Eigen::Matrix2d::Identity() -
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
    /** @} */
  };
} // namespace geocone::cone_algebra

#endif
