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
  /** A declared parameter as --help, --defaults, --schema and the site show it. */
  struct DocumentedParameter
  {
    std::vector<std::string> sections;
    std::string              name, value, pattern, documentation;

    Conditions conditions;

    std::string
    path() const;
  };

  /** Placeholder for the name of a list's member in the path of a parameter. */
  extern const char *const any_name;

  /** All declared parameters with their present values, by sections in the order in
   *  which a model is built. */
  std::vector<DocumentedParameter>
  documented_parameters();

  /** The sections of the first level in this order, each with a one-line
   *  description. */
  std::string
  list_of_sections();

  /**
   * Parameters selected by a topic: all of a section or subsection, or those with a
   * name, e.g. "Materials", "Cohesion", "materials/cohesion"; "all".
   * @throws InputError if there are none
   */
  std::vector<DocumentedParameter>
  on_topic(const std::vector<DocumentedParameter> &all,
           const std::string                      &topic);

  /** Prints parameters as lines of a parameter file, with their documentation
   *  and a one-line description of each section. */
  void
  print(std::ostream &out, const std::vector<DocumentedParameter> &parameters);

  /** JSON Schema (draft 2020-12) of the tree of parameters. */
  std::string
  json_schema(const std::vector<DocumentedParameter> &parameters);
} // namespace geocone

#endif
