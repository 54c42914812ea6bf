// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_watcher_h
#define geocone_output_watcher_h

#include <string>

#include <sys/types.h>

namespace geocone
{
  /**
   * A process of its own that outlives the program and then looks at the summary
   * of its run: one that still says "running" is changed to "killed", for its
   * process was ended by force (kill -9, lack of memory, a crash, an abort) and
   * could not say so itself. If the watcher is killed, too, the topic "run" of
   * the summary (run_topic()) still tells which process it was and when it was
   * seen last. As long as the program lives it renews the sign of life of the
   * folder's lock.
   *
   * The kernel gives a process that is killed no time to write, so that another one
   * has to. It is forked before MPI starts, whose processes must not be copied.
   */
  class Watcher
  {
  public:
    Watcher();
    ~Watcher();
    Watcher(const Watcher &) = delete;
    Watcher &
    operator=(const Watcher &) = delete;

    /** The folder of the run of this process; a later call replaces it. */
    static void
    watch(const std::string &folder);

  private:
    pid_t watcher = -1;
  };
} // namespace geocone

#endif
