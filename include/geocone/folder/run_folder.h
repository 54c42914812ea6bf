// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_folder_run_folder_h
#define geocone_folder_run_folder_h

#include <geocone/base/choice.h>
#include <geocone/base/parameter_file.h>

#include <mpi.h>

#include <string>

namespace geocone
{
  /** Treatment of an existing output folder that is not empty. */
  enum class IfExists
  {
    automatic, ///< refuse if named by the user, else number
    number,    ///< use NAME-2, NAME-3, ...
    refuse,    ///< terminate
    overwrite  ///< delete the files listed by the earlier run
  };

  /** Returns the parameter "Output/If folder exists", which the caller declares. */
  Choice<IfExists>
  if_exists_choice();

  /**
   * Creates the output folder of a run. The folder contains the list of written
   * files (files.h) and parameters.prm (the parameters as used). If two runs request
   * the same folder at the same time, only the run that locks it (run_status.h)
   * obtains it.
   * @param wanted name of the folder
   * @param was_named whether the user has given the name
   * @return the name of the folder, the same on all ranks
   * @throws InputError if the folder may not be used or cannot be written
   */
  std::string
  make_run_folder(const MPI_Comm     comm,
                  const std::string &wanted,
                  const bool         was_named,
                  const IfExists     if_exists);

  /**
   * Reads the parameter file of a run from the output folder of the run. File
   * names among the parameters are relative to the same folder as in that run.
   * @throws InputError if it is not the folder of a run
   */
  ParameterFile
  parameters_of_run(const std::string &folder);

  /**
   * Reopens and locks the output folder of a run to be resumed. The lock holds for
   * the lifetime of this process (run_status.h).
   * @throws InputError if it is not the folder of a run, or its run has not ended
   */
  void
  enter_run_folder(const MPI_Comm comm, const std::string &path);
} // namespace geocone

#endif
