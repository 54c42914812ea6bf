// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/csv_reader.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/record.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  TimeHistory::TimeHistory(const std::string &file,
                           const std::string &text,
                           const std::string &parameter)
  {
    std::vector<double> rows;
    bool                is_value = false;
    try
      {
        CsvReader                      in(file);
        const std::vector<std::string> names = in.names();
        is_value = names == std::vector<std::string>{"t", "v"};
        if (!is_value && names != std::vector<std::string>{"t", "a"})
          throw RunError(in.place() + ": these are not its columns");
        std::vector<std::string> texts;
        while (in.next_row(texts))
          {
            double numbers[2];
            for (unsigned int i = 0; i < 2; ++i)
              {
                numbers[i] = in.number(texts, i);
                if (!std::isfinite(numbers[i]))
                  throw RunError(in.place(i) + ": '" + texts[i] +
                                 "' is not finite");
              }
            if (!times.empty() && !(numbers[0] > times.back()))
              throw RunError(
                in.place() +
                format(": the time %g s is not after the one before",
                       numbers[0]));
            times.push_back(numbers[0]);
            rows.push_back(numbers[1]);
          }
        if (times.size() < 2)
          throw RunError("there are fewer than two rows");
      }
    catch (const RunError &error)
      {
        throw InputError(parameter,
                         text,
                         "a .csv file with the columns t and v, or t and a, "
                         "one row of two numbers for each time, and times that "
                         "grow",
                         error.what());
      }
    if (is_value)
      {
        values = rows;
        return;
      }
    derivatives = rows;
    values.assign(1, 0.);
    for (std::size_t i = 1; i < times.size(); ++i)
      values.push_back(values.back() + (rows[i - 1] + rows[i]) / 2. *
                                         (times[i] - times[i - 1]));
  }

  double
  TimeHistory::value(const double t) const
  {
    if (t <= times.front())
      return values.front();
    if (t >= times.back())
      return values.back();
    const std::size_t i =
      std::upper_bound(times.begin(), times.end(), t) - times.begin() - 1;
    const double tau = t - times[i], step = times[i + 1] - times[i];
    if (derivatives.empty())
      return values[i] + (values[i + 1] - values[i]) * tau / step;
    return values[i] + derivatives[i] * tau +
           (derivatives[i + 1] - derivatives[i]) * tau * tau / (2. * step);
  }
} // namespace geocone
