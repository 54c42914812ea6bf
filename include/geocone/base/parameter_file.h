// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_parameter_file_h
#define geocone_base_parameter_file_h

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * The text of a parameter file, with its `include` lines expanded (relative
   * to the file that has them) and the overrides of the command line appended.
   *
   * Lists of named objects (materials, boundary conditions, stages) are sections
   * whose names stand in the file: `peek_list()` reads those names before
   * anything is declared, so that each object can declare its own section;
   * parse() then reads everything, strictly.
   */
  class ParameterFile
  {
  public:
    /** An empty file: all parameters keep their defaults. */
    ParameterFile() = default;

    /**
     * @param file_name the parameter file
     * @param overrides texts of the form "Section/Subsection/Name = value"
     * @throws InputError if a file is missing or an override is malformed
     */
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides);

    /** The same from a text; @p name is what errors call it. */
    static ParameterFile
    from_text(const std::string              &text,
              const std::string              &name,
              const std::vector<std::string> &overrides);

    /** The value of one entry, e.g. "Materials/Names", before parse(). */
    std::string
    peek(const std::string &path, const std::string &default_value) const;

    /** The comma-separated names in one entry, before parse(). */
    std::vector<std::string>
    peek_list(const std::string &path, const std::string &default_value) const;

    /**
     * The names in the list SECTION/LIST, and after them those of all other
     * subsections of SECTION in the file: what is not in the list is not used,
     * but its parameters are known and checked. @p n_listed is the number of
     * the former.
     */
    std::vector<std::string>
    named_sections(const std::string &section,
                   const std::string &list,
                   const std::string &default_value,
                   std::size_t       &n_listed) const;

    /**
     * Gives every declared parameter of dealii::ParameterAcceptor its value.
     * @throws InputError on unknown sections and entries (with the nearest
     * known name) and on values that do not fit
     */
    void
    parse() const;

    /** The folder that the file lies in; empty: that of the call. */
    const std::string &
    folder() const
    {
      return folder_of_file;
    }

    /** The text of one section, with the present values. */
    static std::string
    section(const std::string &name);

    /** Prints all declared parameters with their present values. */
    static void
    print(std::ostream &out, const bool with_documentation);

  private:
    struct Line
    {
      std::string text;
      std::string file;
      int         number;
    };

    void
    read(const std::string &file_name,
         const std::string &shown_name,
         const int          depth);

    /** Adds overrides of the command line. */
    void
    append(const std::vector<std::string> &overrides);

    void
    check_names() const;

    std::string
    text() const;

    std::vector<Line> lines;
    std::string       folder_of_file;
  };

  /**
   * Splits "a, b, c" into its trimmed parts, without the empty ones.
   */
  std::vector<std::string>
  split_names(const std::string &list, const char separator = ',');
} // namespace geocone

#endif
