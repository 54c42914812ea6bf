// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_program_h
#define geocone_program_h

#include <geocone/base/types.h>
#include <geocone/command_line.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Performs everything that the program's arguments request, for scenes of the
   *  build's dimension.
   *  @return the exit code */
  int
  run_geocone(int argc, char **argv);

  /**
   * Checks a parameter file of this dimension as --dry-run does.
   * @param call its other options
   * @throws InputError if it is wrong
   */
  void
  check_file(const std::string &file, const CommandLine &call);
} // namespace geocone::GEOCONE_DIM

#endif
