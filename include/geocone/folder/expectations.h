// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_folder_expectations_h
#define geocone_folder_expectations_h

#include <geocone/folder/json.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Acceptance criterion for a value of summary.json, specified in the parameter
   *  file. Its form is "TOPIC/NAME <= NUMBER", ">= NUMBER" or "= NUMBER +-
   *  NUMBER". */
  class Expectation
  {
  public:
    /**
     * Parses the text of an acceptance criterion.
     * @param parameter name of the parameter, for error messages
     * @throws InputError if the text does not have the required form
     */
    Expectation(const std::string &text, const std::string &parameter);

    /** Returns true if a summary satisfies the criterion. Returns false if the
     *  value is missing. */
    bool
    holds(const Json &summary) const;

    /** Returns the value of summary.json that the criterion refers to, as
     *  text. */
    std::string
    found(const Json &summary) const;

    const std::string text;

  private:
    Json::json_pointer place;
    double             least, most;
  };
} // namespace geocone

#endif
