// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_plane_strength_h
#define geocone_bounds_plane_strength_h

#include <geocone/conic/strength_law.h>

#include <Eigen/Dense>

#include <algorithm>

/** Strength laws of points in plane strain, whose cone variables are eliminated in closed
 *  form. They have the members of StrengthLaw and of ConeElimination. */
namespace geocone
{
  /** Sizes and types of the strength laws of plane strain. */
  struct PlaneLaw
  {
    using Cone                = SecondOrderCone<3>;
    static constexpr int rows = 3, columns = 3, size = 3;
    using Y = Cone::V;
    using S = Cone::V;
    using X = Cone::V;

    static const Y &
    extended(const S &e)
    {
      return e;
    }
  };

  /**
   * Strength |s_t| <= a s_n + k for a > 0. With the stress y = (a s_n, s_t), conjugate to
   * the strain rates e = (e_n/a, e_t), the cone variable is X = y + k unit and the
   * flow rule Z = -e: A is minus the identity. X is the variable of the iterate
   * instead of y, so that it is accurate near the apex, too.
   */
  struct PlaneCone : PlaneLaw
  {
    static constexpr bool x_is_variable = true;

    double a;

    static S
    stress(const X &x, const double k)
    {
      return x - k * Cone::unit();
    }
    static Y
    flow(const X &z)
    {
      return -z;
    }
    static X
    rates_of_cone(const S &e)
    {
      return -e;
    }
    static S
    constrained_rate()
    {
      return S::Zero();
    }
    static S
    rate_inside()
    {
      return -Cone::unit();
    }
    /** Returns X, which is inside the cone also without cohesion. */
    X
    start_variable(const double k) const
    {
      return start_of_friction(std::min(a, 0.9)) * std::max(k, 0.1) *
             Cone::unit();
    }

    struct Elimination
    {
      Cone::Scaling scaling;

      void
      scale(const PlaneCone &, const X &x, const X &z, const double)
      {
        scaling = Cone::Scaling(x, z);
      }
      Eigen::Matrix3d
      stiffness(const double w) const
      {
        return w * scaling.w.square();
      }
      X
      response(const S &e, const double w) const
      {
        return scaling.w.square_times(w * e);
      }
      S
      given(const X &d, const Y &residual, const double) const
      {
        return scaling.w.times(d) + scaling.w.square_times(residual);
      }
      /** Computes dX, which is dy, and dZ. */
      void
      complete(const PlaneCone &,
               const X     &d,
               const Y     &residual,
               const S     &e,
               const double w,
               X           &dx,
               X           &dz) const
      {
        dz = -residual - w * e;
        dx = scaling.w.times(d) - scaling.w.square_times(dz);
      }
    };
  };

  /** Strength |s_t| <= k: X = (k, s_t) has a constant component, and the constrained
   *  strain rate e_n is found by the method of multipliers. */
  struct PlaneCylinder : PlaneLaw
  {
    static constexpr bool x_is_variable = false;

    static X
    cone_variable(const Y &y, const double k)
    {
      return {k, y[1], y[2]};
    }
    static Y
    flow(const X &z)
    {
      return {0., -z[1], -z[2]};
    }
    static X
    rates_of_cone(const S &e)
    {
      return flow(e);
    }
    static S
    constrained_rate()
    {
      return Cone::unit();
    }
    static S
    rate_inside()
    {
      return S::Zero();
    }
    static double
    unbounded_stress(const Y &y)
    {
      return y[0];
    }
    static Y
    start_variable(const double)
    {
      return Y::Zero();
    }

    /** Returns the vector of a normal and a shear component. */
    static Y
    joined(const double normal, const Eigen::Vector2d &shear)
    {
      return {normal, shear[0], shear[1]};
    }

    struct Elimination
    {
      Cone::Scaling scaling;

      void
      scale(const PlaneCylinder &, const X &x, const X &z, const double)
      {
        scaling = Cone::Scaling(x, z);
      }
      Eigen::Matrix3d
      stiffness(const double w) const
      {
        Eigen::Matrix3d C   = Eigen::Matrix3d::Zero();
        C(0, 0)             = constrained_stiffness;
        C.block<2, 2>(1, 1) = w * scaling.w.tangential();
        return C;
      }
      Y
      response(const S &e, const double w) const
      {
        return joined(constrained_stiffness * e[0],
                      scaling.w.tangential() * w * e.tail<2>());
      }
      S
      given(const X &d, const Y &residual, const double w) const
      {
        return joined(constrained_stiffness / w * residual[0],
                      scaling.w.eliminated(scaling.w.times(d)) +
                        scaling.w.tangential() * residual.tail<2>());
      }
      void
      complete(const PlaneCylinder &,
               const X     &d,
               const Y     &residual,
               const S     &e,
               const double w,
               Y           &dy,
               X           &dx,
               X           &dz) const
      {
        const X               r    = scaling.w.times(d);
        const Eigen::Vector2d dz_t = -residual.tail<2>() - w * e.tail<2>();
        dy = joined(constrained_stiffness * (residual[0] / w + e[0]),
                    scaling.w.eliminated(r) - scaling.w.tangential() * dz_t);
        dx = joined(0., dy.tail<2>());
        dz = joined(scaling.w.first_rate(r[0], dz_t), dz_t);
      }
    };
  };
} // namespace geocone

#endif
