// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/simd_level.h>

#include <cstdlib>
#include <cstring>

namespace geocone
{
  bool
  machine_has_avx2()
  {
#if defined(__x86_64__)
    static const bool has = [] {
      const char *wanted = std::getenv("GEOCONE_SIMD");
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             !(wanted != nullptr && std::strcmp(wanted, "baseline") == 0);
    }();
    return has;
#else
    return false;
#endif
  }
} // namespace geocone
