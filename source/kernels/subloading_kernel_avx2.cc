// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Compiled for AVX2 and FMA if the compiler supports them; see CMakeLists.txt.
#if defined(__AVX2__) && defined(__FMA__)
#include <geocone/kernels/subloading_kernel.templates.h>

namespace geocone
{
  template void
  take_single_substeps_by<xsimd::avx2>(const DerivedSubloadingConstants &,
                                       SubloadingLanes<4> &);
  template void
  take_single_substeps_by<xsimd::avx2>(const DerivedSubloadingConstants &,
                                       SubloadingLanes<6> &);
} // namespace geocone
#endif
