// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_command_line_h
#define geocone_command_line_h

#include <geocone/base/parameter_file.h>
#include <geocone/base/run_options.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  /** Command line of a program. */
  struct CommandLine
  {
    std::string                file;
    std::vector<std::string>   files; ///< to check, or several to read
    std::string                folder;
    std::vector<std::string>   overrides;
    std::string                defaults_file;
    std::optional<std::string> resumed; ///< folder of the run
    std::optional<std::string> help; ///< its topic; empty: options and sections
    bool                       quiet           = false;
    bool                       dry_run         = false;
    bool                       picture         = false;
    bool                       force           = false;
    bool                       may_run_scripts = false;
    bool                       schema          = false;
    bool                       version         = false;
  };

  /**
   * Reads FILE, --output, --set, --quiet, --dry-run, --picture, --check FILE...,
   * --force, --run-gmsh-script, --load-library (may_load_libraries()), --resume,
   * --defaults, --help [TOPIC], --schema and --version.
   * @param lacking options that the program does not support
   * @param many whether the program takes any number of files
   * @throws InputError on anything else
   */
  CommandLine
  parse_command_line(const int                       argc,
                     char                          **argv,
                     const std::string              &program,
                     const std::vector<std::string> &lacking = {},
                     const bool                      many    = false);

  /** Prints the versions of the program, the compiler and deal.II. */
  void
  print_version(const std::string &program);

  /** Options of the run requested by a command line. */
  RunOptions
  run_options(const CommandLine &call, const ParameterFile &file);

  /** Request to draw the results of a run. */
  struct Drawing
  {
    std::string folder; ///< of the run; empty: no drawing
    bool        quiet      = false;
    bool        only_model = false; ///< for a dry run
  };

  /**
   * Frame of a program: starts and ends MPI, handles signals, prints exceptions of @p
   * run, and draws at the end. Drawing follows the end of MPI, whose processes must not
   * be forked.
   * @param argv its first entry is the program; libraries receive no other
   * @param run returns the exit code
   * @return the exit code of the program: that of @p run; 1 after an error; 128 + its
   * number after a signal
   */
  int
  run_program(char **argv, const std::function<int(Drawing &)> &run);

  /** Terminates all ranks if the present exception occurred on this rank only.
   *  Must be called before distributed objects are destroyed, which waits for
   *  all ranks. */
  void
  end_if_alone();
} // namespace geocone

#endif
