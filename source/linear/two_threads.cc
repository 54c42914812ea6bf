// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/one_thread.h>
#include <geocone/linear/two_threads.h>

#include <future>

namespace geocone
{
  void
  run_both(const std::function<void()> &first,
           const std::function<void()> &second,
           const unsigned int           n_threads)
  {
    if (n_threads == 1)
      {
        first();
        second();
        return;
      }
    // The destructor of the future waits for the second function if the first
    // one throws.
    std::future<void> other = std::async(std::launch::async, [&]() {
      use_one_thread(); // some limits hold for a thread only
      second();
    });
    first();
    other.get();
  }
} // namespace geocone
