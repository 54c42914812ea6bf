// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_resources_h
#define geocone_base_resources_h

#include <future>
#include <system_error>

namespace geocone
{
  /** CPU time of this rank (s). */
  double
  cpu_time_of_rank();

  /** Peak memory of this rank (MB), without that of the process that has started
   *  it, which getrusage() includes. */
  double
  peak_memory_of_rank();

  /** Memory still available to this program (MB). */
  double
  available_memory();

  /** Returns true if this rank has two processors, a BLAS that two threads may call, and
   *  eight times as much memory as its peak so far: problems grow from mesh to mesh. */
  bool
  has_room_for_two();

  /**
   * Runs two functions at the same time, each in a thread of its own, if this rank
   * has_room_for_two(), otherwise one after the other. Neither may call MPI or write what
   * the other one reads, so that their results are the same in both cases.
   * @throws what one of them throws, after both have ended
   */
  template <typename First, typename Second>
  void
  run_both(const First &first, const Second &second)
  {
    std::future<void> other;
    try
      {
        other = std::async(has_room_for_two() ? std::launch::async :
                                                std::launch::deferred,
                           second);
      }
    catch (const std::system_error &) // no more threads for this user
      {
        other = std::async(std::launch::deferred, second);
      }
    first(); // if it throws, the destructor of `other` waits for the thread
    other.get();
  }
} // namespace geocone

#endif
