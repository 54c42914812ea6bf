// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/cone_kernel.h>
#include <geocone/kernels/cone_kernel.templates.h>
#include <geocone/kernels/simd_level.h>

#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  extern template void
  advance_cone_block<xsimd::avx2>(const ConeConstants &, const PointBlock &);
#endif

  namespace
  {
    ConeConstants
    constants_of(const FlowCone &cone, const Elasticity &elasticity)
    {
      const double root = dim == 2 ? sqrt2 : std::sqrt(3.);
      return {cone.a,
              cone.b,
              cone.k / root,
              cone.a > 0. ? cone.k / root / cone.a
                          : std::numeric_limits<double>::max(),
              elasticity.normal_stiffness(),
              elasticity.two_G,
              elasticity.lambda + elasticity.two_G};
    }

    void
    advance_by_best(const ConeConstants &constants, const PointBlock &block)
    {
#ifdef GEOCONE_HAS_AVX2_UNITS
      if (machine_has_avx2())
        return advance_cone_block<xsimd::avx2>(constants, block);
#endif
      advance_cone_block<BaselineArch>(constants, block);
    }
  } // namespace

  void
  advance_cone(const FlowCone   &cone,
               const Elasticity &elasticity,
               const PointBlock &block)
  {
    advance_by_best(constants_of(cone, elasticity), block);
  }

  void
  advance_cone(const FlowCone    &cone,
               const Elasticity  &elasticity,
               const PointBlock  &block,
               const double       part,
               const unsigned int place)
  {
    ConeConstants constants = constants_of(cone, elasticity);
    constants.memory_factor = part;
    constants.place         = place;
    advance_by_best(constants, block);
  }
} // namespace geocone::GEOCONE_DIM
