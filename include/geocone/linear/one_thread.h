// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_one_thread_h
#define geocone_linear_one_thread_h

namespace geocone
{
  /**
   * Lets libraries work by one thread per rank: the parallelism is MPI's. What is linked
   * to this has a GOMP_parallel() of its own besides (one_thread.cc), which makes all
   * parallel regions of OpenMP, of any library of the process, plain calls.
   */
  void
  use_one_thread();
} // namespace geocone

#endif
