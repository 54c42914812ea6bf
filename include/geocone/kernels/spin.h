// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_spin_h
#define geocone_kernels_spin_h

#include <geocone/base/types.h>

#include <array>
#include <type_traits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Rotation of plane tensors by a spin increment w. With the increment l of
   * the displacement gradient, w = (l_yx - l_xy)/2. The Cayley transform,
   * tan(angle/2) = w/2, is exactly orthogonal, so that stress invariants are
   * preserved.
   * @tparam T double, or Pack for several points
   */
  template <typename T>
  class PlaneSpin
  {
  public:
    /** Computes the rotation from the increment l of the displacement gradient,
     *  with l_ij at index 2 i + j. */
    explicit PlaneSpin(const std::array<T, 4> &l)
    {
      const T one(1.);
      const T t = T(0.25) * (l[2] - l[1]), t2 = t * t;
      const T q = one + t2, per_q2 = one / (q * q);
      cos2 = (one - t2 * (T(6.) - t2)) * per_q2;
      sin2 = T(4.) * t * (one - t2) * per_q2;
    }

    /** Rotates the in-plane components xx, yy, xy of a symmetric tensor. */
    void
    turn(std::array<T, 3> &s) const
    {
      auto &[xx, yy, xy] = s;
      const T half(0.5), mean = half * (xx + yy);
      T       difference = half * (xx - yy);
      turn(difference, xy);
      xx = mean + difference;
      yy = mean - difference;
    }

    /** Rotates half the difference of the normal components, and xy. */
    void
    turn(T &difference, T &xy) const
    {
      const T turned = cos2 * difference - sin2 * xy;
      xy             = sin2 * difference + cos2 * xy;
      difference     = turned;
    }

  private:
    T cos2, sin2; ///< of twice the rotation angle
  };

  /**
   * Rotation of tensors in three dimensions by the Cayley transform of a spin
   * increment. With g, half the axial vector of the increment, the rotation
   * matrix is
   *   Q = c 1 + s (g g' + [g x]),  s = 2/(1 + g.g),  c = 1 - s g.g.
   */
  template <typename T>
  class SpatialSpin
  {
  public:
    /** Computes the rotation from the increment l of the displacement gradient,
     *  with l_ij at index 3 i + j. */
    explicit SpatialSpin(const std::array<T, 9> &l)
    {
      const T quarter(0.25), one(1.);
      const T g[3] = {quarter * (l[7] - l[5]),
                      quarter * (l[2] - l[6]),
                      quarter * (l[3] - l[1])};
      const T g2   = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
      const T s = T(2.) / (one + g2), c = one - s * g2;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Q[i][j] = s * g[i] * g[j];
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          Q[i][i] = Q[i][i] + c;
          Q[k][j] = Q[k][j] + s * g[i];
          Q[j][k] = Q[j][k] - s * g[i];
        }
    }

    /** Rotates the components xx, yy, xy, zz, yz, zx of a symmetric tensor. */
    void
    turn(std::array<T, 6> &s) const
    {
      constexpr auto &place = index_of_component;
      T               Qs[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Qs[i][j] = Q[i][0] * s[place[0][j]] + Q[i][1] * s[place[1][j]] +
                     Q[i][2] * s[place[2][j]];
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
          s[place[i][j]] =
            Qs[i][0] * Q[j][0] + Qs[i][1] * Q[j][1] + Qs[i][2] * Q[j][2];
    }

  private:
    T Q[3][3];
  };

  using Spin =
    std::conditional_t<dim == 2, PlaneSpin<double>, SpatialSpin<double>>;
} // namespace geocone::GEOCONE_DIM

#endif
