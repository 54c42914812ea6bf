// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_reference_case_h
#define geocone_output_reference_case_h

#include <geocone/folder/expectations.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /**
   * Reference value from theory, experiment or another code for a quantity of
   * summary.json. Written as the topic "reference" of the summary, {quantity,
   * value, expected, relative_error}, which has the same form for all runs.
   */
  class ReferenceCase : public dealii::ParameterAcceptor
  {
  public:
    ReferenceCase();

    /** Checks the parameters. @throws InputError */
    void
    prepare();

    /** Sets the default reference quantity and its value. They apply if the
     *  parameter file names no quantity. */
    void
    set_default(const std::string &name, const double value);

    /** Returns true if a reference value is given. */
    bool
    is_given() const
    {
      return !quantity.empty();
    }

    /** Returns true if the parameter file names the reference quantity. */
    bool
    is_asked() const
    {
      return asked;
    }

    /** Section "reference" of summary.json. The entries value and
     *  relative_error (value/expected - 1) are null if the summary does not
     *  contain the quantity. */
    Json
    topic(const Json &summary) const;

    /** Line of text that compares the result with the reference value. */
    std::string
    text(const Json &summary) const;

  private:
    std::string quantity;
    double      expected = 0.;
    bool        asked    = false;
  };
} // namespace geocone

#endif
