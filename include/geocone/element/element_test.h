// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_test_h
#define geocone_element_element_test_h

#include <geocone/base/parameter_file.h>
#include <geocone/element/driven_point.h>
#include <geocone/element/element_output.h>
#include <geocone/element/element_path.h>
#include <geocone/run/simulation.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Element test: a material point driven along a loading path in stages. One
   *  increment is one step of the run. */
  class ElementTest : public Simulation
  {
  public:
    ElementTest(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return element_output;
    }

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    void
    record_start() override;
    void
    begin(const TimePoint &now) override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &now) override;
    std::string
    progress(const TimePoint &now) const override;
    void
    end(const TimePoint &now) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    const char *
    components_of_point() const;

    /** Appends the current state of the material point to path.csv. */
    void
    add_line(const unsigned int stage);

    void
    write_surfaces();

    DrivenPoint   driven;
    ElementPath   path;
    ElementOutput element_output;

    std::string         changed;   ///< remark of the initialisation
    std::vector<double> positions; ///< fraction f at increment ends
    double              largest_p = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
