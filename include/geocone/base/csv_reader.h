// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_csv_reader_h
#define geocone_base_csv_reader_h

#include <fstream>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * A table in a .csv file whose first line names its columns, read row by row. It may
   * begin with a byte-order mark, have lines that end by CR LF, values in quotes, spaces
   * around them, and blank lines at its end. Errors are RunErrors that name the line.
   */
  class CsvReader
  {
  public:
    /** Reads the names of the columns. */
    explicit CsvReader(const std::string &file);

    const std::vector<std::string> &
    names() const
    {
      return columns;
    }

    /** @return whether there is another row, of as many values as there are columns */
    bool
    next_row(std::vector<std::string> &values);

    /** The value of a column as a number. @param otherwise said of what is none */
    double
    number(const std::vector<std::string> &values,
           const std::size_t               column,
           const char                     *otherwise = "is not a number") const;

    /** @name Of the last line, for messages: "line 3", "line 3, column 'x'" */
    /** @{ */
    std::string
    place() const;
    std::string
    place(const std::size_t column) const;
    /** @} */

  private:
    bool
    next_line(std::string &line);

    std::ifstream            in;
    std::size_t              n_lines = 0;
    std::vector<std::string> columns;
  };
} // namespace geocone

#endif
