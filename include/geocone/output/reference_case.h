// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_reference_case_h
#define geocone_output_reference_case_h

#include <geocone/output/expectations.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /**
   * Reference value of a run: a quantity of summary.json and its value from theory,
   * experiment or another code. Written as the topic "reference" of the summary,
   * {quantity, value, expected, relative_error}, which has the same form for all
   * runs.
   */
  class ReferenceCase : public dealii::ParameterAcceptor
  {
  public:
    ReferenceCase();

    /** Checks the parameters. @throws InputError */
    void
    prepare();

    /** Sets the default quantity and value, used if the parameter file names no
     *  quantity. */
    void
    set_default(const std::string &name, const double value);

    /** Whether a reference value is given. */
    bool
    is_given() const
    {
      return !quantity.empty();
    }

    /** Whether the parameter file names the reference quantity. */
    bool
    is_asked() const
    {
      return asked;
    }

    /** Topic "reference"; value and relative_error (value/expected - 1) are null if
     *  the summary does not contain the quantity. */
    Json
    topic(const Json &summary) const;

    /** Comparison with the reference value as a line of text. */
    std::string
    text(const Json &summary) const;

  private:
    std::string quantity;
    double      expected = 0.;
    bool        asked    = false;
  };
} // namespace geocone

#endif
