// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/blas_kernels.h>

#include <dlfcn.h>

#include <cstdlib>
#include <set>

namespace geocone
{
  namespace
  {
    /** Looks up a function in the libraries of this process; null if there is
     *  none. */
    template <typename Function>
    Function *
    function_of_library(const char *name)
    {
      return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
    }

    /** Best kernels of OpenBLAS that this processor can run; null if it has no AVX2. */
    const char *
    best_blas_core()
    {
#if defined(__x86_64__)
      if (__builtin_cpu_supports("avx512f") &&
          __builtin_cpu_supports("avx512bw") &&
          __builtin_cpu_supports("avx512cd") &&
          __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512vl"))
        return "SkylakeX";
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return "Haswell";
#endif
      return nullptr;
    }

    void
    take_blas_core(const char *name)
    {
      const auto quit = function_of_library<void()>("gotoblas_dynamic_quit");
      const auto init = function_of_library<void()>("gotoblas_dynamic_init");
      if (name == nullptr || quit == nullptr || init == nullptr ||
          std::getenv("OPENBLAS_CORETYPE") != nullptr)
        return;
      setenv("OPENBLAS_CORETYPE", name, 1);
      quit();
      init();
      unsetenv("OPENBLAS_CORETYPE"); // programs that this one starts choose for
                                     // themselves
    }
  } // namespace

  std::string
  blas_core()
  {
    const auto name = function_of_library<char *()>("openblas_get_corename");
    return name != nullptr ? name() : "unknown";
  }

  void
  select_blas_kernels()
  {
    static const std::set<std::string> without_avx2 = {
      "Barcelona", "Core2", "Nehalem", "Prescott", "Sandybridge"};
    if (without_avx2.count(blas_core()) > 0)
      take_blas_core(best_blas_core());
  }

  void
  select_widest_blas_kernels()
  {
    static const std::set<std::string> of_avx2 = {
      "Excavator", "Haswell", "Zen"};
    if (of_avx2.count(blas_core()) > 0 && best_blas_core() != blas_core())
      take_blas_core(best_blas_core());
  }
} // namespace geocone
