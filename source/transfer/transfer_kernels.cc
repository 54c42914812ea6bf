// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/simd_level.h>
#include <geocone/transfer/transfer_kernels.templates.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
#ifdef GEOCONE_HAS_AVX2_UNITS
  extern const TransferKernels transfer_kernels_avx2;
#endif

  const TransferKernels &
  transfer_kernels()
  {
    static const TransferKernels plain =
      make_transfer_kernels<BaselineArch>("baseline");
#ifdef GEOCONE_HAS_AVX2_UNITS
    if (machine_has_avx2())
      return transfer_kernels_avx2;
#endif
    return plain;
  }

  void
  PassSums::add(const PassSums &other)
  {
    work += other.work;
    check += other.check;
    wave_speed2  = std::max(wave_speed2, other.wave_speed2);
    speed2       = std::max(speed2, other.speed2);
    strain       = std::max(strain, other.strain);
    least_volume = std::min(least_volume, other.least_volume);
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], other.lower[d]);
        upper[d] = std::max(upper[d], other.upper[d]);
      }
  }
} // namespace geocone::GEOCONE_DIM
