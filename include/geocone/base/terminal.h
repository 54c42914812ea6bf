// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_terminal_h
#define geocone_base_terminal_h

#include <unistd.h>

#include <cstdlib>
#include <string>

namespace geocone
{
  /** Terminal colours, with the colour codes of ANSI escape sequences. */
  enum class Colour
  {
    red    = 31,
    yellow = 33
  };

  /** Encloses a word in ANSI escape sequences for bold coloured text. The word
   *  is returned unchanged if the stream is not a colour terminal or if colours
   *  are disabled (https://no-color.org).
   *  @param stream STDOUT_FILENO or STDERR_FILENO */
  inline std::string
  coloured(const std::string &word, const Colour colour, const int stream)
  {
    const char *const off      = std::getenv("NO_COLOR");
    const char *const terminal = std::getenv("TERM");
    if ((off != nullptr && *off != '\0') || terminal == nullptr ||
        std::string(terminal) == "dumb" || isatty(stream) == 0)
      return word;
    return "\033[1;" + std::to_string(static_cast<int>(colour)) + "m" + word +
           "\033[0m";
  }
} // namespace geocone

#endif
