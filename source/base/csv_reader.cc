// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/csv_reader.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>

#include <charconv>
#include <cstring>
#include <filesystem>

namespace geocone
{
  namespace
  {
    /** Bytes per line; longer lines mean that the file is not a table. */
    constexpr std::size_t longest_line = 4096;

    std::string
    trimmed(const std::string &text)
    {
      const char       *space = " \t\r\n";
      const std::size_t first = text.find_first_not_of(space);
      if (first == std::string::npos)
        return "";
      std::string part =
        text.substr(first, text.find_last_not_of(space) - first + 1);
      if (part.size() >= 2 && part.front() == '"' && part.back() == '"')
        part = trimmed(part.substr(1, part.size() - 2));
      return part;
    }

    /** Splits a line at its commas. */
    std::vector<std::string>
    cut(const std::string &line)
    {
      std::vector<std::string> parts(1);
      for (const char c : line)
        if (c == ',')
          parts.emplace_back();
        else
          parts.back() += c;
      for (std::string &part : parts)
        part = trimmed(part);
      return parts;
    }
  } // namespace

  CsvReader::CsvReader(const std::string &file)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      throw RunError("it is no regular file");
    in.open(file, std::ios::binary);
    std::string line;
    if (!next_line(line))
      throw RunError("it is empty");
    if (line.compare(0, 3, "\xEF\xBB\xBF") == 0) // a byte-order mark
      line.erase(0, 3);
    columns = cut(line);
  }

  bool
  CsvReader::next_line(std::string &line)
  {
    char buffer[longest_line + 1];
    in.getline(buffer, sizeof(buffer));
    const std::size_t n = in.gcount() - (in.eof() || in.fail() ? 0 : 1);
    if (n == 0 && in.eof())
      return false;
    ++n_lines;
    if (in.fail())
      throw RunError(
        place() +
        format(" has more than %zu characters: is it a table?", longest_line));
    if (std::memchr(buffer, '\0', n) != nullptr)
      throw RunError(place() + " is no text");
    line.assign(buffer, n);
    return true;
  }

  bool
  CsvReader::next_row(std::vector<std::string> &values)
  {
    std::string line;
    if (!next_line(line))
      return false;
    if (trimmed(line).empty())
      {
        const std::string blank = place();
        while (next_line(line))
          if (!trimmed(line).empty())
            throw RunError(blank + " is blank, with others below it");
        return false;
      }
    values = cut(line);
    if (values.size() != columns.size())
      throw RunError(place() + format(": %zu values instead of %zu",
                                      values.size(),
                                      columns.size()));
    return true;
  }

  double
  CsvReader::number(const std::vector<std::string> &values,
                    const std::size_t               column,
                    const char                     *otherwise) const
  {
    const std::string &text  = values[column];
    const char        *begin = text.c_str() + (text[0] == '+' ? 1 : 0),
               *end          = text.c_str() + text.size();
    double     value         = 0.;
    const auto parsed        = std::from_chars(begin, end, value);
    if (parsed.ec == std::errc::result_out_of_range && parsed.ptr == end)
      otherwise = "is beyond the numbers that a computer has";
    if (parsed.ec != std::errc() || parsed.ptr != end)
      throw RunError(place(column) + ": '" + text + "' " + otherwise);
    return value;
  }

  std::string
  CsvReader::place() const
  {
    return format("line %zu", n_lines);
  }

  std::string
  CsvReader::place(const std::size_t column) const
  {
    return place() + ", column '" + columns[column] + "'";
  }
} // namespace geocone
