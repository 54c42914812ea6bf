// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_statistics_table_h
#define geocone_output_statistics_table_h

#include <functional>
#include <string>
#include <vector>

namespace geocone
{
  /** Treatment of non-finite values in a column of statistics.csv. */
  enum class Finite
  {
    must_be,
    may_be ///< e.g. the displacement of a point that has left the mesh
  };

  /** End of the error message for a non-finite value in a column. */
  inline constexpr const char *not_finite_remedy =
    " is not a finite number\n  remedy:  look for absurd magnitudes among "
    "the parameters, the formulas and the files that were read";

  /** Checks that a value of a column is finite. @throws StepFailure if the value is
   *  not finite */
  void
  check_finite(const std::string &column, const double value);

  /** Columns of statistics.csv. Each column has a name that contains the unit, and
   *  a function that evaluates the record of a step. */
  template <typename Record>
  class StatisticsTable
  {
  public:
    using Value = std::function<double(const Record &)>;

    void
    add(const std::string &name,
        const Value       &value,
        const Finite       finite = Finite::must_be)
    {
      columns.push_back({name, value, finite});
    }

    std::vector<std::string>
    names() const
    {
      std::vector<std::string> all;
      for (const Column &column : columns)
        all.push_back(column.name);
      return all;
    }

    /** Evaluates all columns for the record of a step. @throws StepFailure if a
     *  value that must be finite is not finite */
    std::vector<double>
    line(const Record &record) const
    {
      std::vector<double> values;
      for (const Column &column : columns)
        {
          values.push_back(column.value(record));
          if (column.finite == Finite::must_be)
            check_finite(column.name, values.back());
        }
      return values;
    }

  private:
    struct Column
    {
      std::string name;
      Value       value;
      Finite      finite;
    };
    std::vector<Column> columns;
  };
} // namespace geocone

#endif
