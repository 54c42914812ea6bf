// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/simd_level.h>
#include <geocone/kernels/subloading_kernel.templates.h>

namespace geocone
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  extern template void
  take_single_substeps_by<xsimd::avx2>(const DerivedSubloadingConstants &,
                                       SubloadingLanes<4> &);
  extern template void
  take_single_substeps_by<xsimd::avx2>(const DerivedSubloadingConstants &,
                                       SubloadingLanes<6> &);
#endif

  namespace
  {
    template <int n>
    void
    take_by_best(const DerivedSubloadingConstants &c, SubloadingLanes<n> &lanes)
    {
#ifdef GEOCONE_HAS_AVX2_UNITS
      if (machine_has_avx2())
        return take_single_substeps_by<xsimd::avx2>(c, lanes);
#endif
      take_single_substeps_by<BaselineArch>(c, lanes);
    }
  } // namespace

  void
  take_single_substeps(const DerivedSubloadingConstants &c,
                       SubloadingLanes<4>               &lanes)
  {
    take_by_best(c, lanes);
  }

  void
  take_single_substeps(const DerivedSubloadingConstants &c,
                       SubloadingLanes<6>               &lanes)
  {
    take_by_best(c, lanes);
  }
} // namespace geocone
