// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_symmetric_cones_h
#define geocone_conic_symmetric_cones_h

#include <geocone/conic/cone_algebra.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

/**
 * Symmetric cones for interior-point methods. All classes have the same members:
 *   size, degree  number of components, and of eigenvalues summed by the scalar product,
 *   unit()        identity of the Jordan product, unit.unit = degree,
 *   raised(x, e)  x with eigenvalues of at least e,
 *   product(u, v) Jordan product; unit.product(u, v) = u.v,
 *   excess(x)     the least e >= 0 for which x + e unit is in the cone (summed over the
 *                 factors of a product of cones),
 *   correction(v, target) eigenvalues of v moved to the neighbourhood of a target, less v,
 *   Scaling(x, z) Nesterov-Todd scaling of x and z inside the cone: lambda = W z = W^-T x,
 *                 x_hat(d) = W^-T d, z_hat(d) = W d, z_of(d) = W^-1 d,
 *                 divide(d): the y with product(lambda, y) = d,
 *                 step(d): the largest step with lambda + step d in the cone, at most
 *                 1/0.99.
 */
namespace geocone
{
  /** Returns the change of an eigenvalue of x o z that moves it to the neighbourhood
   *  [0.1, 10] of a target, in Gondzio's corrector (1996). */
  inline double
  correction_of_eigenvalue(const double value, const double target)
  {
    constexpr double near = 0.1;
    return std::max(std::clamp(value, near * target, target / near) - value,
                    -target / near);
  }

  /** Second-order cone {|x_t| <= x_0} in N dimensions. For N = 1 it is the half-line. */
  template <int N>
  struct SecondOrderCone
  {
    static constexpr int size = N, degree = 1;
    using V = Eigen::Matrix<double, N, 1>;

    static V
    unit()
    {
      V e  = V::Zero();
      e[0] = 1.;
      return e;
    }

    static V
    raised(const V &x, const double least)
    {
      V y  = x;
      y[0] = std::max(x[0], x.template tail<N - 1>().norm() + least);
      return y;
    }

    static V
    product(const V &u, const V &v)
    {
      return cone_algebra::product<N>(u, v);
    }

    static double
    excess(const V &x)
    {
      return std::max(x.template tail<N - 1>().norm() - x[0], 0.);
    }

    static V
    correction(const V &v, const double target)
    {
      const double T = v.template tail<N - 1>().norm(),
                   a = correction_of_eigenvalue(v[0] + T, target),
                   b = correction_of_eigenvalue(v[0] - T, target);
      V c            = V::Zero();
      c[0]           = (a + b) / 2.;
      if (T > 0.)
        c.template tail<N - 1>() =
          (a - b) / (2. * T) * v.template tail<N - 1>();
      return c;
    }

    struct Scaling
    {
      Scaling() = default;
      Scaling(const V &x, const V &z)
        : w(x, z)
        , lambda(w.times(z))
      {}

      V
      x_hat(const V &d) const
      {
        return w.inverse_times(d);
      }
      V
      z_hat(const V &d) const
      {
        return w.times(d);
      }
      V
      z_of(const V &d) const
      {
        return w.inverse_times(d);
      }
      V
      divide(const V &d) const
      {
        return cone_algebra::divide<N>(lambda, d);
      }
      double
      step(const V &d) const
      {
        return cone_algebra::step_in_cone<N>(lambda, d);
      }

      cone_algebra::Scaling<N> w;
      V                        lambda;
    };
  };

  /** Cone of positive semidefinite 3 x 3 matrices. Matrices are stored as Mandel vectors
   *  in the order of base/types.h. */
  struct SemidefiniteCone
  {
    static constexpr int size = 6, degree = 3;
    using V = Eigen::Matrix<double, 6, 1>;
    using M = Eigen::Matrix3d;

    static M
    matrix(const V &x)
    {
      const double a = x[2] * M_SQRT1_2, b = x[4] * M_SQRT1_2,
                   c = x[5] * M_SQRT1_2;
      M m;
      m << x[0], a, c, a, x[1], b, c, b, x[3];
      return m;
    }

    /** Returns the Mandel vector of the symmetric part of a matrix. */
    static V
    vector(const M &m)
    {
      V x;
      x << m(0, 0), m(1, 1), (m(0, 1) + m(1, 0)) * M_SQRT1_2, m(2, 2),
        (m(1, 2) + m(2, 1)) * M_SQRT1_2, (m(2, 0) + m(0, 2)) * M_SQRT1_2;
      return x;
    }

    static V
    unit()
    {
      V e;
      e << 1., 1., 0., 1., 0., 0.;
      return e;
    }

    static V
    raised(const V &x, const double least);

    static V
    product(const V &u, const V &v)
    {
      return vector(matrix(u) * matrix(v));
    }

    static double
    excess(const V &x);

    static V
    correction(const V &v, const double target);

    /**
     * Nesterov-Todd scaling of two positive definite matrices X and Z, defined
     * by a matrix R. It satisfies R^-1 X R^-T = R' Z R = diag(l). For X = L_1
     * L_1', Z = L_2 L_2' and the singular value decomposition L_2' L_1 = U
     * diag(l) V', R = L_1 V diag(l)^-1/2, and R^-1 = diag(l)^-1/2 U' L_2'
     * requires no inversion.
     */
    struct Scaling
    {
      Scaling() = default;
      Scaling(const V &x, const V &z);

      V
      x_hat(const V &d) const
      {
        return vector(R_inverse * matrix(d) * R_inverse.transpose());
      }
      V
      z_hat(const V &d) const
      {
        return vector(R.transpose() * matrix(d) * R);
      }
      V
      z_of(const V &d) const
      {
        return vector(R_inverse.transpose() * matrix(d) * R_inverse);
      }
      V
      divide(const V &d) const
      {
        M m = matrix(d);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            m(i, j) *= 2. / (l[i] + l[j]);
        return vector(m);
      }
      double
      step(const V &d) const;

      M               R, R_inverse;
      Eigen::Vector3d l;
      V               lambda;
    };
  };

  /** Cartesian product of two cones. */
  template <typename A, typename B>
  struct ProductCone
  {
    static constexpr int size   = A::size + B::size,
                         degree = A::degree + B::degree;
    using V                     = Eigen::Matrix<double, size, 1>;

    static V
    both(const typename A::V &a, const typename B::V &b)
    {
      V v;
      v << a, b;
      return v;
    }
    static typename A::V
    first(const V &v)
    {
      return v.template head<A::size>();
    }
    static typename B::V
    second(const V &v)
    {
      return v.template tail<B::size>();
    }

    static V
    unit()
    {
      return both(A::unit(), B::unit());
    }
    static V
    raised(const V &x, const double least)
    {
      return both(A::raised(first(x), least), B::raised(second(x), least));
    }
    static V
    product(const V &u, const V &v)
    {
      return both(A::product(first(u), first(v)),
                  B::product(second(u), second(v)));
    }
    static double
    excess(const V &x)
    {
      return A::excess(first(x)) + B::excess(second(x));
    }
    static V
    correction(const V &v, const double target)
    {
      return both(A::correction(first(v), target),
                  B::correction(second(v), target));
    }

    struct Scaling
    {
      Scaling() = default;
      Scaling(const V &x, const V &z)
        : a(first(x), first(z))
        , b(second(x), second(z))
        , lambda(both(a.lambda, b.lambda))
      {}

      V
      x_hat(const V &d) const
      {
        return both(a.x_hat(first(d)), b.x_hat(second(d)));
      }
      V
      z_hat(const V &d) const
      {
        return both(a.z_hat(first(d)), b.z_hat(second(d)));
      }
      V
      z_of(const V &d) const
      {
        return both(a.z_of(first(d)), b.z_of(second(d)));
      }
      V
      divide(const V &d) const
      {
        return both(a.divide(first(d)), b.divide(second(d)));
      }
      double
      step(const V &d) const
      {
        return std::min(a.step(first(d)), b.step(second(d)));
      }

      typename A::Scaling a;
      typename B::Scaling b;
      V                   lambda;
    };
  };
} // namespace geocone

#endif
