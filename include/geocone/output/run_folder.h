// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_run_folder_h
#define geocone_output_run_folder_h

#include <mpi.h>

#include <string>

namespace geocone
{
  /**
   * Makes the folder of a run and writes the parameters as used into it.
   * @param wanted its name
   * @param if_exists what to do if it exists and is not empty: "number" (take
   * wanted-2, ...), "refuse", or "overwrite" (remove the files of the run
   * before, and nothing else)
   * @return the name of the folder, the same on all ranks
   * @throws InputError if it may not be used or cannot be written
   */
  std::string
  make_run_folder(const MPI_Comm     comm,
                  const std::string &wanted,
                  const std::string &if_exists);
} // namespace geocone

#endif
