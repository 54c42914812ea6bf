// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_stop_request_h
#define geocone_base_stop_request_h

#include <geocone/base/exceptions.h>

#include <mpi.h>

namespace geocone
{
  /** Termination requested by a signal, detected by all ranks together. */
  class Stopped : public RunError
  {
  public:
    explicit Stopped(const int signal);

    const int signal;
  };

  /**
   * Installs the signal handlers. SIGINT (Ctrl-C), SIGTERM and SIGHUP (terminal
   * closed; not under nohup) then ask the run to stop as soon as its state is
   * consistent; a second signal terminates the program at once. Writing beyond
   * a limit (SIGXFSZ) or into a closed pipe (SIGPIPE) is a write error, not a
   * termination.
   */
  void
  watch_for_signals();

  /** Signal by which any rank was asked to stop, or 0. Collective. */
  int
  stop_request(const MPI_Comm comm);

  /** Signal by which this rank was asked to stop, or 0. */
  int
  stop_request_of_rank();

  /** @throws Stopped if any rank has been asked to stop. Collective. */
  void
  stop_if_asked(const MPI_Comm comm);

  /** Prints an error. */
  void
  say_error(const std::string &what);

  /**
   * Prints an error detected by one of several ranks alone, and terminates all
   * of them. Otherwise the others would wait for this rank forever, and so
   * would its own destructors of distributed objects.
   */
  [[noreturn]] void
  end_all_ranks(const std::string &what);
} // namespace geocone

#endif
