// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_run_folder_h
#define geocone_output_run_folder_h

#include <geocone/base/choice.h>
#include <geocone/base/parameter_file.h>

#include <mpi.h>

#include <string>

namespace geocone
{
  /** What to do if the folder of a run exists and is not empty. */
  enum class IfExists
  {
    automatic, ///< refuse one that the user has named, number another one
    number,    ///< take NAME-2, NAME-3, ...
    refuse,    ///< end
    overwrite  ///< delete the files that the list of the run before names
  };

  /** The parameter "Output/If folder exists", to be declared. */
  Choice<IfExists>
  if_exists_choice();

  /**
   * Makes the folder of a run, its list of files (files.h) and parameters.prm,
   * the parameters as used. Two runs that want the same folder at the same time
   * never both get it: the one that takes it (run_status.h) has it.
   * @param wanted its name
   * @param was_named whether the user has given it
   * @return the name of the folder, the same on all ranks
   * @throws InputError if it may not be used or cannot be written
   */
  std::string
  make_run_folder(const MPI_Comm     comm,
                  const std::string &wanted,
                  const bool         was_named,
                  const IfExists     if_exists);

  /**
   * The parameters that the run in a folder has used. Names of files in them count
   * from where they did for that run.
   * @throws InputError if it is not the folder of a run
   */
  ParameterFile
  parameters_of_run(const std::string &folder);

  /**
   * Enters the folder of a run that goes on; as long as this process lives, no
   * other one can (run_status.h).
   * @throws InputError if it is not one, or its run has not ended
   */
  void
  enter_run_folder(const MPI_Comm comm, const std::string &path);
} // namespace geocone

#endif
