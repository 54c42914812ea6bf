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
  /** Parsed command line of a program. */
  struct CommandLine
  {
    std::string                file;
    std::vector<std::string>
      files; ///< parameter files to check, or several to run
    std::string                folder;
    std::vector<std::string>   overrides;
    std::string                defaults_file;
    std::optional<std::string> resumed; ///< folder of the run to resume
    std::optional<std::string> help;    ///< topic of --help; empty: overview
    bool                       quiet           = false;
    bool                       dry_run         = false;
    bool                       picture         = false;
    bool                       force           = false;
    bool                       may_run_scripts = false;
    bool                       schema          = false;
    bool                       version         = false;
  };

  /**
   * Parses the command line of a program. The options are FILE, --output, --set,
   * --quiet, --dry-run, --picture, --check FILE..., --force, --run-gmsh-script,
   * --load-library (may_load_libraries()), --resume, --defaults, --help [TOPIC],
   * --schema and --version.
   * @param lacking options that the program does not support
   * @param many whether the program accepts any number of parameter files
   * @throws InputError on any other argument
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

  /** Returns the run options given by a command line and its parameter file. */
  RunOptions
  run_options(const CommandLine &call, const ParameterFile &file);

  /** Request to plot the results after a run. */
  struct Drawing
  {
    std::string folder; ///< results to plot; empty: no plot
    bool        quiet      = false;
    bool        only_model = false; ///< model without results (dry run)
  };

  /**
   * Main function of a program: initialises MPI, executes @p run and finalises MPI.
   * It also installs the signal handlers and prints the exceptions thrown by @p run.
   * Results are plotted after MPI has been finalised, because MPI processes must not
   * be forked.
   * @param argv arguments of the program; libraries receive only the program name
   * @param run returns the exit code
   * @return the exit code of the program: the exit code of @p run; 1 after an error;
   * 128 + the signal number after a signal
   */
  int
  run_program(char **argv, const std::function<int(Drawing &)> &run);

  /** Terminates all ranks if the exception being handled was thrown on this rank
   *  only. Must be called before distributed objects are destroyed, because their
   *  destructors wait for all ranks. */
  void
  end_if_alone();
} // namespace geocone

#endif
