// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_cone_second_order_cone_h
#define geocone_cone_second_order_cone_h

#include <geocone/base/simd_scalar.h>
#include <geocone/base/types.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Transforms a Mandel vector to cone axes, in which the yield surface is a
   * circular cone. A vector x is split into x[0] = x.n along the axis n, the
   * direction of isotropic compression, and the tangential part x_t = x[1..]. In
   * plane strain
   *   n = -(1, 1, 0)/sqrt2, t1 = (1, -1, 0)/sqrt2, t2 = (0, 0, 1);
   * in three dimensions the axes are the rows of spatial_axes(). The map is
   * orthogonal and thus preserves scalar products.
   */
  inline Mandel
  to_cone_axes(const Mandel &s);

  inline Mandel
  from_cone_axes(const Mandel &x);

  /** Cone axes of three-dimensional Mandel vectors, stored by rows. The first row
   *  is n = -(1, 1, 0, 1)/sqrt3, followed by (1, -1, 0, 0)/sqrt2, (0, 0, 1, 0)
   *  and (1, 1, 0, -2)/sqrt6; all other shear components are unchanged. */
  inline const SpatialMandelMatrix &
  spatial_axes()
  {
    static const SpatialMandelMatrix axes = [] {
      const double r2 = 1. / sqrt2, r3 = 1. / std::sqrt(3.), r6 = r2 * r3;
      SpatialMandelMatrix rows = SpatialMandelMatrix::Identity();
      rows.topLeftCorner<4, 4>() << -r3, -r3, 0., -r3, //
        r2, -r2, 0., 0.,                               //
        0., 0., 1., 0.,                                //
        r6, r6, 0., -2. * r6;
      return rows;
    }();
    return axes;
  }

  inline Mandel
  to_cone_axes(const Mandel &s)
  {
    if constexpr (dim == 3)
      return spatial_axes() * extended(s, 0.);
    Mandel x = s;
    x[0]     = -(s[0] + s[1]) / sqrt2;
    x[1]     = (s[0] - s[1]) / sqrt2;
    return x;
  }

  inline Mandel
  from_cone_axes(const Mandel &x)
  {
    if constexpr (dim == 3)
      return spatial_axes().transpose() * extended(x, 0.);
    Mandel s = x;
    s[0]     = (-x[0] + x[1]) / sqrt2;
    s[1]     = (-x[0] - x[1]) / sqrt2;
    return s;
  }

  /** Transforms a linear map, e.g. a tangent stiffness, from cone axes to
   *  Mandel components. */
  inline MandelMatrix
  from_cone_axes(const MandelMatrix &C)
  {
    MandelMatrix columns, result;
    for (int j = 0; j < n_mandel; ++j)
      columns.col(j) = from_cone_axes(Mandel(C.col(j)));
    for (int i = 0; i < n_mandel; ++i)
      result.row(i) =
        from_cone_axes(Mandel(columns.row(i).transpose())).transpose();
    return result;
  }

  /** Plastic mode of a material point: elastic, on the smooth part of the yield
   *  cone, or at its apex. */
  enum class Mode : unsigned char
  {
    elastic, ///< inside the cone
    cone,    ///< on the smooth part of the cone
    apex     ///< at the apex
  };

  /** Infinite tensile strength (Pa), the value for a cone without tension
   *  cut-off. */
  constexpr double infinite_tension = std::numeric_limits<double>::infinity();

  /**
   * Yield cone and flow rule of a constitutive law, in cone axes. The
   * admissible set is
   *   C = { s : |s_t| <= a s_n + k },   a >= 0, k >= 0,
   * and the flow aperture is b, 0 <= b <= a (b = a: associated). With z = -(plastic
   * strain increment), mu = a - b and Psi(z) = z + mu |z_t| n, the law reads
   * K* contains Psi(z), orthogonal to s + (k/a) n in K, where K = {|x_t| <= a
   * x_n} and K* = {a |y_t| <= y_n} (Guillet et al. 2025, eqs 22, 25-27, 85-91;
   * signs and apertures as in doc/theory/cone.md). For a = 0 the set is the
   * cylinder |s_t| <= k (Tresca); only the apex divides by a.
   */
  struct FlowCone
  {
    double a = 0.; ///< aperture of the yield cone, e.g. sin(phi)
    double b = 0.; ///< aperture of the flow cone, e.g. sin(theta)
    double k = 0.; ///< radius of the yield surface at s_n = 0 (Pa)

    /** Tensile strength in the cut-off s_n >= -tension (Pa). The cut-off is
     *  effective if the apex of the cone is beyond it. */
    double tension = infinite_tension;

    /** Linear hardening modulus h (Pa). In a step, the radius of the yield
     *  surface at s_n = 0 increases from k to k + h |z_t|. */
    double hardening = 0.;

    /**
     * Strength parameter in the Rankine tension cut-off |s_t| <= s_n + cut_off
     * (Pa). The cut-off applies in addition to the cone and has associated
     * flow. In plane strain it limits the largest principal stress to
     * cut_off/sqrt2.
     */
    double cut_off = infinite_tension;

    bool
    is_cut() const
    {
      return cut_off < infinite_tension;
    }

    /** Returns the hardened cone at the end of a step with plastic shear strain
     *  |z_t| = slip. The hardening modulus of the returned cone is zero. */
    FlowCone
    hardened(const double slip) const
    {
      FlowCone end  = *this;
      end.k         = k + hardening * slip;
      end.hardening = 0.;
      return end;
    }

    /** Yield function (Pa): maximum of the yield functions of the cone and of
     *  Rankine's cut-off. Negative inside both. */
    template <typename V>
    double
    yield_function(const V &s) const
    {
      const double of_cone = tangential_norm(s) - a * s[0] - k;
      return is_cut() ? std::max(of_cone, beyond_cut_off(s)) : of_cone;
    }

    template <typename V>
    double
    beyond_cut_off(const V &s) const
    {
      return tangential_norm(s) - s[0] - cut_off;
    }

    /** De Saxce's change of variable Psi(z) = z + (a - b) |z_t| n, with the
     *  slopes a of the yield cone and b of the plastic potential; n is the cone
     *  axis (Guillet et al. 2025, eq. (25)). */
    template <typename V>
    V
    psi(const V &z) const
    {
      V y = z;
      y[0] += (a - b) * tangential_norm(z);
      return y;
    }

    /** Returns an element of the generalised Jacobian of De Saxce's map psi(). */
    MandelMatrix
    psi_slope(const Mandel &z) const
    {
      MandelMatrix slope = MandelMatrix::Identity();
      if (const double T = tangential_norm(z); T > 0.)
        slope.block<1, n_mandel - 1>(0, 1) =
          ((a - b) / T) * z.tail<n_mandel - 1>().transpose();
      return slope;
    }

    /**
     * Returns the yield cone for delayed friction, in which part of the
     * strength depends on the normal stress s_n^n at t_n. For a fraction
     * lambda,
     *   |s_t| <= a ((1 - m) s_n + m s_n^n) + k,   m = lambda (a - b)/a.
     * The aperture is a - lambda (a - b) >= b; the flow rule is the same, and the
     * tensile strength is not larger. For lambda = 0 the law is exact; associated
     * laws do not change.
     * The plastic work remains non-negative, because the radius of each
     * cross-section does.
     */
    FlowCone
    delayed(const double lambda, const double s_n_at_start) const
    {
      const double part = lambda * (a - b);
      if (part == 0.)
        return *this;
      const double limit = k / a;
      FlowCone     later = *this;
      later.a            = a - part;
      later.k            = k + part * std::max(s_n_at_start, -limit);
      later.tension      = limit;
      return later;
    }

    /** Violation max(0, a |y_t| - y_n) of the condition that y lies in the dual
     *  cone K*. */
    template <typename V>
    double
    dual_violation(const V &y) const
    {
      return std::max(0., a * tangential_norm(y) - y[0]);
    }

    /**
     * Complementarity product <y, s + (k/a) n> of the plastic flow y and the
     * stress s, measured from the apex of the cone (J/m^3). The form used
     * includes the limit a = 0 for y on the boundary of K* (there (k/a) y_n = k
     * |y_t|).
     */
    template <typename V>
    double
    complementarity_product(const V &y, const V &s) const
    {
      return y.dot(s) + (a > 0. ? (k / a) * y[0] : k * tangential_norm(y));
    }

    template <typename V>
    static double
    tangential_norm(const V &x)
    {
      return x.template tail<V::RowsAtCompileTime - 1>().norm();
    }
  };

  /**
   * Return mapping to a yield cone without the Rankine tension cut-off, in the
   * components along and across the axis: with D = diag(K, 2G, ..., 2G), the
   * solution of s = t + D z with z from the law of FlowCone for a trial value t
   * (doc/theory/laws.md). With T = |t_t|, f = T - a t_n - k, H = 2G + a b K + h,
   * g = f/H = |z_t| and q = T - 2G g = a s_n + k + h g,
   *   f <= 0            : s = t                                   (elastic)
   *   q >= 0 or a = 0   : s_n = t_n + K b g, s_t = q t_t/T        (cone)
   *   otherwise         : s = (-(k + h T/2G)/a, 0)                (apex).
   * If a cut-off precedes the apex, states beyond it are returned to
   * s_n = -tension, with s_t shortened to the radius there at the end of the
   * step, where the radius grows by h (T - |s_t|)/2G; they count as apex states.
   * @tparam Number double for a point, or Pack for several points
   */
  template <typename Number>
  class ConeReturn
  {
  public:
    ConeReturn(const FlowCone &cone, const double K, const double two_G)
      : r(cone.hardening > 0. ? cone.hardening / two_G : 0.)
      , is_cut(cone.tension < infinite_tension)
      , has_apex(!is_cut && cone.a > 0.)
      , a(cone.a)
      , h(cone.hardening)
      , per_1_r(r > 0. ? 1. / (1. + r) : 1.)
      , Kb(K * cone.b)
      , G2(two_G)
      , H(two_G + cone.a * cone.b * K + cone.hardening)
      , end(has_apex ? -cone.k / cone.a : -cone.tension)
      , end_per_T(r > 0. && has_apex ? r / cone.a : 0.)
    {}

    struct Returned
    {
      Number s_n, radius; ///< normal stress and |s_t| (Pa)
      Number beyond;      ///< positive at the apex or the cut-off
    };

    /** @param k radius at s_n = 0 (Pa): that of the cone unless it is cut off */
    Returned
    operator()(const Number &k, const Number &t_n, const Number &T) const
    {
      const Number zero(0.);
      const Number g   = max(T - (a * t_n + k), zero) / H; // 0 if only cut off
      const Number s_n = t_n + Kb * g;
      // q = T - 2G g, in the form that satisfies the cone within rounding even
      // for trial values larger by many orders of magnitude. At the apex
      // rounding makes the sign of either form arbitrary: the apex is returned.
      const Number q = min(a * s_n + k + h * g, T);
      if (!is_cut && !has_apex)
        return {s_n, q, zero};
      const Number beyond = is_cut ? end - s_n : zero - min(q, T - G2 * g);
      const Number radius =
        is_cut ? min((max(k + a * end, zero) + Number(r) * T) * per_1_r, T)
               : zero;
      return {where_greater(beyond, zero, end - end_per_T * T, s_n),
              where_greater(beyond, zero, radius, q),
              beyond};
    }

  private:
    const double r; ///< h/2G
    const bool   is_cut, has_apex;
    const Number a, h, per_1_r, Kb, G2, H;
    const Number end, end_per_T; ///< s_n of the cut-off or the apex
  };

  /**
   * Closed-form return mapping of one point by ConeReturn. For b = a this is the
   * projection of t onto C in the metric of D^{-1}; with K = 2G it is the
   * Euclidean projection P_C.
   *
   * @param[out] tangent an element of the generalised Jacobian ds/dt times D,
   * i.e. ds/de for t = s^n + D e; untouched if null
   */
  template <typename V, typename M>
  Mode
  return_map_uncut(const FlowCone &cone,
                   const double    K,
                   const double    two_G,
                   const V        &t,
                   V              &s,
                   M              *tangent)
  {
    constexpr int n_tangential = V::RowsAtCompileTime - 1;
    const double  radius       = cone.a * t[0] + cone.k;
    const double  T2           = t.template tail<n_tangential>().squaredNorm();
    if (radius >= 0. && T2 <= radius * radius &&
        t[0] >= -cone.tension) // most points: no square root
      {
        s = t;
        if (tangent != nullptr)
          {
            tangent->setZero();
            tangent->diagonal().setConstant(two_G);
            (*tangent)(0, 0) = K;
          }
        return Mode::elastic;
      }
    const double T = std::sqrt(T2);
    const auto [s_n, q, beyond] =
      ConeReturn<double>(cone, K, two_G)(cone.k, t[0], T);
    const Mode   mode   = beyond > 0. ? Mode::apex : Mode::cone;
    const bool   is_cut = mode == Mode::apex && cone.tension < infinite_tension;
    const double part = is_cut && T > 0. ? q / T : 1., h = cone.hardening;
    const auto   t_t = t.template tail<n_tangential>();
    const auto   u   = (t_t / (T > 0. ? T : 1.)).eval();
    s.setZero();
    s[0] = s_n;
    if (mode == Mode::cone)
      s.template tail<n_tangential>() = q * u;
    else if (is_cut)
      s.template tail<n_tangential>() = part * t_t;
    if (tangent == nullptr)
      return mode;
    M &C = *tangent;
    C.setZero();
    auto C_tt = C.template block<n_tangential, n_tangential>(1, 1);
    if (mode == Mode::cone)
      {
        const double H = two_G + cone.a * cone.b * K + h;
        C(0, 0)        = K - cone.a * cone.b * K * K / H;
        C.template block<1, n_tangential>(0, 1) =
          (K * cone.b * two_G / H) * u.transpose();
        C.template block<n_tangential, 1>(1, 0) = (two_G * cone.a * K / H) * u;
        C_tt = (two_G - two_G * two_G / H - two_G * q / T) * u * u.transpose();
        C_tt.diagonal().array() += two_G * q / T;
      }
    else if (is_cut)
      {
        C_tt.diagonal().setConstant(two_G * part);
        if (q < T)
          C_tt -= two_G * (part - h / (two_G + h)) * u * u.transpose();
      }
    else if (h > 0.)
      C.template block<1, n_tangential>(0, 1) = (-h / cone.a) * u.transpose();
    return mode;
  }

  /**
   * Return mapping to the Rankine tension cut-off, for stresses that violate
   * the cut-off after the return mapping to the cone. The stress is returned to
   * the cut-off, which is an associated cone of aperture 1, or, if that stress
   * is outside the cone, to the circle in which cone and cut-off intersect,
   *   s_n = (k + q T - (1 + q) cut_off)/(1 - a + q),  |s_t| = s_n + cut_off,
   * with q = h/2G.
   */
  template <typename V, typename M>
  Mode
  return_to_cut_off(const FlowCone &cone,
                    const double    K,
                    const double    two_G,
                    const V        &t,
                    V              &s,
                    M              *tangent)
  {
    constexpr int n_tangential = V::RowsAtCompileTime - 1;
    const Mode    mode =
      return_map_uncut(FlowCone{1., 1., cone.cut_off}, K, two_G, t, s, tangent);
    const double T = FlowCone::tangential_norm(t);
    const double q = cone.hardening / two_G;
    const double r = FlowCone::tangential_norm(s);
    if (r <= cone.a * s[0] + cone.k + q * (T - r))
      return mode;
    const auto u = (t.template tail<n_tangential>() / T).eval();
    s[0] = (cone.k + q * T - (1. + q) * cone.cut_off) / (1. - cone.a + q);
    const double radius             = s[0] + cone.cut_off;
    s.template tail<n_tangential>() = radius * u;
    if (tangent != nullptr)
      {
        const double growth = two_G * q / (1. - cone.a + q);
        tangent->setZero();
        tangent->template block<1, n_tangential>(0, 1) = growth * u.transpose();
        auto C = tangent->template block<n_tangential, n_tangential>(1, 1);
        C      = (growth - two_G * radius / T) * u * u.transpose();
        C.diagonal().array() += two_G * radius / T;
      }
    return Mode::cone;
  }

  /** Return mapping for a yield cone with all tension cut-offs. Combines
   *  return_map_uncut() and return_to_cut_off(). */
  template <typename V, typename M>
  Mode
  return_map(const FlowCone &cone,
             const double    K,
             const double    two_G,
             const V        &t,
             V              &s,
             M              *tangent)
  {
    const Mode mode = return_map_uncut(cone, K, two_G, t, s, tangent);
    return cone.is_cut() && cone.beyond_cut_off(s) > 0.
             ? return_to_cut_off(cone, K, two_G, t, s, tangent)
             : mode;
  }

  /** Euclidean projection onto the admissible set of a yield cone with tension
   *  cut-offs. The flow rule has no influence.
   *  @param[out] jacobian element of the generalised Jacobian, if not null */
  template <typename V,
            typename M =
              Eigen::Matrix<double, V::RowsAtCompileTime, V::RowsAtCompileTime>>
  V
  project(const FlowCone &cone, const V &x, M *jacobian = nullptr)
  {
    V        projected;
    FlowCone associated  = cone;
    associated.b         = cone.a;
    associated.hardening = 0.;
    return_map(associated, 1., 1., x, projected, jacobian);
    return projected;
  }

  /**
   * Euclidean projection onto the yield cone C = {|s_t| <= a s_n + k}.
   * @param[out] jacobian an element of Clarke's generalised Jacobian (Guillet et al.
   * 2025, appendix C, with the polar cone as the third case), if not null
   */
  template <typename V,
            typename M =
              Eigen::Matrix<double, V::RowsAtCompileTime, V::RowsAtCompileTime>>
  V
  project(const double a, const double k, const V &x, M *jacobian = nullptr)
  {
    return project(FlowCone{a, a, k}, x, jacobian);
  }

  /** Tangential unit vector x_t/|x_t|; zero if x_t = 0. */
  inline Mandel
  tangential_direction(const Mandel &x)
  {
    const double T = FlowCone::tangential_norm(x);
    Mandel       u = Mandel::Zero();
    if (T > 0.)
      u.tail<n_mandel - 1>() = x.tail<n_mandel - 1>() / T;
    return u;
  }

  /**
   * Natural map F(s, y) = s - P_C(s - rho y), with the projection P_C onto the
   * yield cone and De Saxce's variable y = Psi(z). For any rho > 0, F is zero
   * if and only if (s, z) satisfies the cone law (Guillet et al. 2025, eqs 58,
   * 59).
   */
  template <typename V>
  V
  natural_map(const FlowCone &cone, const V &s, const V &y, const double rho)
  {
    return s - project(cone.a, cone.k, V(s - rho * y));
  }
} // namespace geocone::GEOCONE_DIM

#endif
