// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_output_h
#define geocone_element_element_output_h

#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/element/element_point.h>
#include <geocone/output/expectations.h>

#include <deal.II/base/parameter_acceptor.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace geocone
{
  /** The folder of an element test: path.csv, surfaces.csv, summary.json. */
  class ElementOutput : public dealii::ParameterAcceptor
  {
  public:
    ElementOutput(const MPI_Comm comm, Log &log);

    /** Checks the parameters and makes the folder. */
    void
    prepare(const std::string              &name,
            const std::string              &folder,
            const std::vector<std::string> &columns);

    /** A line of path.csv: an accepted increment, or the start. */
    void
    add_line(const std::vector<double> &values);

    /** The state at the end of a stage; the start has no name. */
    void
    add_stage(const std::string &name, const std::vector<double> &values);

    /** Lines of surfaces.csv. @param state 0 for the start, 1 for the end */
    void
    add_surfaces(const unsigned int          state,
                 const std::vector<Surface> &surfaces);

    /** Writes summary.json. @param topics what is put beside the states */
    void
    write_summary(const std::string &status, const Json &topics);

    /** Whether all expectations hold; says so, and writes the test report. */
    bool
    finish();

    const std::string &
    folder() const
    {
      return path;
    }

    bool
    wants_pictures() const
    {
      return pictures;
    }

    /** 0: results only, 1: the end of each stage, 2: each increment. */
    unsigned int verbosity = 1;

  private:
    Json
    state(const std::vector<double> &values) const;

    const MPI_Comm           comm;
    Log                     &log;
    std::string              path;
    std::string              if_exists        = "number";
    bool                     pictures         = true;
    std::string              report_for_tests = "none";
    std::vector<std::string> expectation_texts;
    std::vector<Expectation> expectations;

    std::string              name;
    std::vector<std::string> columns;
    CsvFile                  table, surface_table;
    unsigned int             n_lines = 0;
    Json                     start, last, stages, extremes, summary;
  };
} // namespace geocone

#endif
