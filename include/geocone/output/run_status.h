// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_run_status_h
#define geocone_output_run_status_h

#include <geocone/output/json.h>

#include <string>

#include <sys/types.h>
#include <unistd.h>

// How a run ended is told by the "status" of its summary.json in every case:
// running | finished | failed: WHY | stopped: BY WHAT | killed: WHEN. That it goes on,
// and nobody else may write into its folder, is recorded in the folder's lock.

namespace geocone
{
  /** The summary in a file; empty if there is none that can be read. */
  Json
  read_summary(const std::string &file_name);

  /**
   * The topic "run" of a summary: the program's process and host, when it began
   * and when it was seen last (UTC, ISO 8601).
   */
  Json
  run_topic();

  /** Seconds of CPU that this rank has used. */
  double
  cpu_time_of_rank();

  /**
   * Sets the status of the summary in @p folder to @p status if it is "running" and
   * of the run of process @p pid on this host; where the disk is full or memory has
   * run out, by writing over it in place. Never throws.
   */
  void
  end_status(const std::string &folder,
             const std::string &status,
             const pid_t        pid = getpid()) noexcept;

  /** Name of the file by which a run holds its folder. */
  constexpr const char *lock_file = "run.lock";

  /**
   * Takes a folder for this process until it ends or release_folder(), by the file
   * run.lock in it. That tells the host, its start, and the process; it is locked
   * (flock), which the kernel, and a server of files that knows locks, ends with the
   * process, however that ends; and its time is the sign of life, which the watcher
   * renews. A lock that nobody holds is taken over at once if the process was of this
   * machine since its last start, else if its sign of life is older than
   * two minutes. Of several processes that want a folder at once one has it.
   *
   * Where hosts share a folder without sharing locks, the one that takes over last has
   * it: both look again after a moment, and check_folder() later.
   *
   * @return why not, or nothing
   */
  std::string
  take_folder(const std::string &folder);

  void
  release_folder();

  /** @throws RunError if another run has taken the folder of this one over */
  void
  check_folder();
} // namespace geocone

#endif
