// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_record_h
#define geocone_functions_record_h

#include <string>
#include <vector>

namespace geocone
{
  /**
   * A function of time from a .csv file: a first line with the names of two columns,
   * t (s) and either v, the value, which is linear between the rows, or a, its
   * derivative, which is linear between them: then the value is the integral of a from
   * zero (an accelerogram as a velocity). Before the first row it is the value there,
   * after the last one the value there.
   */
  class Record
  {
  public:
    /**
     * @param text,parameter what the parameter file says, and its name, for messages
     * @throws InputError naming the line that cannot be understood
     */
    Record(const std::string &file,
           const std::string &text,
           const std::string &parameter);

    double
    value(const double t) const;

    /** The time of the last row (s). */
    double
    end() const
    {
      return times.back();
    }

  private:
    std::vector<double> times, values;
    std::vector<double> derivatives; ///< or empty
  };
} // namespace geocone

#endif
