// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_output_h
#define geocone_element_element_output_h

#include <geocone/element/element_record.h>
#include <geocone/output/output_base.h>

#include <string>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Output files of an element test: path.csv, surfaces.csv, summary.json.
   *  Records are not stored, because a test can have millions of increments. */
  class ElementOutput : public OutputBase
  {
  public:
    using OutputBase::OutputBase;

    /** Defines the columns of path.csv. @param volume initial specific volume
     *  (-) */
    void
    add_columns(const ElementPoint &point, const double volume);

    /** Creates the output folder of the element test. @throws InputError */
    void
    prepare(const RunOptions &options);

    /** Appends a row to path.csv. */
    void
    add_line(const ElementRecord &record);

    const std::vector<std::string> &
    columns() const
    {
      return names;
    }

    /** Last row of path.csv. */
    const std::vector<double> &
    last_line() const
    {
      return last;
    }

    /** Value of a column in the last row of path.csv. */
    double
    value_of(const std::string &column) const;

    /** Stores the last row of path.csv as the final state of a stage. */
    void
    end_stage(const std::string &name)
    {
      stages.emplace_back(name, last);
    }

    /** Appends plane sections of the yield surfaces to surfaces.csv. @param
     *  state 0: initial, 1: final */
    void
    add_yield_curves(const unsigned int             state,
                     const std::vector<YieldCurve> &curves);

    /** Adds the initial state, the state at the end of each stage and the
     *  final state to summary.json. */
    void
    add_states(Json &summary) const;

    void
    state_of_run(StateRow &row) override;

  private:
    void
    report_results(std::ostream &out) const override;

    StatisticsTable<ElementRecord> table;
    std::vector<std::string>       names; ///< column names
    CsvFile                        surface_table;

    /** @name Lines of path.csv stored for the summary: first, last, last of
     *  each stage; and the extreme values of each column */
    /** @{ */
    std::vector<double>                                      start, last;
    std::vector<std::pair<std::string, std::vector<double>>> stages;
    std::vector<double>                                      least, most;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
