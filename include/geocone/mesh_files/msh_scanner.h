// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_files_msh_scanner_h
#define geocone_mesh_files_msh_scanner_h

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mesh_files/msh_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Supported versions of .msh files, for error messages. */
  inline const std::string msh_versions =
    "gmsh's .msh files of version 2.2 or 4.1, ASCII or binary";

  /** Returns true if a character is white space between words of a .msh
   *  file. */
  inline bool
  is_msh_space(const char c)
  {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' ||
           c == '\f';
  }

  /** Excerpt of a file in printable characters, for error messages. */
  inline std::string
  shown_part(const std::string &text)
  {
    constexpr std::size_t longest = 30;
    std::string           all;
    for (const char c : text.substr(0, longest))
      all += c >= ' ' && c <= '~' ? c : '?';
    return "'" + all + (text.size() > longest ? "..." : "") + "'";
  }

  /**
   * Tokeniser for .msh files: reads words, numbers in text form and binary
   * numbers, without interpretation. Every number is checked against its range
   * when it is read; nothing is allocated.
   */
  class MshScanner
  {
  public:
    MshScanner(const std::string &text, const std::string &what)
      : text(text)
      , what(what)
    {}

    /** Switches to reading numbers in binary format. If @p is_swapped is true,
     *  the byte order is reversed. */
    void
    set_binary(const bool is_swapped)
    {
      binary  = true;
      swapped = is_swapped;
    }

    bool
    is_binary() const
    {
      return binary;
    }

    [[noreturn]] void
    refuse(const std::string &fault,
           const std::string &remedy = msh_remedy) const
    {
      const std::string place =
        binary ? "byte " + std::to_string(last)
               : "line " +
                   std::to_string(
                     1 + std::count(text.begin(), text.begin() + last, '\n'));
      throw InputError(what + ", " + place + ": " + fault + "\n  allowed: " +
                       msh_versions + "\n  remedy:  " + remedy);
    }

    bool
    at_end()
    {
      skip_space();
      return position == text.size();
    }

    /** Reads the next word of the file. */
    std::string
    word(const char *name)
    {
      skip_space();
      last = position;
      while (position < text.size() && !is_msh_space(text[position]))
        ++position;
      if (position == last)
        refuse(std::string("the file ends where ") + name + " is expected",
               "it is not complete: copy or write it again");
      return text.substr(last, position - last);
    }

    /** Skips to the start of the next line. */
    void
    end_line()
    {
      const std::size_t end = text.find('\n', position);
      position              = end == std::string::npos ? text.size() : end + 1;
    }

    /** Skips the rest of a section, up to the line after $EndNAME. */
    void
    skip_section(const std::string &name)
    {
      const std::string end = "\n$End" + name;
      // The line break before the section belongs to the header.
      std::size_t at = text.find(end, position == 0 ? 0 : position - 1);
      for (; at != std::string::npos; at = text.find(end, at + 1))
        if (at + end.size() == text.size() ||
            is_msh_space(text[at + end.size()]))
          {
            position = at + end.size();
            return;
          }
      last = position;
      refuse("the section " + shown_part("$" + name) + " has no end",
             "it is not complete: copy or write it again");
    }

    void
    end_section(const std::string &name)
    {
      skip_space();
      last                  = position;
      const std::string end = "$End" + name;
      if (text.compare(position, end.size(), end) != 0)
        refuse(position == text.size()
                 ? "the file ends before $End" + name
                 : "there is more in the section " + shown_part("$" + name) +
                     " than it announces, or less: " +
                     shown_part(text.substr(position, 60)) +
                     " instead of $End" + name,
               "copy it again, or " + msh_remedy);
      position += end.size();
    }

    /** Reads an integer in text form, also in binary files. */
    template <typename Integer>
    Integer
    integer_in_text(const char   *name,
                    const Integer smallest,
                    const Integer largest)
    {
      const std::string token = word(name);
      Integer           value{};
      const auto        end =
        std::from_chars(token.data(), token.data() + token.size(), value);
      if (end.ec != std::errc() || end.ptr != token.data() + token.size() ||
          value < smallest || value > largest)
        refuse_number(name, shown_part(token), smallest, largest);
      return value;
    }

    /** Reads an integer of type int or std::uint64_t, the types used in binary
     *  .msh files. */
    template <typename Integer>
    Integer
    integer(const char   *name,
            const Integer smallest = std::numeric_limits<Integer>::min(),
            const Integer largest  = std::numeric_limits<Integer>::max())
    {
      if (!binary)
        return integer_in_text(name, smallest, largest);
      const Integer value = bytes<Integer>(name);
      if (value < smallest || value > largest)
        refuse_number(name, std::to_string(value), smallest, largest);
      return value;
    }

    double
    number(const char *name)
    {
      double      value = 0.;
      std::string token;
      bool        is_number = true;
      if (binary)
        value = bytes<double>(name);
      else
        {
          token = word(name);
          const auto end =
            std::from_chars(token.data(), token.data() + token.size(), value);
          is_number = end.ptr == token.data() + token.size() &&
                      end.ec != std::errc::invalid_argument;
          // Underflow is zero, overflow is infinite.
          if (is_number && end.ec == std::errc::result_out_of_range)
            value = std::strtod(token.c_str(), nullptr);
        }
      if (!is_number || !std::isfinite(value))
        refuse(std::string(name) + " is no finite number: " +
                 (binary ? format("%g", value) : shown_part(token)),
               "write the mesh anew; the file is damaged");
      return value;
    }

    /** Checks that the rest of the file can contain @p n items of at least
     *  @p size bytes each. @throws InputError */
    void
    check_room(const std::uint64_t n,
               const std::uint64_t size,
               const char         *items) const
    {
      if (n > (text.size() - position) / size)
        refuse("it announces " + std::to_string(n) + " " + items +
                 ", more than the rest of the file can hold",
               "it is not complete or damaged: copy or write it again");
    }

    /** Skips the next @p n integers of a .msh file. */
    template <typename Integer>
    void
    skip_integers(const std::uint64_t n, const char *name)
    {
      check_room(n, binary ? sizeof(Integer) : 2, name);
      if (binary)
        position += n * sizeof(Integer);
      else
        for (std::uint64_t i = 0; i < n; ++i)
          integer_in_text(name,
                          std::numeric_limits<Integer>::min(),
                          std::numeric_limits<Integer>::max());
    }

    /** Reads a quoted string from the rest of the line. */
    std::string
    quoted(const char *name)
    {
      last                   = position;
      const std::size_t line = std::min(text.find('\n', position), text.size());
      const std::size_t begin = text.find('"', position);
      const std::size_t end =
        begin < line ? text.find('"', begin + 1) : std::string::npos;
      if (begin >= line || end >= line)
        refuse(std::string(name) + " is not in quotation marks");
      position = end + 1;
      return text.substr(begin + 1, end - begin - 1);
    }

  private:
    void
    skip_space()
    {
      while (position < text.size() && is_msh_space(text[position]))
        ++position;
    }

    template <typename Integer>
    [[noreturn]] void
    refuse_number(const char        *name,
                  const std::string &value,
                  const Integer      smallest,
                  const Integer      largest) const
    {
      refuse(std::string(name) + " is " + value +
               " instead of an integer from " + std::to_string(smallest) +
               " to " + std::to_string(largest),
             "write the mesh anew; the file is damaged");
    }

    template <typename Number>
    Number
    bytes(const char *name)
    {
      last = position;
      if (text.size() - position < sizeof(Number))
        refuse(std::string("the file ends where ") + name + " is expected",
               "it is not complete: copy or write it again");
      char raw[sizeof(Number)];
      std::memcpy(raw, text.data() + position, sizeof(Number));
      if (swapped)
        std::reverse(raw, raw + sizeof(Number));
      Number value;
      std::memcpy(&value, raw, sizeof(Number));
      position += sizeof(Number);
      return value;
    }

    const std::string &text;
    const std::string &what;
    std::size_t        position = 0;
    std::size_t        last     = 0;
    bool               binary   = false;
    bool               swapped  = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
