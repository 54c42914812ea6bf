// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_log_h
#define geocone_base_log_h

#include <mpi.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Log of a run: prints messages on the screen (unless quiet) and to the file
   * log.txt in the folder of the run, from rank 0 only. On a terminal, progress
   * is shown in one line that is overwritten; elsewhere, in plain lines.
   */
  class Log
  {
  public:
    Log(const MPI_Comm comm, const bool quiet);
    ~Log();

    /** Copies all messages, including earlier ones, to the file @p file_name;
     *  appends to the file if @p goes_on. */
    void
    open(const std::string &file_name, const bool goes_on = false);

    /** Inserts the warnings of an earlier process of the same run (resumed
     *  run). */
    void
    add_earlier_warnings(const std::vector<std::string> &earlier)
    {
      all_warnings.insert(all_warnings.begin(), earlier.begin(), earlier.end());
    }

    /** Prints one or several complete lines. */
    void
    print(const std::string &text);

    /** Prints a warning; in quiet runs, on the error stream. */
    void
    warn(const std::string &text);

    /** All warnings printed so far, including those of earlier processes. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** Prints a progress line, which the next progress line overwrites on a
     *  terminal. */
    void
    progress(const std::string &text);

  private:
    void
    end_progress_line();

    std::vector<std::string> all_warnings;

    const bool         speaks;
    const bool         quiet;
    const bool         terminal;
    std::size_t        progress_width = 0;
    std::ostringstream said_before_open;
    std::ofstream      file;
  };

  /** String formatted as by printf(). */
  std::string
  format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));

  /** First non-empty text in the order of ranks, returned on all ranks; empty
   *  if there is none. Collective. */
  std::string
  text_of_any_rank(const MPI_Comm comm, const std::string &text);
} // namespace geocone

#endif
