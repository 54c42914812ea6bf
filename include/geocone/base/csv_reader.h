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
   * Row-by-row reader of a .csv file whose first line contains the column
   * names. Byte-order marks, CR LF line ends, quoted values, spaces around
   * values and blank lines at the end are accepted. Errors are RunErrors that
   * name the line.
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

    /** @return whether there is another row, with as many values as columns */
    bool
    next_row(std::vector<std::string> &values);

    /** Value of a column as a number. @param otherwise error text for
     *  non-numbers */
    double
    number(const std::vector<std::string> &values,
           const std::size_t               column,
           const char                     *otherwise = "is not a number") const;

    /** @name Position of the last line, for messages: "line 3", "line 3, column
     *  'x'" */
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
