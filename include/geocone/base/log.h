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
   * What a run says: on the screen (unless quiet) and in the file log.txt of its
   * folder. Rank 0 speaks for all. Progress is one line that is overwritten
   * where the screen is a terminal, and a plain line elsewhere.
   */
  class Log
  {
  public:
    Log(const MPI_Comm comm, const bool quiet);
    ~Log();

    /** Starts to copy everything into @p file_name, what was said included;
     *  behind what is there if it @p goes_on. */
    void
    open(const std::string &file_name, const bool goes_on = false);

    /** Of an earlier process of the same run: they count, too. */
    void
    add_earlier_warnings(const std::vector<std::string> &earlier)
    {
      all_warnings.insert(all_warnings.begin(), earlier.begin(), earlier.end());
    }

    /** One or several complete lines. */
    void
    print(const std::string &text);

    /** A warning: also shown on the error stream of a quiet run. */
    void
    warn(const std::string &text);

    /** All warnings so far. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** A line of progress, which the next one overwrites on a terminal. */
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

  /** The text of the lowest rank that has one, or nothing. Collective. */
  std::string
  text_of_any_rank(const MPI_Comm comm, const std::string &text);
} // namespace geocone

#endif
