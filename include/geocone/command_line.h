// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_command_line_h
#define geocone_command_line_h

#include <map>
#include <string>
#include <vector>

namespace geocone
{
  /** What the programs are called with. */
  struct CommandLine
  {
    std::string                        file;
    std::string                        folder;
    std::vector<std::string>           overrides;
    std::string                        defaults_file;
    std::map<std::string, std::string> own; ///< options of this program only
    bool                               quiet   = false;
    bool                               help    = false;
    bool                               version = false;
  };

  /**
   * Reads FILE.prm, --output, --set, --quiet, --defaults, --help, --version, and
   * the options @p own of the program, e.g. "--replay", which take a value.
   * @throws InputError on anything else
   */
  CommandLine
  parse_command_line(const int                       argc,
                     char                          **argv,
                     const std::string              &program,
                     const std::vector<std::string> &own = {});

  /** The call of scripts/plot that draws a run. */
  std::string
  drawing_command(const std::string &folder, const bool quiet);

  /** Draws; warns if that fails. To be called after the end of MPI, which does
   *  not like its processes to be copied. */
  void
  draw(const std::string &drawing_command);
} // namespace geocone

#endif
