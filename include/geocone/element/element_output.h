// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_output_h
#define geocone_element_element_output_h

#include <geocone/element/element_point.h>
#include <geocone/output/output_base.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The folder of an element test: path.csv, surfaces.csv, summary.json. */
  class ElementOutput : public OutputBase
  {
  public:
    ElementOutput(const MPI_Comm comm, Log &log);

    /** Makes the folder. @throws InputError */
    void
    prepare(const RunOptions &options, const std::vector<std::string> &columns);

    /** A line of path.csv: an accepted increment, or the start. */
    void
    add_line(const std::vector<double> &values);

    /** The state at the end of a stage; the start has no name. */
    void
    add_stage(const std::string &name, const std::vector<double> &values);

    /** Lines of surfaces.csv. @param state 0 for the start, 1 for the end */
    void
    add_yield_curves(const unsigned int             state,
                     const std::vector<YieldCurve> &curves);

    /** Writes summary.json. @param topics what is put beside the states */
    void
    write_summary(const std::string &status, const Json &topics);

    void
    state_of_run(StateRow &row) override;

    /** The report for tests, if it is wanted; expectations come after it. */
    void
    report() const;

  private:
    Json
    state(const std::vector<double> &values) const;

    std::vector<std::string> columns;
    CsvFile                  surface_table;
    unsigned int             n_lines = 0;
    Json                     start, last, stages, extremes;
  };
} // namespace geocone::GEOCONE_DIM

#endif
