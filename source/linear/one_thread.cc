// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/one_thread.h>

#include <omp.h>

#include <dlfcn.h>

/**
 * Replaces the function of the OpenMP runtime. CHOLMOD opens a parallel region
 * in each of its inner loops, most of them with one thread. The runtime makes a
 * system call at the end of each, a million times in a minute. Here all regions
 * have one thread, so a region is a call.
 */
extern "C" void
GOMP_parallel(void (*function)(void *), void *data, unsigned int, unsigned int)
{
  function(data);
}

namespace geocone
{
  void
  use_one_thread()
  {
    // Cholmod requests a fixed number of threads for blocks that are far too
    // small, which was measured to triple the time of a factorisation; only
    // this setting prevents it.
    omp_set_max_active_levels(0);
    if (const auto set_blas_threads = reinterpret_cast<void (*)(int)>(
          dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set_blas_threads(1);
  }
} // namespace geocone
