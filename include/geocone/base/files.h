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
  /** Name of the file that lists all files written by a run. */
  constexpr const char *list_of_files = "files.txt";

  /**
   * Sets the output folder of the run and creates the list of its files
   * (list_of_files). Each file that the functions below create in the folder is
   * first entered in the list, one name per line. A later run may delete the
   * listed files only.
   */
  void
  keep_list_of_files(const std::string &folder);

  /**
   * Adds a file in the output folder to the list of files written by the run.
   * Files in other folders are ignored.
   * @return whether the file was listed before
   * @throws RunError for a symbolic link, or an existing file that is not in
   * the list
   */
  bool
  enter_in_list(const std::string &file_name);

  /** Returns true if a file is in the list of files written by the run. */
  bool
  is_in_list(const std::string &name);

  /** Waits until a file or directory has been written to disk (fsync).
   *  @throws RunError */
  void
  sync_to_disk(const std::string &path);

  /**
   * Writes a file atomically: to a temporary file that is renamed when
   * complete. Other processes therefore never read an incomplete file. Symbolic
   * links are not followed.
   * @param is_durable whether the file must survive a power failure: its
   * content is on disk before it is renamed, and its name before this function
   * returns
   * @throws RunError with the file and the cause if the file cannot be written
   */
  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write,
             const bool                                 is_durable = false);

  /** Returns the error message for a failed write operation, with cause and
   *  remedy. @param error value of errno; 0: unknown */
  std::string
  cause_and_remedy(const int error);

  /**
   * Table of comma-separated values (CSV file), written row by row. Each line
   * is on disk when add_line() returns. Column names include the unit; names
   * with a comma, a quote or a line break are quoted (RFC 4180).
   */
  class CsvFile
  {
  public:
    CsvFile() = default;
    /** Opens the table. If @p goes_on, continues the table of an earlier
     *  process with the same columns, from the position restored by state(). */
    void
    open(const std::string              &file_name,
         const std::vector<std::string> &columns,
         const bool                      goes_on = false);

    /** Saves the length of the CSV file to a checkpoint, or restores it from
     *  one. Before writing, the table is synchronised to disk; after reading, it
     *  is truncated to the stored length. @throws RunError if the table is
     *  shorter */
    void
    state(StateRow &row);

    /** Appends a row of values to the table.
     *  @throws RunError if it cannot be written; a partial line is removed */
    void
    add_line(const std::vector<double> &values);

  private:
    void
    add_text(const std::string &line);

    std::string    name;
    std::ofstream  file;
    std::size_t    n_columns = 0;
    std::uintmax_t size      = 0; ///< size of the complete lines (bytes)
  };

  /**
   * Returns the path of an existing input file. The file is searched for in the
   * folder of the parameter file and then in the working directory.
   * @throws InputError if the file does not exist
   */
  std::string
  existing_file(const std::string &name,
                const std::string &folder_of_parameters,
                const std::string &parameter,
                const std::string &allowed);
} // namespace geocone

#endif
