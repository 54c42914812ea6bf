// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_run_options_h
#define geocone_base_run_options_h

#include <string>

namespace geocone
{
  /** Options of a run from the command line, besides its parameters. */
  struct RunOptions
  {
    std::string name;           ///< of the parameter file, no extension
    std::string parameter_file; ///< its absolute name
    std::string folder; ///< of the results; empty: that of the parameter file
    bool        dry_run  = false; ///< check and estimate only
    bool        picture  = false; ///< of a dry run: write the model for drawing
    bool        force    = false; ///< run even if too large for the machine
    bool        resumes  = false; ///< resume the run in the folder
    bool may_run_scripts = false; ///< gmsh scripts, which can execute commands
  };
} // namespace geocone

#endif
