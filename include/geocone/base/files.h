// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_files_h
#define geocone_base_files_h

#include <geocone/base/state_row.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace geocone
{
  /** Name of the list of the files that a run has written into its folder. */
  constexpr const char *list_of_files = "files.txt";

  /**
   * Names the folder of the run. From then on each file that the functions below
   * put into it is entered in its list (list_of_files), a name per line, before
   * the file is there: a later run may delete what stands in that list, and
   * nothing else.
   */
  void
  keep_list_of_files(const std::string &folder);

  /**
   * Enters a file in the list of its folder, if that is the run's.
   * @return whether it stood there before
   * @throws RunError if it is a symbolic link, or there already and not in the list
   */
  bool
  enter_in_list(const std::string &file_name);

  /** Whether a file of the run's folder is in the list. */
  bool
  is_in_list(const std::string &name);

  /** Waits until a file, or the names in a folder, are on the disk (fsync).
   *  @throws RunError */
  void
  sync_to_disk(const std::string &path);

  /**
   * Writes a file whole: into a temporary name first, renamed when it is
   * complete, so that a reader never sees a part of it. Nothing is written through
   * a symbolic link.
   * @param is_durable whether it must outlast a power cut: it is on the disk
   * before it gets its name, and so is that when this returns
   * @throws RunError naming the file and the cause if it cannot be written
   */
  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write,
             const bool                                 is_durable = false);

  /** The text of the cause @p error (errno; 0: unknown) of a failed writing,
   *  with the remedy. */
  std::string
  cause_and_remedy(const int error);

  /**
   * A table of comma-separated values that grows by whole lines; each line is
   * on the disk when add_line() returns. Column names carry their unit; those
   * with a comma, a quote or a line break are quoted (RFC 4180).
   */
  class CsvFile
  {
  public:
    CsvFile() = default;
    /** Begins the table; one that @p goes_on is that of an earlier process, with
     *  the same columns, and begins where state() says. */
    void
    open(const std::string              &file_name,
         const std::vector<std::string> &columns,
         const bool                      goes_on = false);

    /** Where the table ends, for a checkpoint, before which it is on the disk; what
     *  stands behind that is cut off when it is read.
     *  @throws RunError if the table is shorter */
    void
    state(StateRow &row);

    /** @throws RunError if the line cannot be written: what was written of it
     *  is taken back. */
    void
    add_line(const std::vector<double> &values);

  private:
    void
    add_text(const std::string &line);

    std::string    name;
    std::ofstream  file;
    std::size_t    n_columns = 0;
    std::uintmax_t size      = 0; ///< of the whole lines (bytes)
  };

  /**
   * The path of a file whose name is relative to the folder of the parameter
   * file, or else to that of the call.
   * @throws InputError if there is no such file
   */
  std::string
  existing_file(const std::string &name,
                const std::string &folder_of_parameters,
                const std::string &parameter,
                const std::string &allowed);
} // namespace geocone

#endif
