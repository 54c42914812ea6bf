// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_blas_kernels_h
#define geocone_linear_blas_kernels_h

#include <string>

namespace geocone
{
  /**
   * Selects the OpenBLAS kernels according to the instruction sets of the
   * processor. By default OpenBLAS selects kernels by the processor model, with
   * SSE3 for models unknown to the installed version: factorisations in three
   * dimensions are then three times slower. Has no effect if OpenBLAS has
   * selected AVX2 or better, if the environment variable OPENBLAS_CORETYPE is
   * set, or with another BLAS. Must be called before any BLAS function.
   */
  void
  select_blas_kernels();

  /**
   * Selects the OpenBLAS kernels of AVX-512 where the processor has it but OpenBLAS has
   * selected AVX2, as for AMD. Factors with large dense blocks are then faster, results
   * differ by rounding. Has no effect where select_blas_kernels() has none. No other thread
   * may be in BLAS.
   */
  void
  select_widest_blas_kernels();

  /** Name of the OpenBLAS kernels in use, e.g. "Haswell"; "unknown" for other
   *  BLAS libraries. */
  std::string
  blas_core();
} // namespace geocone

#endif
