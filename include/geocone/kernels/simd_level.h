// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_simd_level_h
#define geocone_kernels_simd_level_h

namespace geocone
{
  /**
   * Returns true if the kernels use AVX2 and FMA instructions. The processor
   * must support these instructions, and the environment variable GEOCONE_SIMD
   * must not be "baseline" (for comparisons).
   */
  bool
  machine_has_avx2();
} // namespace geocone

#endif
