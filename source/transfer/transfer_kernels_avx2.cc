// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Compiled for AVX2 and FMA where the compiler can; see CMakeLists.txt.
#if defined(__AVX2__) && defined(__FMA__)
#include <geocone/transfer/transfer_kernels.templates.h>

namespace geocone::GEOCONE_DIM
{
  extern const TransferKernels transfer_kernels_avx2;
  // Constant: nothing of this unit may run on a machine without AVX2.
  constexpr TransferKernels transfer_kernels_avx2 =
    make_transfer_kernels<xsimd::avx2>("AVX2");
} // namespace geocone::GEOCONE_DIM
#endif
