// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_stop_request_h
#define geocone_base_stop_request_h

#include <geocone/base/exceptions.h>

#include <mpi.h>

namespace geocone
{
  /** Exception for a termination requested by a signal, thrown on all ranks. */
  class Stopped : public RunError
  {
  public:
    explicit Stopped(const int signal);

    const int signal;
  };

  /**
   * Installs the signal handlers. SIGINT (Ctrl-C), SIGTERM and SIGHUP (terminal
   * closed; not under nohup) request the run to stop as soon as its state is
   * consistent; a second signal terminates the program at once. Exceeding the
   * file size limit (SIGXFSZ) or writing to a closed pipe (SIGPIPE) is a write
   * error and does not terminate the program.
   */
  void
  watch_for_signals();

  /** Returns the signal number of a stop request received by any rank, or 0
   *  if there is none. Collective. */
  int
  stop_request(const MPI_Comm comm);

  /** Returns the signal number of a stop request received by this rank, or 0
   *  if there is none. */
  int
  stop_request_of_rank();

  /** Throws an exception that ends the run if any rank has received a stop
   *  request. Collective.
   *  @throws Stopped */
  void
  stop_if_asked(const MPI_Comm comm);

  /** Prints an error message on stderr. */
  void
  say_error(const std::string &what);

  /**
   * Prints an error message of this rank and terminates all ranks. To be called
   * for errors that only this rank detects. Otherwise the other ranks would
   * wait for this rank forever, as would the destructors of its distributed
   * objects.
   */
  [[noreturn]] void
  end_all_ranks(const std::string &what);
} // namespace geocone

#endif
