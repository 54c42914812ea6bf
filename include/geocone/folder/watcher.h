// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_folder_watcher_h
#define geocone_folder_watcher_h

#include <string>

#include <sys/types.h>

namespace geocone
{
  /**
   * Watchdog process that corrects the status of a killed run in summary.json. It
   * replaces "running" by "killed", since the process was ended by force (kill -9,
   * lack of memory, a crash, an abort) and could not report that itself. If the
   * watcher is killed as well, the topic "run" of the summary (run_topic()) still
   * identifies the process and its last sign of life. While the program lives, the
   * watcher renews the sign of life of the folder's lock.
   *
   * A separate process is needed because the kernel gives a killed process no time to
   * write. It is forked before MPI starts, whose processes must not be copied.
   */
  class Watcher
  {
  public:
    Watcher();
    ~Watcher();
    Watcher(const Watcher &) = delete;
    Watcher &
    operator=(const Watcher &) = delete;

    /** Sets the output folder to be watched, which replaces an earlier folder. */
    static void
    watch(const std::string &folder);

  private:
    pid_t watcher = -1;
  };
} // namespace geocone

#endif
