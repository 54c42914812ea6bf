// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/pyramid_kernel.h>
#include <geocone/kernels/pyramid_kernel.templates.h>
#include <geocone/kernels/simd_level.h>

namespace geocone::GEOCONE_DIM
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  extern template void
  advance_pyramid_block<xsimd::avx2>(const PyramidConstants &,
                                     const PointBlock &);
#endif

  void
  advance_pyramid(const PyramidConstants &pyramid, const PointBlock &block)
  {
#ifdef GEOCONE_HAS_AVX2_UNITS
    if (machine_has_avx2())
      return advance_pyramid_block<xsimd::avx2>(pyramid, block);
#endif
    advance_pyramid_block<BaselineArch>(pyramid, block);
  }
} // namespace geocone::GEOCONE_DIM
