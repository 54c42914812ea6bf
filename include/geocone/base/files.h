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
  /** Name of the list of files that a run has written into its folder. */
  constexpr const char *list_of_files = "files.txt";

  /**
   * Sets the folder of the run. From then on each file that the functions below
   * create in it is first entered in its list (list_of_files), one name per
   * line. A later run may delete the files in that list, and no others.
   */
  void
  keep_list_of_files(const std::string &folder);

  /**
   * Enters a file of the run's folder in the list; ignores other files.
   * @return whether it was in the list before
   * @throws RunError for a symbolic link, or an existing file that is not in
   * the list
   */
  bool
  enter_in_list(const std::string &file_name);

  /** Whether a file of the run's folder is in the list. */
  bool
  is_in_list(const std::string &name);

  /** Waits until a file, or the entries of a folder, are on disk (fsync).
   *  @throws RunError */
  void
  sync_to_disk(const std::string &path);

  /**
   * Writes a file atomically: under a temporary name, renamed when it is
   * complete, so that readers never see an incomplete file. Symbolic links are
   * not followed.
   * @param is_durable whether it must survive a power failure: its content is
   * on disk before it is renamed, and its name before this function returns
   * @throws RunError with the file and the cause if it cannot be written
   */
  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write,
             const bool                                 is_durable = false);

  /** Text for the cause @p error (errno; 0: unknown) of a write error, with the
   *  remedy. */
  std::string
  cause_and_remedy(const int error);

  /**
   * A table of comma-separated values that grows line by line; each line is on
   * disk when add_line() returns. Column names carry their unit; those with a
   * comma, a quote or a line break are quoted (RFC 4180).
   */
  class CsvFile
  {
  public:
    CsvFile() = default;
    /** Opens the table. With @p goes_on it continues the table of an earlier
     *  process with the same columns, from the position restored by state(). */
    void
    open(const std::string              &file_name,
         const std::vector<std::string> &columns,
         const bool                      goes_on = false);

    /** End of the table, for checkpoints. Writing synchronises the table to
     *  disk first; reading truncates it to the stored length.
     *  @throws RunError if the table is shorter */
    void
    state(StateRow &row);

    /** @throws RunError if the line cannot be written; a partly written line is
     *  removed. */
    void
    add_line(const std::vector<double> &values);

  private:
    void
    add_text(const std::string &line);

    std::string    name;
    std::ofstream  file;
    std::size_t    n_columns = 0;
    std::uintmax_t size      = 0; ///< of the complete lines (bytes)
  };

  /**
   * Path of a file given relative to the folder of the parameter file or,
   * failing that, to the working directory.
   * @throws InputError if the file does not exist
   */
  std::string
  existing_file(const std::string &name,
                const std::string &folder_of_parameters,
                const std::string &parameter,
                const std::string &allowed);
} // namespace geocone

#endif
