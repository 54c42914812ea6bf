// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_simd_level_h
#define geocone_base_simd_level_h

namespace geocone
{
  /**
   * Whether kernels use AVX2 and FMA instructions: the machine supports them
   * and the environment variable GEOCONE_SIMD is not "baseline" (for
   * comparisons).
   */
  bool
  machine_has_avx2();
} // namespace geocone

#endif
