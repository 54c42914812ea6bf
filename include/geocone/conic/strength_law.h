// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_strength_law_h
#define geocone_conic_strength_law_h

#include <geocone/conic/cone_elimination.h>
#include <geocone/conic/small_matrices.h>
#include <geocone/conic/symmetric_cones.h>

#include <Eigen/Dense>

#include <cmath>

namespace geocone
{
  /**
   * Strength of a point, expressed by a symmetric cone. A stress s is admissible if there
   * are variables y = (s, internal variables) for which
   *   X = k o - A y in the cone.
   * The flow rule is A'Z = (e, 0) with Z in the cone; the dissipation is k o.Z. All
   * matrices are given for k = 1; k multiplies o only.
   */
  template <typename ConeOfLaw, int n_rows, int n_own>
  struct StrengthLaw
  {
    using Cone                = ConeOfLaw;
    static constexpr int rows = n_rows, columns = n_rows + n_own,
                         size = Cone::size;

    using Y = Eigen::Matrix<double, columns, 1>;
    using S = Eigen::Matrix<double, rows, 1>;
    using X = typename Cone::V;

    using Elimination = ConeElimination<StrengthLaw>;

    /** True if the variable of an iterate is X, which determines the stress. */
    static constexpr bool x_is_variable = false;

    Eigen::Matrix<double, size, columns> A;
    X                                    o = X::Zero();

    /** Unit vector in the null space of the matrix A; zero if A has full column
     *  rank. X does not depend on this component of y. */
    Y null_vector = Y::Zero();

    Y start  = Y::Zero(); ///< y with X inside the cone
    S inside = S::Zero(); ///< strain rate inside the flow cone, or zero

    /** @name Derived by finish() */
    /** @{ */
    Eigen::Matrix<double, size, columns> pseudo_inverse; ///< of A'

    /** Orthonormal basis of the null space of A', in the first n_null columns. */
    Eigen::Matrix<double, size, size> null;
    int                               n_null = 0;
    /** @} */

    void
    finish()
    {
      n_null = small_matrices::pseudo_inverse_of_transpose(
        size, columns, A.data(), pseudo_inverse.data(), null.data());
    }

    /** Returns the strain rate e, extended by zeros for the internal variables. */
    static Y
    extended(const S &e)
    {
      Y all                     = Y::Zero();
      all.template head<rows>() = e;
      return all;
    }
    X
    cone_variable(const Y &y, const double k) const
    {
      return k * o - A * y;
    }
    /** Returns A'Z. */
    Y
    flow(const X &z) const
    {
      return A.transpose() * z;
    }
    /** Returns the least Z whose flow is the strain rate e. */
    X
    rates_of_cone(const S &e) const
    {
      return pseudo_inverse * extended(e);
    }
    /** Returns the unit strain rate that the flow rule constrains to zero, or zero. */
    S
    constrained_rate() const
    {
      const S e = null_vector.template head<rows>();
      return e.squaredNorm() > 0. ? S(e.normalized()) : e;
    }
    /** Returns the stress component that is conjugate to the constrained rate. */
    double
    unbounded_stress(const Y &y) const
    {
      return null_vector.dot(y);
    }
    const S &
    rate_inside() const
    {
      return inside;
    }
    Y
    start_variable(const double k) const
    {
      return k * start;
    }
  };

  /** Returns the ratio of the cone variable X to the strength k for the initial
   *  guess. With increasing friction, the initial guess is farther from the
   *  apex. */
  inline double
  start_of_friction(const double a)
  {
    return std::pow((1. + a) / (1. - a), 2);
  }

  /** Returns Mohr-Coulomb's strength (1 + S) s_1 - (1 - S) s_3 <= k, expressed by two
   *  semidefinite matrices (k + t) I - (1 + S) s and (1 - S) s - t I, with k = 2 c
   *  cos(phi) and S = sin(phi); for S = 0 the strength is Tresca's.
   *  @param M maps stresses to the vectors of the cone @param one unit tensor as a stress */
  template <typename Law, int n>
  Law
  two_matrices(const double                       sine,
               const Eigen::Matrix<double, n, n> &M,
               const Eigen::Matrix<double, n, 1> &one)
  {
    const Eigen::Matrix<double, n, 1> unit = M * one;
    const double                      K    = start_of_friction(sine);
    Law                               law;
    law.A.template topLeftCorner<n, n>()     = (1. + sine) * M;
    law.A.template bottomLeftCorner<n, n>()  = -(1. - sine) * M;
    law.A.template topRightCorner<n, 1>()    = -unit;
    law.A.template bottomRightCorner<n, 1>() = unit;
    law.o.template head<n>()                 = unit;
    if (sine > 0.)
      {
        const double p               = (K - 1.) / (2. * sine);
        law.start.template head<n>() = -p * one;
        law.start[n]                 = -(1. - sine) * p - K / 2.;
        law.inside                   = one / std::sqrt(3.);
      }
    else
      {
        law.null_vector.template head<n>() = one / 2.;
        law.null_vector[n]                 = 1. / 2.;
        law.start[n]                       = -1. / 2.;
      }
    law.finish();
    return law;
  }

  /** Mohr-Coulomb strength of all stress components, which are Mandel vectors, tension
   *  positive. */
  using MohrCoulombCones =
    StrengthLaw<ProductCone<SemidefiniteCone, SemidefiniteCone>, 6, 1>;

  inline MohrCoulombCones
  mohr_coulomb_cones(const double sine)
  {
    return two_matrices<MohrCoulombCones, 6>(
      sine, Eigen::Matrix<double, 6, 6>::Identity(), SemidefiniteCone::unit());
  }

  /** Mohr-Coulomb strength with the tension cut-off s_1 <= T, expressed by the third
   *  semidefinite matrix T I - s. */
  using CutMohrCoulombCones =
    StrengthLaw<ProductCone<MohrCoulombCones::Cone, SemidefiniteCone>, 6, 1>;

  /** @param tension tensile strength T over k, below the apex of the pyramid */
  inline CutMohrCoulombCones
  cut_mohr_coulomb_cones(const double sine, const double tension)
  {
    const MohrCoulombCones            pyramid = mohr_coulomb_cones(sine);
    const Eigen::Matrix<double, 6, 1> m       = SemidefiniteCone::unit();
    const double                      K       = start_of_friction(sine),
                 p = sine > 0. ? (K - 1.) / (2. * sine) : 2.;
    CutMohrCoulombCones law;
    law.A.setZero();
    law.A.topRows<12>() = pyramid.A;
    law.A.bottomLeftCorner<6, 6>().setIdentity();
    law.o << pyramid.o, tension * m;
    law.start << -p * m, -(1. - sine) * p - K / 2.;
    law.inside = m / std::sqrt(3.);
    law.finish();
    return law;
  }

  /** Circular yield cone |s_t| <= a s_n + k (Drucker-Prager; von Mises for a = 0). The
   *  axis is n = -(1, 1, 0, 1, 0, 0)/sqrt3.
   *  @tparam n 6, or 4 for stresses without the last two shear components */
  template <int n>
  using CircularConeOf = StrengthLaw<SecondOrderCone<n>, n, 0>;
  using CircularCone   = CircularConeOf<6>;

  template <int n = 6>
  CircularConeOf<n>
  circular_cone(const double a)
  {
    const Eigen::Matrix<double, n, 1> axis =
      -SemidefiniteCone::unit().head<n>() / std::sqrt(3.);
    // Rows axis and the orthonormal deviators.
    Eigen::Matrix<double, n, n> Q = Eigen::Matrix<double, n, n>::Zero();
    Q.row(0)                      = axis.transpose();
    Q(1, 0)                       = M_SQRT1_2;
    Q(1, 1)                       = -M_SQRT1_2;
    Q(2, 0) = Q(2, 1) = 1. / std::sqrt(6.);
    Q(2, 3)           = -2. / std::sqrt(6.);
    Q(3, 2)           = 1.;
    for (int i = 4; i < n; ++i)
      Q(i, i) = 1.;
    CircularConeOf<n> law;
    law.A = -Q;
    law.A.row(0) *= a;
    law.o[0] = 1.;
    if (a > 0.)
      {
        law.start  = (start_of_friction(a) - 1.) / a * axis;
        law.inside = -axis;
      }
    else
      law.null_vector = axis;
    law.finish();
    return law;
  }

  /** Strength |s_t| <= k - mu s_n of a facet across which the velocity jumps, with the
   *  traction s = (s_n, s_t).
   *  @tparam n number of components of the traction */
  template <int n>
  using FaceConeOf = StrengthLaw<SecondOrderCone<n>, n, 0>;
  using FaceCone   = FaceConeOf<3>;

  template <int n = 3>
  FaceConeOf<n>
  face_cone(const double mu)
  {
    FaceConeOf<n> law;
    law.A       = -Eigen::Matrix<double, n, n>::Identity();
    law.A(0, 0) = mu;
    law.o[0]    = 1.;
    if (mu > 0.)
      {
        const double a = std::min(mu / std::sqrt(1. + mu * mu), 0.9);
        law.start[0]   = -(start_of_friction(a) - 1.) / mu;
        law.inside[0]  = 1.;
      }
    else
      law.null_vector[0] = 1.;
    law.finish();
    return law;
  }

  /** Tensile strength s_n <= k of a plane of symmetry at which the soil may separate. */
  using OpeningCone = StrengthLaw<SecondOrderCone<1>, 1, 0>;

  inline OpeningCone
  opening_cone()
  {
    OpeningCone law;
    law.A(0, 0)   = 1.;
    law.o[0]      = 1.;
    law.start[0]  = -1.;
    law.inside[0] = 1.;
    law.finish();
    return law;
  }
} // namespace geocone

#endif
