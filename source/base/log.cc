// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/base/terminal.h>
#include <geocone/base/units.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <iostream>
#include <vector>

namespace geocone
{
  namespace
  {
    const std::string warning_word = "warning: ";
  } // namespace

  Log::Log(const MPI_Comm comm, const bool quiet)
    : speaks(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , quiet(quiet)
    , terminal(speaks && isatty(STDOUT_FILENO))
  {}

  Log::~Log()
  {
    end_progress_line();
  }

  void
  Log::open(const std::string &file_name, const bool goes_on)
  {
    if (!speaks)
      return;
    enter_in_list(file_name);
    file.open(file_name, goes_on ? std::ios::app : std::ios::out);
    if (!file)
      throw RunError("the log '" + file_name + "' cannot be written" +
                     cause_and_remedy(errno));
    file << said_before_open.str() << std::flush;
  }

  void
  Log::end_progress_line()
  {
    if (progress_width > 0)
      std::cout << std::endl;
    progress_width = 0;
  }

  void
  Log::print(const std::string &of_si)
  {
    if (!speaks)
      return;
    const std::string text = in_units(of_si);
    end_progress_line();
    if (!quiet)
      std::cout << (text.compare(0, warning_word.size(), warning_word) == 0
                      ? coloured(warning_word, Colour::yellow, STDOUT_FILENO) +
                          text.substr(warning_word.size())
                      : text)
                << std::endl;
    if (file.is_open())
      file << text << std::endl;
    else
      said_before_open << text << '\n';
  }

  void
  Log::warn(const std::string &text)
  {
    all_warnings.push_back(in_units(text));
    if (!speaks)
      return;
    if (quiet)
      std::cerr << coloured(warning_word, Colour::yellow, STDERR_FILENO)
                << in_units(text) << std::endl;
    print(warning_word + text);
  }

  void
  Log::progress(const std::string &of_si)
  {
    if (!speaks)
      return;
    const std::string text = in_units(of_si);
    if (!quiet && terminal)
      {
        // Blanks overwrite the rest of a longer line on the screen.
        std::cout << '\r' << text
                  << std::string(progress_width > text.size()
                                   ? progress_width - text.size()
                                   : 0,
                                 ' ')
                  << std::flush;
        progress_width = text.size();
      }
    else if (!quiet)
      std::cout << text << std::endl;
    if (file.is_open())
      file << text << std::endl;
  }

  std::string
  format(const char *pattern, ...)
  {
    va_list arguments, copy;
    va_start(arguments, pattern);
    va_copy(copy, arguments);
    std::vector<char> buffer(1 + std::vsnprintf(nullptr, 0, pattern, copy));
    va_end(copy);
    std::vsnprintf(buffer.data(), buffer.size(), pattern, arguments);
    va_end(arguments);
    return buffer.data();
  }

  std::string
  text_of_any_rank(const MPI_Comm comm, const std::string &text)
  {
    for (const std::string &other :
         dealii::Utilities::MPI::all_gather(comm, text))
      if (!other.empty())
        return other;
    return "";
  }
} // namespace geocone
