// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/scene/record.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace geocone
{
  Record::Record(const std::string &file,
                 const std::string &text,
                 const std::string &parameter)
  {
    std::ifstream in(file);
    std::string   line;
    unsigned int  n      = 0;
    const auto    refuse = [&](const std::string &what) {
      throw InputError(parameter,
                       text,
                       "a .csv file with the columns t and v, or t and a, one "
                          "row of two numbers "
                          "for each time, and times that grow",
                       format("line %u: ", n) + what);
    };
    const auto cells_of_line = [&]() {
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      return dealii::Utilities::split_string_list(line, ',');
    };
    ++n;
    if (!std::getline(in, line))
      refuse("the file is empty or cannot be read");
    const auto names    = cells_of_line();
    const bool is_value = names == std::vector<std::string>{"t", "v"};
    if (!is_value && names != std::vector<std::string>{"t", "a"})
      refuse("'" + line + "' are not the names of the columns");
    std::vector<double> rows;
    while (std::getline(in, line))
      {
        ++n;
        const auto cells = cells_of_line();
        if (cells.size() == 0 || (cells.size() == 1 && cells[0].empty()))
          continue;
        if (cells.size() != 2)
          refuse("'" + line + "' is not two numbers");
        double numbers[2];
        for (unsigned int i = 0; i < 2; ++i)
          {
            try
              {
                numbers[i] = dealii::Utilities::string_to_double(cells[i]);
              }
            catch (const dealii::ExceptionBase &)
              {
                refuse("'" + cells[i] + "' is not a number");
              }
            if (!std::isfinite(numbers[i]))
              refuse("'" + cells[i] + "' is not finite");
          }
        if (!times.empty() && !(numbers[0] > times.back()))
          refuse(
            format("the time %g s is not after the one before", numbers[0]));
        times.push_back(numbers[0]);
        rows.push_back(numbers[1]);
      }
    if (times.size() < 2)
      refuse("there are fewer than two rows");
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
  Record::value(const double t) const
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
