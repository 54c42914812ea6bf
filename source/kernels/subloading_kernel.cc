// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/simd_level.h>
#include <geocone/kernels/subloading_kernel.templates.h>

namespace geocone
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  namespace avx2
  {
    void
    take_single_substeps(const SubloadingNumbers &, SubloadingLanes<4> &);
    void
    take_single_substeps(const SubloadingNumbers &, SubloadingLanes<6> &);
  } // namespace avx2
#endif

  namespace
  {
    template <int n>
    void
    take_by_best(const SubloadingNumbers &c, SubloadingLanes<n> &lanes)
    {
#ifdef GEOCONE_HAS_AVX2_UNITS
      if (machine_has_avx2())
        return avx2::take_single_substeps(c, lanes);
#endif
      SubloadingSubstep<Pack<BaselineArch>, n>{c}(lanes);
    }
  } // namespace

  void
  take_single_substeps(const SubloadingNumbers &c, SubloadingLanes<4> &lanes)
  {
    take_by_best(c, lanes);
  }

  void
  take_single_substeps(const SubloadingNumbers &c, SubloadingLanes<6> &lanes)
  {
    take_by_best(c, lanes);
  }
} // namespace geocone
