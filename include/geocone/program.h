// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_program_h
#define geocone_program_h

#include <geocone/base/types.h>
#include <geocone/command_line.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Executes the program for scenes of dimension dim, with the given
   *  command-line arguments.
   *  @return the exit code */
  int
  run_geocone(int argc, char **argv);

  /**
   * Checks the parameter file of a scene of dimension dim without running it,
   * as the option --dry-run does.
   * @param call command line with the other options
   * @throws InputError if the file is invalid
   */
  void
  check_file(const std::string &file, const CommandLine &call);
} // namespace geocone::GEOCONE_DIM

#endif
