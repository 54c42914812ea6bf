// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_parameter_file_h
#define geocone_base_parameter_file_h

#include <deal.II/base/parameter_acceptor.h>

#include <iosfwd>
#include <map>
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
   * whose names stand in the file: named_sections() reads those names before
   * anything is declared, so that each object can declare its own section;
   * parse() then reads everything, strictly.
   *
   * A parameter file is data: only regular files of at most 16 MB are read, and
   * nothing in them is executed.
   */
  class ParameterFile
  {
  public:
    /** Names of parameters that another kind of object would have, with what has
     *  them, by the section of the list, e.g. "Materials". */
    using OfOthers = std::map<std::string, std::map<std::string, std::string>>;

    /** A parameter that is set, by its last line. */
    struct Setting
    {
      std::string path;  ///< "Section/Subsection/Name"
      std::string value; ///< as text
      std::string default_value;
      std::string of_other; ///< what would have used it, if nothing here does
    };

    /** An empty file: all parameters keep their defaults. */
    ParameterFile() = default;

    /**
     * @param file_name the parameter file
     * @param overrides texts of the form "Section/Subsection/Name = value"
     * @param original the file that it stands for: names of files in it count
     * from there; empty: itself
     * @throws InputError if a file is missing or no text, a section does not end,
     * or an override is malformed
     */
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides,
                  const std::string              &original = "");

    /**
     * The same from a text, which includes nothing; @p name is what errors call
     * it.
     */
    static ParameterFile
    from_text(const std::string              &text,
              const std::string              &name,
              const std::vector<std::string> &overrides);

    /** The value of one entry, e.g. "Materials/Names", before parse(). */
    std::string
    peek(const std::string &path, const std::string &default_value) const;

    /**
     * The names in the list SECTION/LIST, each of which has a subsection of
     * SECTION. A subsection that has been in the list by an earlier line (of an
     * included file) and is not any more has been taken out: it is not read.
     * @throws InputError if a name stands there twice, cannot be the name of a
     * section or has none (where the list is given), or a subsection has never
     * been in the list
     */
    std::vector<std::string>
    named_sections(const std::string &section,
                   const std::string &list,
                   const std::string &default_value) const;

    /**
     * Gives every declared parameter of dealii::ParameterAcceptor its value.
     * @param of_others parameters that are known, but to other kinds of objects
     * than the file asks for: they are left out
     * @return all parameters that are set, with those left out
     * @throws InputError on unknown sections and entries (with the nearest
     * known name) and on values that do not fit
     */
    std::vector<Setting>
    parse(const OfOthers &of_others = {}) const;

    /** The absolute name of the file, and its name without folder and ending. */
    const std::string &
    path() const
    {
      return path_of_file;
    }
    std::string
    name() const;

    /** The folder that the file lies in; empty: that of the call. */
    const std::string &
    folder() const
    {
      return folder_of_file;
    }

    /** The present value of a declared parameter, after parse(). */
    static std::string
    value(const std::string &path);

    /** Names of all declared parameters of a section. */
    static std::vector<std::string>
    declared_in(const std::string &section);

    /** Prints all declared parameters with their present values. */
    static void
    print(std::ostream &out, const bool with_documentation);

  private:
    struct Line
    {
      std::string text;
      std::string file;
      int         number;

      /** Where it stands, for messages. */
      std::string
      place() const;
    };

    /** A line that sets a parameter. */
    struct SetLine
    {
      std::vector<std::string> sections;
      std::string              name, value;
      const Line              *line;
    };

    void
    read(const std::string &file_name,
         const std::string &shown_name,
         const int          depth);

    /** Appends the lines of a stream. @param depth of includes; -1: they are
     *  refused */
    void
    read_lines(std::istream      &in,
               const std::string &file_name,
               const std::string &shown_name,
               const int          depth);

    /** The place of the sign behind the name of an override's parameter: names of sections
     *  may have equals signs, too. */
    std::size_t
    equals_sign(const std::string &override_text) const;

    /** Adds overrides of the command line. */
    void
    append(const std::vector<std::string> &overrides);

    /** The lines that set parameters, without those of subsections that have been
     *  taken out of their lists. @throws InputError for other lines and unknown
     *  sections, if @p checks */
    std::vector<SetLine>
    set_lines(const bool checks) const;

    /** The subsections of a section, and the first lines of each. */
    std::map<std::string, const Line *>
    subsections_of(const std::string &section) const;

    std::vector<Line> lines;
    std::string       path_of_file;
    std::string       folder_of_file;
    unsigned int      n_files          = 0;
    bool              has_strict_lists = true;

    /** Of each section with a list, the names in it. */
    mutable std::map<std::string, std::vector<std::string>> lists;
  };

  /**
   * Splits "a, b, c" into its trimmed parts, without the empty ones.
   */
  std::vector<std::string>
  split_names(const std::string &list, const char separator = ',');
} // namespace geocone

#endif
