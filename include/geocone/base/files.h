// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_files_h
#define geocone_base_files_h

#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Writes a file whole: into a temporary name first, renamed when it is
   * complete, so that a reader never sees a part of it.
   * @throws RunError naming the file if it cannot be written (full disk, ...)
   */
  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write);

  /**
   * A table of comma-separated values that grows by whole lines; each line is
   * on the disk when add_line() returns. Column names carry their unit.
   */
  class CsvFile
  {
  public:
    CsvFile() = default;
    void
    open(const std::string &file_name, const std::vector<std::string> &columns);
    void
    add_line(const std::vector<double> &values);

  private:
    void
    check() const;

    std::string   name;
    std::ofstream file;
    std::size_t   n_columns = 0;
  };
} // namespace geocone

#endif
