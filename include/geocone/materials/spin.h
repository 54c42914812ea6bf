// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_spin_h
#define geocone_materials_spin_h

namespace geocone
{
  /**
   * The rotation of a spin increment w = (l_yx - l_xy)/2 by Cayley's transform,
   * tan(angle/2) = w/2: orthogonal exactly, so that invariants stay.
   */
  class Spin
  {
  public:
    Spin(const double l_xy, const double l_yx)
    {
      const double tan_half = (l_yx - l_xy) / 4.;
      const double t2       = tan_half * tan_half;
      const double cosine   = (1. - t2) / (1. + t2);
      const double sine     = 2. * tan_half / (1. + t2);
      cos2                  = cosine * cosine - sine * sine;
      sin2                  = 2. * sine * cosine;
    }

    /** Turns the in-plane components of a symmetric tensor. */
    void
    turn(double &xx, double &yy, double &xy) const
    {
      const double mean = (xx + yy) / 2., half = (xx - yy) / 2.;
      const double turned = cos2 * half - sin2 * xy;
      xy                  = sin2 * half + cos2 * xy;
      xx                  = mean + turned;
      yy                  = mean - turned;
    }

  private:
    double cos2, sin2; ///< of the angle, doubled
  };
} // namespace geocone

#endif
