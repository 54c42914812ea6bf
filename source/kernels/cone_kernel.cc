// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/cone_kernel.h>
#include <geocone/kernels/cone_kernel.templates.h>
#include <geocone/kernels/simd_level.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  extern template void
  advance_cone_block<xsimd::avx2>(const ConeConstants &, const PointBlock &);
#endif

  void
  advance_cone(const FlowCone    &cone,
               const Elasticity  &elasticity,
               const PointBlock  &block,
               const double       part,
               const unsigned int place)
  {
    const double  root = dim == 2 ? sqrt2 : std::sqrt(3.);
    ConeConstants constants{cone.delayed(part, 0.),
                            elasticity.normal_stiffness(),
                            elasticity.two_G,
                            elasticity.lambda + elasticity.two_G,
                            part,
                            part * (cone.a - cone.b) / root,
                            place};
    constants.cone.k /= root;
    constants.cone.tension /= root;
#ifdef GEOCONE_HAS_AVX2_UNITS
    if (machine_has_avx2())
      return advance_cone_block<xsimd::avx2>(constants, block);
#endif
    advance_cone_block<BaselineArch>(constants, block);
  }
} // namespace geocone::GEOCONE_DIM
