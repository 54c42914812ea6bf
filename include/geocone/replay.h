// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_replay_h
#define geocone_replay_h

#include <geocone/base/log.h>
#include <geocone/base/types.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Solves a frozen problem again, without its scene, on one rank: an incremental
   * problem in HDF5 (FrozenProblem), or a reduced problem in the text format of
   * Siconos (ReducedProblem).
   *
   * @param overrides parameters of the sections Newton, Linear solver, Time
   * stepping (friction), Materials and Output ('If folder exists', as of runs), as
   * on the command line
   * @param folder where summary.json, stress.csv and the parameters go, or empty:
   * nowhere
   * @return whether the problem was solved
   * @throws InputError, RunError
   */
  bool
  replay(const std::string              &file_name,
         const std::vector<std::string> &overrides,
         const std::string              &folder,
         Log                            &log);
} // namespace geocone::GEOCONE_DIM

#endif
