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
   * Contents of a parameter file, with included files expanded and command-line
   * overrides appended. Included files are found relative to the file with the
   * `include` line.
   *
   * Named objects (materials, boundary conditions, stages) are sections whose
   * names are listed in the parameter file. named_sections() reads these names
   * before any parameter is declared, so that each object can declare its own
   * section; parse() then reads all parameters and rejects unknown ones.
   *
   * A parameter file is data: only regular files of at most 16 MB are read, and
   * nothing in them is executed.
   */
  class ParameterFile
  {
  public:
    /** For each section and parameter name, the object types (e.g. constitutive
     *  laws) that declare the parameter. If the file uses no object of these
     *  types, parse() skips the parameter. */
    using ParametersOfOtherKinds =
      std::map<std::string, std::map<std::string, std::string>>;

    /** A parameter whose value is set in the parameter file. If the parameter
     *  is set repeatedly, the last value applies. */
    struct Setting
    {
      std::string path;  ///< "Section/Subsection/Name"
      std::string value; ///< value as text
      std::string default_value;
      std::string of_other;    ///< kind of object with this parameter
      std::string former_name; ///< outdated name used in the file; empty: none
      bool        is_included; ///< set by an included file
    };

    /** An empty parameter file: all parameters have their default values. */
    ParameterFile() = default;

    /**
     * Reads a parameter file.
     * @param file_name the parameter file
     * @param overrides texts of the form "Section/Subsection/Name = value"
     * @param original the parameter file that this one replaces, relative to
     * which file names are resolved; empty: the file itself
     * @throws InputError if a file is missing or not a text file, a section is
     * not closed, or an override is malformed
     */
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides,
                  const std::string              &original = "");

    /**
     * Creates a parameter file from a string without `include` lines.
     * @param name name of the file in error messages
     */
    static ParameterFile
    from_text(const std::string              &text,
              const std::string              &name,
              const std::vector<std::string> &overrides);

    /** Returns the value of a single parameter, e.g. "Materials/Names",
     *  before parse() is called. */
    std::string
    peek(const std::string &path, const std::string &default_value) const;

    /**
     * Returns the names in the list SECTION/LIST, each of which denotes a
     * subsection of SECTION. A subsection is skipped if an earlier line (of an
     * included file) lists its name and the last line does not.
     * @throws InputError if a name occurs twice, is not admissible as a section
     * name or (if the file contains the list) has no section, or if the name of
     * a subsection is never listed
     */
    std::vector<std::string>
    named_sections(const std::string &section,
                   const std::string &list,
                   const std::string &default_value) const;

    /**
     * Assigns the values of the file to all declared parameters
     * (dealii::ParameterAcceptor).
     * @param of_others parameters of kinds of objects that the file does not
     * use; these parameters are skipped
     * @return all parameters that the file sets, including skipped ones
     * @throws InputError on unknown sections and entries (with the nearest
     * known name) and on inadmissible values
     */
    std::vector<Setting>
    parse(const ParametersOfOtherKinds &of_others = {}) const;

    /** Absolute path of the parameter file. The file name without folder and
     *  extension is returned by name(). */
    const std::string &
    path() const
    {
      return path_of_file;
    }
    std::string
    name() const;

    /** Folder of the parameter file; empty for the working directory. */
    const std::string &
    folder() const
    {
      return folder_of_file;
    }

    /** Returns the current value of a declared parameter. To be called after
     *  parse(). */
    static std::string
    value(const std::string &path);

    /** Returns the names of all declared parameters of a section. */
    static std::vector<std::string>
    declared_in(const std::string &section);

    /** Prints all declared parameters with their current values. */
    static void
    print(std::ostream &out);

  private:
    struct Line
    {
      std::string text;
      std::string file;
      int         number;
      bool        is_included = false; ///< in a file of an `include` line

      /** File name and line number, for error messages. */
      std::string
      place() const;
    };

    /** A line of the form "set NAME = VALUE", with its enclosing sections. */
    struct SetLine
    {
      std::vector<std::string> sections;
      std::string              name, value;
      const Line              *line;
      std::string              former_name; ///< outdated name; empty: none
    };

    void
    read(const std::string &file_name,
         const std::string &shown_name,
         const int          depth);

    /** Appends the lines of an input stream to the parameter file. @param
     *  depth nesting depth of includes; -1: includes are rejected */
    void
    read_lines(std::istream      &in,
               const std::string &file_name,
               const std::string &shown_name,
               const int          depth);

    /** Position of the equals sign that follows the parameter name in a
     *  command-line override. Section names can contain equals signs as
     *  well. */
    std::size_t
    equals_sign(const std::string &override_text) const;

    /** Appends the command-line overrides to the lines of the parameter file
     *  (in memory). */
    void
    append(const std::vector<std::string> &overrides);

    /** Returns all lines of the form "set NAME = VALUE". Lines in
     *  subsections that are no longer listed are skipped. @throws InputError
     *  for invalid lines and unknown sections, if @p checks */
    std::vector<SetLine>
    set_lines(const bool checks) const;

    /** Returns the names of the subsections of a section, each with its first
     *  line in the parameter file. */
    std::map<std::string, const Line *>
    subsections_of(const std::string &section) const;

    std::vector<Line> lines;
    std::string       path_of_file;
    std::string       folder_of_file;
    unsigned int      n_files          = 0;
    bool              has_strict_lists = true;

    /** Names of the listed objects (e.g. materials) in each section. */
    mutable std::map<std::string, std::vector<std::string>> lists;
  };

  /** Splits a list such as "a, b, c" into its non-empty items, without
   *  surrounding blanks. */
  std::vector<std::string>
  split_names(const std::string &list, const char separator = ',');

  /** Returns the known name most similar to a misspelt name. Empty if no
   *  known name is similar. */
  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &known);
} // namespace geocone

#endif
