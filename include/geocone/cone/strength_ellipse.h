// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_cone_strength_ellipse_h
#define geocone_cone_strength_ellipse_h

#include <Eigen/Dense>

namespace geocone
{
  /**
   * Ellipse of the shear stresses s_t that a point in plane strain carries for phi = 0, where the
   * strength depends on the direction of the largest compressive stress:
   *   s_t = k (d + A x), |x| <= 1,   A = Q diag(compression, shear),   d = Q (offset, 0),
   * with k = sqrt2 s_uA, in cone axes: s_t = sqrt2 ((s_xx - s_yy)/2, s_xy). Q turns by twice
   * the angle of the axis of anisotropy to the vertical. It contains zero, offset < compression.
   * The support function, which is the dissipation for k = 1, is |A' e| + d.e.
   */
  struct StrengthEllipse
  {
    using Vector = Eigen::Vector2d;

    double compression = 1.; ///< half-axis of active and passive compression
    double shear       = 1.; ///< half-axis of direct simple shear
    double offset      = 0.; ///< of the centre, towards active compression
    double cosine = 1., sine = 0.; ///< of twice the angle

    bool
    is_circle() const
    {
      return compression == 1. && shear == 1. && offset == 0.;
    }

    /** Largest k' such that the disc with the ellipse's centre and axes times k' contains zero
     *  on its rim, for k = 1: stresses s_t with |x| <= 1 + f, times k'/(k' + f), are inside. */
    double
    reserve() const
    {
      return 1. - std::abs(offset) / compression;
    }

    /** Returns the centre d. */
    Vector
    centre() const
    {
      return {cosine * offset, sine * offset};
    }

    /** Returns k x of a stress s_t: its length is k on the ellipse. */
    Vector
    on_disc(const Vector &s, const double k) const
    {
      return {(cosine * s[0] + sine * s[1] - k * offset) / compression,
              (cosine * s[1] - sine * s[0]) / shear};
    }

    /** Returns the stress k d + A y, the inverse of on_disc(). */
    Vector
    stress(const Vector &y, const double k) const
    {
      const double u = k * offset + compression * y[0], v = shear * y[1];
      return {cosine * u - sine * v, sine * u + cosine * v};
    }

    /** Returns A' e of shear rates. */
    Vector
    rates(const Vector &e) const
    {
      return {compression * (cosine * e[0] + sine * e[1]),
              shear * (cosine * e[1] - sine * e[0])};
    }

    /** Returns the derivatives of dissipation() by the ratios s_uP/s_uA and s_uD/s_uA:
     *  compression = (1 + s_uP/s_uA)/2, offset = 1 - compression. */
    Vector
    dissipation_by_ratios(const Vector &e) const
    {
      const Vector r    = rates(e);
      const double norm = r.norm(), along = r[0] / compression;
      if (!(norm > 0.))
        return Vector::Zero();
      return {(r[0] / norm - 1.) / 2. * along, r[1] / norm * r[1] / shear};
    }

    /** Returns the dissipation of shear rates for k = 1. */
    double
    dissipation(const Vector &e) const
    {
      return rates(e).norm() + centre().dot(e);
    }
  };
} // namespace geocone

#endif
