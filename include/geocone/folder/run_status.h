// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_folder_run_status_h
#define geocone_folder_run_status_h

#include <geocone/folder/json.h>

#include <string>

#include <sys/types.h>
#include <unistd.h>

// The "status" in summary.json always reports how a run ended: running | finished |
// failed: WHY | stopped: BY WHAT | killed: WHEN. While it continues, the lock of its
// folder keeps other processes from writing there.

namespace geocone
{
  /** Reads a summary.json file. Returns an empty object if the file cannot be
   *  read. */
  Json
  read_summary(const std::string &file_name);

  /** Section "run" of summary.json. It contains the process, host, start time
   *  and time of the last update (UTC, ISO 8601). */
  Json
  run_topic();

  /**
   * Replaces the status "running" in the summary.json of a folder with
   * @p status. Has an effect only if the summary belongs to process @p pid on
   * this host. If the disk is full or memory is exhausted, overwrites the
   * summary in place. Never throws.
   */
  void
  end_status(const std::string &folder,
             const std::string &status,
             const pid_t        pid = getpid()) noexcept;

  /** Name of the lock file in an output folder. */
  constexpr const char *lock_file = "run.lock";

  /**
   * Locks an output folder with the file run.lock. The lock holds until this
   * process ends or calls release_folder(). The file records the host, its boot and
   * the process. It is locked by flock(), which the kernel, or a file server that
   * supports locks, releases with the process in any case. Its modification time is
   * the sign of life, renewed by the watcher. An abandoned lock is taken over at
   * once if its process ran on this machine since the last boot, otherwise after
   * two minutes without a sign of life. Of several processes that request a folder
   * at once, only one obtains it.
   *
   * If hosts share a folder without sharing locks, the last host to take it over
   * obtains it: each host checks again after a moment, and later by check_folder().
   *
   * @return reason for refusal, or nothing
   */
  std::string
  take_folder(const std::string &folder);

  void
  release_folder();

  /** Checks that this run still holds the lock of its output folder. @throws
   *  RunError if another run has taken it over */
  void
  check_folder();
} // namespace geocone

#endif
