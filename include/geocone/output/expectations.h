// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_expectations_h
#define geocone_output_expectations_h

#include <geocone/output/json.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Acceptance criterion of a parameter file: a condition on a value of
   *  summary.json, of the form "TOPIC/NAME <= NUMBER", ">= NUMBER" or "= NUMBER +-
   *  NUMBER". */
  class Expectation
  {
  public:
    /**
     * @param parameter for messages
     * @throws InputError if the text is not of that form
     */
    Expectation(const std::string &text, const std::string &parameter);

    /** Whether a summary satisfies the criterion; false if the value is missing. */
    bool
    holds(const Json &summary) const;

    /** Value found in a summary, as text. */
    std::string
    found(const Json &summary) const;

    const std::string text;

  private:
    Json::json_pointer place;
    double             least, most;
  };
} // namespace geocone

#endif
