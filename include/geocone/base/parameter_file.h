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
   * Text of a parameter file, with its `include` lines expanded (relative to
   * the file that contains them) and the overrides of the command line
   * appended.
   *
   * Lists of named objects (materials, boundary conditions, stages) are
   * sections whose names the file itself lists: named_sections() reads those
   * names before anything is declared, so that each object can declare its own
   * section; parse() then reads all parameters, strictly.
   *
   * A parameter file is data: only regular files of at most 16 MB are read, and
   * nothing in them is executed.
   */
  class ParameterFile
  {
  public:
    /** Parameters of other kinds of objects, with the name of that kind, by the
     *  section of the list, e.g. "Materials". */
    using OfOthers = std::map<std::string, std::map<std::string, std::string>>;

    /** A parameter that the file sets, by its last line. */
    struct Setting
    {
      std::string path;  ///< "Section/Subsection/Name"
      std::string value; ///< as text
      std::string default_value;
      std::string of_other; ///< kind of object that would use it
      std::string
        former_name; ///< name in the file, if it is not the present one
    };

    /** An empty file: all parameters keep their defaults. */
    ParameterFile() = default;

    /**
     * @param file_name the parameter file
     * @param overrides texts of the form "Section/Subsection/Name = value"
     * @param original the file that it replaces, from which file names in it
     * are resolved; empty: itself
     * @throws InputError if a file is missing or not a text file, a section is
     * not closed, or an override is malformed
     */
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides,
                  const std::string              &original = "");

    /**
     * A parameter file from a text, without includes; @p name is used in error
     * messages.
     */
    static ParameterFile
    from_text(const std::string              &text,
              const std::string              &name,
              const std::vector<std::string> &overrides);

    /** The value of one entry, e.g. "Materials/Names", before parse(). */
    std::string
    peek(const std::string &path, const std::string &default_value) const;

    /**
     * Names in the list SECTION/LIST, each of which has a subsection of
     * SECTION. A subsection is skipped if an earlier line (of an included file)
     * listed it and the last line does not.
     * @throws InputError if a name occurs twice, is not admissible as a section
     * name or (where the list is given) has no section, or if a subsection was
     * never listed
     */
    std::vector<std::string>
    named_sections(const std::string &section,
                   const std::string &list,
                   const std::string &default_value) const;

    /**
     * Sets every declared parameter of dealii::ParameterAcceptor.
     * @param of_others known parameters of other kinds of objects than those in
     * the file; they are skipped
     * @return all parameters that are set, including the skipped ones
     * @throws InputError on unknown sections and entries (with the nearest
     * known name) and on inadmissible values
     */
    std::vector<Setting>
    parse(const OfOthers &of_others = {}) const;

    /** Absolute path of the file, and its name without folder and extension. */
    const std::string &
    path() const
    {
      return path_of_file;
    }
    std::string
    name() const;

    /** Folder of the file; empty: the working directory. */
    const std::string &
    folder() const
    {
      return folder_of_file;
    }

    /** Present value of a declared parameter, after parse(). */
    static std::string
    value(const std::string &path);

    /** Names of all declared parameters of a section. */
    static std::vector<std::string>
    declared_in(const std::string &section);

    /** Prints all declared parameters with their present values. */
    static void
    print(std::ostream &out);

  private:
    struct Line
    {
      std::string text;
      std::string file;
      int         number;

      /** File and line, for messages. */
      std::string
      place() const;
    };

    /** A line that sets a parameter. */
    struct SetLine
    {
      std::vector<std::string> sections;
      std::string              name, value;
      const Line              *line;
      std::string              former_name; ///< in the file; empty: name
    };

    void
    read(const std::string &file_name,
         const std::string &shown_name,
         const int          depth);

    /** Appends the lines of a stream. @param depth of includes; -1: includes
     *  are rejected */
    void
    read_lines(std::istream      &in,
               const std::string &file_name,
               const std::string &shown_name,
               const int          depth);

    /** Position of the equals sign after the parameter name of an override;
     *  section names can contain equals signs as well. */
    std::size_t
    equals_sign(const std::string &override_text) const;

    /** Appends overrides of the command line. */
    void
    append(const std::vector<std::string> &overrides);

    /** The lines that set parameters, without those of subsections removed from
     *  their lists. @throws InputError for other lines and unknown sections, if
     *  @p checks */
    std::vector<SetLine>
    set_lines(const bool checks) const;

    /** The subsections of a section, with the first line of each. */
    std::map<std::string, const Line *>
    subsections_of(const std::string &section) const;

    std::vector<Line> lines;
    std::string       path_of_file;
    std::string       folder_of_file;
    unsigned int      n_files          = 0;
    bool              has_strict_lists = true;

    /** Names in the list of each section that has one. */
    mutable std::map<std::string, std::vector<std::string>> lists;
  };

  /** Splits "a, b, c" into its trimmed, non-empty parts. */
  std::vector<std::string>
  split_names(const std::string &list, const char separator = ',');

  /** Known name nearest to a misspelt one, or empty. */
  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &known);
} // namespace geocone

#endif
