// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_blas_kernels_h
#define geocone_linear_blas_kernels_h

#include <string>

namespace geocone
{
  /**
   * Selects the kernels of OpenBLAS by the instruction sets of this processor. By itself
   * OpenBLAS selects them by the model, and takes those of SSE3 for models newer than
   * itself: factorisations in three dimensions then take three times as long. Nothing
   * changes where it has found kernels of AVX2 or better, where the environment variable
   * OPENBLAS_CORETYPE is set, or with another BLAS. To be called before any of its
   * functions is.
   */
  void
  select_blas_kernels();

  /** Name of the kernels that OpenBLAS uses ("Haswell"), "unknown" with another BLAS. */
  std::string
  blas_core();
} // namespace geocone

#endif
