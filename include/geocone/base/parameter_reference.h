// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_parameter_reference_h
#define geocone_base_parameter_reference_h

#include <geocone/base/unused_parameters.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace geocone
{
  /** Documentation of a declared parameter for --help, --defaults and --schema. */
  struct DocumentedParameter
  {
    std::vector<std::string> sections;
    std::string              name, value, pattern, documentation;

    Conditions conditions;

    std::string
    path() const;
  };

  /** Placeholder in a parameter path for the name of an object, e.g. a
   *  material. */
  extern const char *const any_name;

  /** Returns all declared parameters with their current values. Sections are in
   *  the order in which a model is defined. */
  std::vector<DocumentedParameter>
  documented_parameters();

  /** Returns a list of the top-level parameter sections, each with a one-line
   *  description. The order is the same as in documented_parameters(). */
  std::string
  list_of_sections();

  /**
   * Selects the parameters that match the search term of the option --help. The
   * term is a section, a subsection or a parameter name, e.g. "Materials",
   * "Cohesion" or "materials/cohesion", or "all".
   * @throws InputError if no parameter matches
   */
  std::vector<DocumentedParameter>
  on_topic(const std::vector<DocumentedParameter> &all,
           const std::string                      &topic);

  /** Prints parameters and their documentation in the syntax of a parameter file.
   *  Each section is preceded by a one-line description. */
  void
  print(std::ostream &out, const std::vector<DocumentedParameter> &parameters);

  /** Returns the JSON Schema (draft 2020-12) of a parameter file. */
  std::string
  json_schema(const std::vector<DocumentedParameter> &parameters);
} // namespace geocone

#endif
