// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_run_options_h
#define geocone_base_run_options_h

#include <string>

namespace geocone
{
  /** What the command line says of a run beyond its parameters. */
  struct RunOptions
  {
    std::string name;           ///< of the parameter file, without its ending
    std::string parameter_file; ///< its absolute name
    std::string folder; ///< of the results; empty: that of the parameters
    bool        dry_run  = false; ///< check and estimate only
    bool        picture  = false; ///< of a dry run: describe the model to those who draw
    bool        force    = false; ///< run what is too large for the machine
    bool        resumes  = false; ///< go on with the run in the folder
    bool may_run_scripts = false; ///< gmsh scripts, which can run commands
  };
} // namespace geocone

#endif
