// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_run_options_h
#define geocone_base_run_options_h

#include <string>

namespace geocone
{
  /** Command-line options of a run, in addition to the parameter file. */
  struct RunOptions
  {
    std::string name;           ///< name of the parameter file, no extension
    std::string parameter_file; ///< absolute path
    std::string folder; ///< folder of results; empty: of the parameter file
    bool        dry_run  = false; ///< check and estimate the size only
    bool        picture  = false; ///< dry run: write the model for plotting
    bool        force    = false; ///< run even if too large for the machine
    bool        resumes  = false; ///< resume the run in the folder
    bool may_run_scripts = false; ///< allow gmsh scripts (can execute commands)
  };
} // namespace geocone

#endif
