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
   * Reference value of a run: a number of summary.json and its value by theory,
   * experiment or another code. It becomes the topic "reference" of the summary,
   * {quantity, value, expected, relative_error}, which is the same for runs of any
   * kind.
   */
  class ReferenceCase : public dealii::ParameterAcceptor
  {
  public:
    ReferenceCase();

    /** Checks the parameters. @throws InputError */
    void
    prepare();

    /** Sets the quantity and value used if the file names none. */
    void
    set_default(const std::string &name, const double value);

    /** Whether a reference value is given. */
    bool
    is_given() const
    {
      return !quantity.empty();
    }

    /** Whether the file names it. */
    bool
    is_asked() const
    {
      return asked;
    }

    /** The topic; value and relative_error (value/expected - 1) are null if the summary
     *  has no such number. */
    Json
    topic(const Json &summary) const;

    /** The comparison as one line. */
    std::string
    text(const Json &summary) const;

  private:
    std::string quantity;
    double      expected = 0.;
    bool        asked    = false;
  };
} // namespace geocone

#endif
