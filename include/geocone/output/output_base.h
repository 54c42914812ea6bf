// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_output_base_h
#define geocone_output_output_base_h

#include <geocone/base/choice.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/base/run_options.h>
#include <geocone/base/state_row.h>
#include <geocone/folder/expectations.h>
#include <geocone/folder/run_folder.h>
#include <geocone/output/field_files.h>
#include <geocone/output/reference_case.h>

#include <deal.II/base/parameter_acceptor.h>

#include <chrono>
#include <exception>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Field output requested by the user. */
  struct FieldsAsked
  {
    bool         are_written;
    unsigned int n_formats;
  };

  /**
   * Output common to all runs. The output folder contains parameters.prm (as used),
   * log.txt, files.txt (list of written files), a table that grows with each step, and
   * summary.json with the status of the run (run_status.h) and its warnings. The class
   * also checks the acceptance criteria of the parameter file.
   */
  class OutputBase : public dealii::ParameterAcceptor
  {
  public:
    OutputBase(const MPI_Comm comm, Log &log);

    /**
     * Checks the acceptance criteria of the parameter file against the summary and
     * reports the outcome.
     * @return whether all expectations hold
     */
    bool
    expectations_hold() const;

    const std::string &
    folder() const
    {
      return path;
    }

    /**
     * Creates the output folder for an input check without a run. This is the folder
     * named by the user, or results/NAME-model, where files of an earlier check are
     * replaced.
     * @throws InputError as make_folder()
     */
    void
    make_folder_of_model(const RunOptions &options);

    /** Writes the description of the model to a file (model_file.h). @throws
     *  RunError */
    void
    write_model(Json description) const;

    bool
    wants_pictures() const
    {
      return pictures;
    }

    FieldsAsked
    fields_asked() const
    {
      return {with_fields, fields_format == FieldsFormat::both ? 2U : 1U};
    }

    /** Returns true if summary.json of the running simulation is due for an update. */
    bool
    summary_is_old() const;

    /**
     * Records in the summary that an exception terminated the run.
     * @param write_all writes the summary, with the given status, and the last fields;
     * called only if all ranks have stopped together
     * @return whether the ranks are still synchronised; otherwise this rank has failed
     * alone, and others may wait for it
     */
    [[nodiscard]] bool
    end_with(
      const std::exception                           &error,
      const std::function<void(const std::string &)> &write_all) const noexcept;

    unsigned int verbosity = 1;

    /**
     * Writes summary.json with the sections "run" and "warnings" and the
     * sections specific to the method (FEM or MPM).
     * @param status running | finished | failed: why
     * @param topics of the method, in order of output
     * @throws StepFailure if the status is "finished" but a number is not finite; the
     * summary then has the status "failed"
     */
    void
    write_summary(const std::string &status, const Json &topics);

    /** Prints the main results of a finished run from its last summary. */
    virtual void
    print_result() const
    {}

    /** Writes the file 'output', which regression tests compare with a reference, if
     *  requested. Called after the acceptance criteria have been checked. */
    void
    report() const;

    /**
     * Saves the state of the tables and the summary to a checkpoint, or
     * restores it from one.
     */
    virtual void
    state_of_run(StateRow &row);

  protected:
    /**
     * Checks the parameters and creates the output folder.
     * @throws InputError if the folder exists and may not be used, or cannot be
     * written
     */
    void
    make_folder(const RunOptions &options);

    /** Writes the results that regression tests compare with a reference. */
    virtual void
    report_results(std::ostream &out) const = 0;

    const MPI_Comm comm;
    const bool     writes; ///< whether this rank writes tables
    Log           &log;

    std::string path;
    std::string name;
    std::string parameter_file;
    bool        resumes     = false; ///< whether a run is resumed
    bool        with_fields = true;
    CsvFile     statistics;
    Json        summary;

    ReferenceCase reference_case;

    Choice<FieldsFormat> fields_format = {{{"vtu", FieldsFormat::vtu},
                                           {"hdf5", FieldsFormat::hdf5},
                                           {"both", FieldsFormat::both}}};

  private:
    /** Content of the file 'output', which regression tests compare with a
     *  reference. */
    enum class Report
    {
      none,
      results,
      expectations
    };
    Choice<Report> report_for_tests = {
      {{"none", Report::none},
       {"results", Report::results},
       {"loads", Report::results},
       {"states", Report::results},
       {"expectations", Report::expectations}}};

    Choice<IfExists> if_exists = if_exists_choice();

    bool                     pictures = true;
    bool                     stress_pictures = false; ///< read by scripts/plot
    std::vector<std::string> expectation_texts;
    std::vector<Expectation> expectations;

    std::chrono::steady_clock::time_point summary_written;
  };
} // namespace geocone::GEOCONE_DIM

#endif
