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
  /** A declared parameter as documented by --help, --defaults and --schema. */
  struct DocumentedParameter
  {
    std::vector<std::string> sections;
    std::string              name, value, pattern, documentation;

    Conditions conditions;

    std::string
    path() const;
  };

  /** Placeholder for the name of a listed object in the path of a parameter. */
  extern const char *const any_name;

  /** All declared parameters with their present values. Sections are in the order in
   *  which a model is defined. */
  std::vector<DocumentedParameter>
  documented_parameters();

  /** Text that lists the top-level sections in the order of documented_parameters(),
   *  each with a one-line description. */
  std::string
  list_of_sections();

  /**
   * Parameters selected by the topic of --help, e.g. "Materials", "Cohesion",
   * "materials/cohesion" or "all": a section, a subsection or a parameter name.
   * @throws InputError if no parameter matches
   */
  std::vector<DocumentedParameter>
  on_topic(const std::vector<DocumentedParameter> &all,
           const std::string                      &topic);

  /** Prints parameters as lines of a parameter file, with their documentation
   *  and a one-line description of each section. */
  void
  print(std::ostream &out, const std::vector<DocumentedParameter> &parameters);

  /** JSON Schema (draft 2020-12) of the tree of parameters in sections. */
  std::string
  json_schema(const std::vector<DocumentedParameter> &parameters);
} // namespace geocone

#endif
