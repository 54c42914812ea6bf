// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_checkpoint_h
#define geocone_run_checkpoint_h

#include <geocone/base/archive.h>
#include <geocone/base/log.h>

#include <deal.II/base/parameter_acceptor.h>

#include <chrono>
#include <functional>
#include <string>

namespace geocone
{
  /**
   * Files checkpoint-NNNNNN.h5 in the folder of a run, NNNNNN the number of completed
   * steps: the full state, from which `geocone --resume FOLDER` continues. They are
   * written at a cadence, and when a signal stops the run. Each is complete and on the
   * disk, with the tables that it refers to, before an older one is deleted.
   */
  class Checkpoint : public dealii::ParameterAcceptor
  {
  public:
    Checkpoint();

    void
    prepare(const MPI_Comm comm);

    /** Whether a checkpoint is due after this step. Collective. */
    bool
    is_due(const unsigned int step);

    /** Writes a checkpoint. Deletes surplus ones, and those that became invalid because
     *  the run went back to an earlier one. Collective. @throws StepFailure */
    void
    write(const std::string                    &folder,
          const unsigned int                    step,
          const std::function<void(Archive &)> &save);

    /**
     * Reads the latest valid checkpoint of a folder, with warnings about invalid ones.
     * Collective.
     * @param load returns, on all ranks, why the run cannot continue from it, or
     * nothing
     * @param parameter that names the folder
     * @throws InputError if there is none
     */
    void
    read(const std::string                                 &folder,
         Log                                               &log,
         const std::function<std::string(const Archive &)> &load,
         const std::string &parameter = "--resume");

  private:
    unsigned int every_steps   = 0;
    double       every_minutes = 0.;
    unsigned int keep          = 2;

    MPI_Comm                              comm = MPI_COMM_NULL;
    std::chrono::steady_clock::time_point last;
  };
} // namespace geocone

#endif
