// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_one_thread_h
#define geocone_linear_one_thread_h

namespace geocone
{
  /**
   * Restricts all libraries to one thread of their own per MPI rank, since the program
   * is parallelised with MPI and run_both() only. Linking this function also replaces
   * GOMP_parallel() (one_thread.cc), so that parallel regions of OpenMP in any
   * library of the process are executed serially.
   */
  void
  use_one_thread();
} // namespace geocone

#endif
