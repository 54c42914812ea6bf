// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Compiled for AVX2 and FMA if the compiler supports them; see CMakeLists.txt.
#if defined(__AVX2__) && defined(__FMA__)
#include <geocone/kernels/subloading_kernel.templates.h>

namespace geocone
{
  namespace avx2
  {
    void
    take_single_substeps(const SubloadingNumbers &, SubloadingLanes<4> &);
    void
    take_single_substeps(const SubloadingNumbers &, SubloadingLanes<6> &);

    void
    take_single_substeps(const SubloadingNumbers &c, SubloadingLanes<4> &lanes)
    {
      SubloadingSubstep<Pack<xsimd::avx2>, 4>{c}(lanes);
    }

    void
    take_single_substeps(const SubloadingNumbers &c, SubloadingLanes<6> &lanes)
    {
      SubloadingSubstep<Pack<xsimd::avx2>, 6>{c}(lanes);
    }
  } // namespace avx2
} // namespace geocone
#endif
