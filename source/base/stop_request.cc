// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/stop_request.h>
#include <geocone/base/terminal.h>
#include <geocone/base/units.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>

namespace geocone
{
  namespace
  {
    volatile std::sig_atomic_t request = 0;

    /** Whether SIGHUP is ignored; queried before MPI starts, which changes
     *  that. */
    const bool is_under_nohup = []() {
      struct sigaction present;
      return ::sigaction(SIGHUP, nullptr, &present) == 0 &&
             present.sa_handler == SIG_IGN;
    }();

    extern "C" // C linkage for a handler, internal to this unit
    {
    static void
    note_request(const int signal)
    {
      if (request != 0)
        {
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      request = signal;
    }
    }

    std::string
    name_of(const int signal)
    {
      return signal == SIGINT    ? "SIGINT (Ctrl-C)"
             : signal == SIGTERM ? "SIGTERM"
             : signal == SIGHUP  ? "SIGHUP"
                                 : "signal " + std::to_string(signal);
    }
  } // namespace

  Stopped::Stopped(const int signal)
    : RunError("stopped: by " + name_of(signal))
    , signal(signal)
  {}

  void
  watch_for_signals()
  {
    std::signal(SIGINT, &note_request);
    std::signal(SIGTERM, &note_request);
    std::signal(SIGHUP, is_under_nohup ? SIG_IGN : &note_request);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
  }

  int
  stop_request_of_rank()
  {
    return request;
  }

  int
  stop_request(const MPI_Comm comm)
  {
    int asked = request;
    int n_ranks;
    MPI_Comm_size(comm, &n_ranks);
    if (n_ranks > 1)
      MPI_Allreduce(MPI_IN_PLACE, &asked, 1, MPI_INT, MPI_MAX, comm);
    return asked;
  }

  void
  stop_if_asked(const MPI_Comm comm)
  {
    if (const int signal = stop_request(comm))
      throw Stopped(signal);
  }

  void
  say_error(const std::string &what)
  {
    std::cerr << coloured("error: ", Colour::red, STDERR_FILENO)
              << in_units(what) << std::endl;
  }

  void
  end_all_ranks(const std::string &what)
  {
    say_error(what);
    MPI_Abort(MPI_COMM_WORLD, 1);
    std::abort(); // not reached
  }
} // namespace geocone
