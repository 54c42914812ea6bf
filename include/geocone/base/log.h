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
   * Messages of a run: on the screen (unless quiet) and in the file log.txt of
   * its folder, from rank 0 only. On a terminal, progress is one line that is
   * overwritten; elsewhere, plain lines.
   */
  class Log
  {
  public:
    Log(const MPI_Comm comm, const bool quiet);
    ~Log();

    /** Starts to copy all messages, including earlier ones, to @p file_name;
     *  appends to it if @p goes_on. */
    void
    open(const std::string &file_name, const bool goes_on = false);

    /** Includes the warnings of an earlier process of the same run. */
    void
    add_earlier_warnings(const std::vector<std::string> &earlier)
    {
      all_warnings.insert(all_warnings.begin(), earlier.begin(), earlier.end());
    }

    /** Prints one or several complete lines. */
    void
    print(const std::string &text);

    /** Prints a warning, in quiet runs on the error stream. */
    void
    warn(const std::string &text);

    /** All warnings so far. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** Prints a line of progress, which the next one overwrites on a
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

  /** printf-like formatting into a string. */
  std::string
  format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));

  /** Text of the lowest rank whose text is not empty; otherwise empty.
   *  Collective. */
  std::string
  text_of_any_rank(const MPI_Comm comm, const std::string &text);
} // namespace geocone

#endif
