// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Compiled for AVX2 and FMA if the compiler supports them; see CMakeLists.txt.
#if defined(__AVX2__) && defined(__FMA__)
#include <geocone/kernels/pyramid_kernel.templates.h>

namespace geocone::GEOCONE_DIM
{
  template void
  advance_pyramid_block<xsimd::avx2>(const PyramidConstants &,
                                     const PointBlock &);
} // namespace geocone::GEOCONE_DIM
#endif
