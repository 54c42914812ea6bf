// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_program_h
#define geocone_program_h

#include <geocone/base/types.h>
#include <geocone/command_line.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** All that the program does with its arguments, for scenes of one dimension: that of
   *  the build. @return its exit code */
  int
  run_geocone(int argc, char **argv);

  /**
   * Checks a parameter file of this dimension as --dry-run does.
   * @param call with what other options
   * @throws InputError if it is wrong
   */
  void
  check_file(const std::string &file, const CommandLine &call);
} // namespace geocone::GEOCONE_DIM

#endif
