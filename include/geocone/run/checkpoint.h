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
   * Writer and reader of the checkpoint files of a run. The file checkpoint-NNNNNN.h5
   * in the folder of the run contains the full state after NNNNNN completed steps, from
   * which `geocone --resume FOLDER` continues. Checkpoints are written at regular
   * intervals, and if a signal stops the run. A checkpoint and the corresponding tables
   * are complete on the disk before an older checkpoint is deleted.
   */
  class Checkpoint : public dealii::ParameterAcceptor
  {
  public:
    Checkpoint();

    void
    prepare(const MPI_Comm comm);

    /** Returns true if a checkpoint is due after a completed step. Collective. */
    bool
    is_due(const unsigned int step);

    /** Writes a checkpoint. Deletes surplus checkpoints, and checkpoints of later steps
     *  that are invalid because the run was resumed from an earlier checkpoint.
     *  Collective. @throws StepFailure */
    void
    write(const std::string                    &folder,
          const unsigned int                    step,
          const std::function<void(Archive &)> &save);

    /**
     * Reads the latest valid checkpoint in a folder. Invalid checkpoints cause
     * warnings. Collective.
     * @param load loads a checkpoint; returns on all ranks the reason why the run cannot
     * continue from the checkpoint, or an empty string
     * @param parameter name of the parameter for the folder
     * @throws InputError if the folder contains no valid checkpoint
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
