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
   * Row-by-row reader of CSV files whose first line contains the column names.
   * Byte-order marks, CR LF line ends, quoted values, spaces around values and
   * blank lines at the end are accepted.
   * @throws RunError with the number of the faulty line
   */
  class CsvReader
  {
  public:
    /** Opens a CSV file and reads the column names. */
    explicit CsvReader(const std::string &file);

    const std::vector<std::string> &
    names() const
    {
      return columns;
    }

    /** Reads the next row of the file. @return false at the end of the file
     *  @throws RunError if the row does not have one value per column */
    bool
    next_row(std::vector<std::string> &values);

    /** Returns the numeric value in one column of a row. @param otherwise
     *  error text if the value is not a number */
    double
    number(const std::vector<std::string> &values,
           const std::size_t               column,
           const char                     *otherwise = "is not a number") const;

    /** @name Position of the last line read, for error messages: "line 3",
     *  "line 3, column 'x'" */
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
