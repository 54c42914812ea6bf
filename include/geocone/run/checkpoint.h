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
   * Files checkpoint-NNNNNN.h5 in the folder of a run, NNNNNN the steps of the
   * programme that are done: all state, from which `geocone --resume FOLDER` goes
   * on. They are written at a cadence, and when a signal stops the run; each is
   * complete and on the disk, with the tables that it refers to, before an older one
   * is deleted.
   */
  class Checkpoint : public dealii::ParameterAcceptor
  {
  public:
    Checkpoint();

    void
    prepare(const MPI_Comm comm);

    /** Whether one is due after this step. Collective. */
    bool
    is_due(const unsigned int step);

    /** Writes one, and deletes those of this run that are too many or, since it
     *  went back to an earlier one, not true any more. Collective.
     *  @throws StepFailure */
    void
    write(const std::string                    &folder,
          const unsigned int                    step,
          const std::function<void(Archive &)> &save);

    /**
     * Reads the last one of a folder that is good; of others it warns. Collective.
     * @param load tells, on all ranks, why the run cannot go on from it, or nothing
     * @param parameter what names the folder
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
