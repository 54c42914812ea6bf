// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_stop_request_h
#define geocone_base_stop_request_h

#include <geocone/base/exceptions.h>

#include <mpi.h>

namespace geocone
{
  /** The end that a signal has asked for; all ranks find it together. */
  class Stopped : public RunError
  {
  public:
    explicit Stopped(const int signal);

    const int signal;
  };

  /**
   * From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal has gone; not under
   * nohup) ask the run to stop, which it does at the next place where its state is whole; a second one ends the program at
   * once. Writing beyond a limit (SIGXFSZ) or into a closed pipe (SIGPIPE) is an
   * error of that writing and no end.
   */
  void
  watch_for_signals();

  /** The signal that has asked any rank to stop, or 0. Collective. */
  int
  stop_request(const MPI_Comm comm);

  /** The signal that has asked this rank to stop, or 0. */
  int
  stop_request_of_rank();

  /** @throws Stopped if any rank has been asked to stop. Collective. */
  void
  stop_if_asked(const MPI_Comm comm);

  /** Prints an error. */
  void
  say_error(const std::string &what);

  /**
   * Prints an error that one of several ranks has found alone, and ends all of
   * them: the others wait for it, and would do so for ever, as would this one in
   * the destructors of what is distributed.
   */
  [[noreturn]] void
  end_all_ranks(const std::string &what);
} // namespace geocone

#endif
