// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_curves_h
#define geocone_kernels_subloading_curves_h

#include <geocone/base/types.h>
#include <geocone/kernels/subloading_model.h>
#include <geocone/kernels/yield_curve.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Converts a tensor (tension positive) into a Mandel vector (compression
   *  positive). */
  template <int n>
  typename SubloadingModel<n>::Vector
  to_model(const Tensor6 &x)
  {
    typename SubloadingModel<n>::Vector y;
    for (unsigned int i = 0; i < n; ++i)
      y[i] = -(i < 3 ? 1. : sqrt2) * x[i];
    return y;
  }

  /** Converts a Mandel vector into tensor components, multiplied by a given
   *  sign (1 or -1).
   *  @param sign -1 reverses the sign convention */
  template <int n>
  Tensor6
  from_model(const Eigen::Matrix<double, n, 1> &x, const double sign)
  {
    Tensor6 y{};
    for (unsigned int i = 0; i < n; ++i)
      y[i] = sign * x[i] / (i < 3 ? 1. : sqrt2);
    return y;
  }

  /** Plane sections of the yield surface and of the subloading surface in
   *  stress space. */
  template <int n>
  std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<n> &model,
                    const SubloadingState<n> &state,
                    const SectionPlane       &plane);

  extern template std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<4> &,
                    const SubloadingState<4> &,
                    const SectionPlane &);
  extern template std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<6> &,
                    const SubloadingState<6> &,
                    const SectionPlane &);
} // namespace geocone::GEOCONE_DIM

#endif
