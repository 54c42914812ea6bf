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
   * Log of a run: rank 0 prints messages on the screen and to the file log.txt
   * in the output folder. In quiet runs, messages are written to the file only.
   * On a terminal, progress is shown in one line that is overwritten;
   * elsewhere, in plain lines.
   */
  class Log
  {
  public:
    Log(const MPI_Comm comm, const bool quiet);
    ~Log();

    /** Opens the log file and writes all messages to it, including earlier
     *  ones. If @p goes_on, the messages are appended to an existing file. */
    void
    open(const std::string &file_name, const bool goes_on = false);

    /** Prepends the warnings that a resumed run printed before it was
     *  interrupted. */
    void
    add_earlier_warnings(const std::vector<std::string> &earlier)
    {
      all_warnings.insert(all_warnings.begin(), earlier.begin(), earlier.end());
    }

    /** Prints one or more complete lines. */
    void
    print(const std::string &text);

    /** Prints a warning. In quiet runs, the warning is printed on stderr. */
    void
    warn(const std::string &text);

    /** Returns all warnings printed so far, including warnings from before a
     *  restart. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** Prints a progress line. On a terminal, the next progress line
     *  overwrites it. */
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

  /** Formats a string as printf() does. */
  std::string
  format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));

  /** Returns, on every rank, the first non-empty string in rank order. Empty if
   *  the strings of all ranks are empty. Collective. */
  std::string
  text_of_any_rank(const MPI_Comm comm, const std::string &text);
} // namespace geocone

#endif
