// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Compiled for AVX2 and FMA if the compiler supports them; see CMakeLists.txt.
#if defined(__AVX2__) && defined(__FMA__)
#include <geocone/kernels/pyramid_kernel.templates.h>

namespace geocone::GEOCONE_DIM
{
  namespace avx2
  {
    void
    advance_pyramid(const PyramidNumbers &, const PointBlock &);

    void
    advance_pyramid(const PyramidNumbers &pyramid, const PointBlock &block)
    {
      advance_pyramid_block<xsimd::avx2>(pyramid, block);
    }
  } // namespace avx2
} // namespace geocone::GEOCONE_DIM
#endif
