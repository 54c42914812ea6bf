// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_record_h
#define geocone_functions_record_h

#include <string>
#include <vector>

namespace geocone
{
  /**
   * Time history of a scalar quantity, read from a comma-separated file with
   * two columns. The first line contains the column names: t (s), and v for
   * values or a for time derivatives. Both v and a are piecewise linear in
   * time. For a, the value is the integral of a from zero (e.g. the velocity
   * from an accelerogram). The value is constant before the first and after the
   * last row.
   */
  class TimeHistory
  {
  public:
    /**
     * Reads the time history from a file.
     * @param text,parameter value and name of the parameter, for messages
     * @throws InputError naming the faulty line
     */
    TimeHistory(const std::string &file,
                const std::string &text,
                const std::string &parameter);

    double
    value(const double t) const;

    /** Time of the first row of the file (s). */
    double
    begin() const
    {
      return times.front();
    }

    /** Time of the last row of the file (s). */
    double
    end() const
    {
      return times.back();
    }

  private:
    std::vector<double> times, values;
    std::vector<double> derivatives; ///< a; empty if v is given
  };
} // namespace geocone

#endif
