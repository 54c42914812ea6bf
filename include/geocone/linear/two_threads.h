// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_two_threads_h
#define geocone_linear_two_threads_h

#include <functional>

namespace geocone
{
  /**
   * Calls two independent functions, the second one on a thread of its own. Both have
   * ended when this function returns or throws an exception of one of them.
   * @param n_threads 1: one function after the other, on the calling thread
   */
  void
  run_both(const std::function<void()> &first,
           const std::function<void()> &second,
           const unsigned int           n_threads);
} // namespace geocone

#endif
