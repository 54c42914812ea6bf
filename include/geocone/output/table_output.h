// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_table_output_h
#define geocone_output_table_output_h

#include <geocone/output/output_base.h>
#include <geocone/output/statistics_table.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Run output that stores one record per step and writes each record as a
   *  line of a table. */
  template <typename Record>
  class TableOutput : public OutputBase
  {
  public:
    using OutputBase::OutputBase;

    /** Stores a record and appends its line to the table.
     *  @throws StepFailure if a value that must be finite is not */
    void
    add_record(const Record &record)
    {
      const std::vector<double> line = table.line(record);
      records.push_back(record);
      if (writes)
        statistics.add_line(line);
    }

    /** Records of all steps since the start of the run. */
    const std::vector<Record> &
    all_records() const
    {
      return records;
    }

    void
    state_of_run(StateRow &row) override
    {
      OutputBase::state_of_run(row);
      row(records);
    }

  protected:
    /** Opens the table file in the output folder. All columns must have been added
     *  before. */
    void
    open_table(const std::string &file)
    {
      if (writes)
        statistics.open(path + "/" + file, table.names(), resumes);
    }

    StatisticsTable<Record> table;
    std::vector<Record>     records;
  };
} // namespace geocone::GEOCONE_DIM

#endif
