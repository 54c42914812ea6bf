// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>

#include <deal.II/base/exceptions.h>

#include <filesystem>

namespace geocone
{
  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write)
  {
    const std::string temporary = file_name + ".part";
    std::ofstream     out(temporary);
    try
      {
        if (out)
          write(out);
      }
    catch (const dealii::ExceptionBase &)
      {
        // The library's writers throw where a stream fails.
        out.setstate(std::ios::failbit);
      }
    out.close();
    std::error_code error;
    if (out)
      std::filesystem::rename(temporary, file_name, error);
    if (!out)
      std::filesystem::remove(temporary, error);
    if (!out || error)
      throw RunError("the file '" + file_name +
                     "' cannot be written: is the disk full?");
  }

  void
  CsvFile::open(const std::string              &file_name,
                const std::vector<std::string> &columns)
  {
    name      = file_name;
    n_columns = columns.size();
    file.open(name);
    std::string line;
    for (const std::string &column : columns)
      line += (line.empty() ? "" : ",") + column;
    file << line + "\n" << std::flush;
    check();
  }

  void
  CsvFile::add_line(const std::vector<double> &values)
  {
    AssertDimension(values.size(), n_columns);
    std::string line;
    for (const double value : values)
      line += (line.empty() ? "" : ",") + format("%.12g", value);
    file << line + "\n" << std::flush;
    check();
  }

  void
  CsvFile::check() const
  {
    if (!file)
      throw RunError("the table '" + name +
                     "' cannot be written: is the disk full?");
  }
} // namespace geocone
