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
  /** What the programs are called with. */
  struct CommandLine
  {
    std::string                file;
    std::vector<std::string>   files_to_check;
    std::string                folder;
    std::vector<std::string>   overrides;
    std::string                defaults_file;
    std::optional<std::string> resumed; ///< folder of the run
    bool                       quiet           = false;
    bool                       dry_run         = false;
    bool                       picture         = false;
    bool                       force           = false;
    bool                       may_run_scripts = false;
    bool                       help            = false;
    bool                       version         = false;
  };

  /**
   * Reads FILE, --output, --set, --quiet, --dry-run, --picture, --check FILE...,
   * --force, --run-gmsh-script, --resume, --defaults, --help and --version.
   * @param lacking those of these options that the program does not have
   * @throws InputError on anything else
   */
  CommandLine
  parse_command_line(const int                       argc,
                     char                          **argv,
                     const std::string              &program,
                     const std::vector<std::string> &lacking = {});

  /** Prints the versions of the program, the compiler and deal.II. */
  void
  print_version(const std::string &program);

  /** The run of a parameter file that was called for. */
  RunOptions
  run_options(const CommandLine &call, const ParameterFile &file);

  /** What a run leaves to be drawn. */
  struct Drawing
  {
    std::string folder; ///< of the run; empty: nothing
    bool        quiet      = false;
    bool        only_model = false; ///< of a dry run
  };

  /**
   * The frame of a program: starts and ends MPI, watches for signals, prints what
   * @p run throws, and draws at the end, after that of MPI, which does not like its
   * processes to be copied.
   * @param argv its first entry is the program; libraries see no other
   * @param run gives the exit code
   * @return the exit code of the program: what @p run gives; 1 after an error;
   * 128 + its number after a signal
   */
  int
  run_program(char **argv, const std::function<int(Drawing &)> &run);

  /**
   * Ends all ranks if the exception that is being handled is this rank's own. To
   * be called before what is distributed is destroyed, which waits for all ranks.
   */
  void
  end_if_alone();
} // namespace geocone

#endif
