// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_expectations_h
#define geocone_output_expectations_h

#include <geocone/output/json.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Condition on a number of summary.json, "TOPIC/NAME <= NUMBER", ">= NUMBER" or "=
   *  NUMBER +- NUMBER": acceptance criterion of a parameter file. */
  class Expectation
  {
  public:
    /**
     * @param parameter for messages
     * @throws InputError if the text is not of that form
     */
    Expectation(const std::string &text, const std::string &parameter);

    /** Whether the condition holds; false if the summary has no such number. */
    bool
    holds(const Json &summary) const;

    /** The number of the summary, as text. */
    std::string
    found(const Json &summary) const;

    const std::string text;

  private:
    Json::json_pointer place;
    double             least, most;
  };
} // namespace geocone

#endif
