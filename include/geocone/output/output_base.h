// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_output_base_h
#define geocone_output_output_base_h

#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/output/expectations.h>
#include <geocone/scene/observation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace geocone
{
  /** @name What both kinds of runs report of Scene::observation: columns of
   *  statistics.csv, their values, and a topic of summary.json */
  /** @{ */
  void
  add_observation_columns(const Observation        &observation,
                          const BoundaryConditions &conditions,
                          std::vector<std::string> &columns);
  void
  add_observations(const std::vector<double>                 &moments,
                   const std::vector<dealii::Tensor<1, dim>> &displacements,
                   std::vector<double>                       &line);
  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             Json                                      &summary);
  /** @} */

  /**
   * What the outputs of all runs have in common: the folder with parameters.prm
   * (as used) and log.txt, statistics.csv, summary.json, and the expectations that
   * the summary must fulfil.
   */
  class OutputBase : public dealii::ParameterAcceptor
  {
  public:
    OutputBase(const MPI_Comm comm, Log &log);

    /**
     * Compares the summary with the expectations of the parameter file.
     * @return whether all hold
     */
    bool
    expectations_hold() const;

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

    unsigned int verbosity = 1;

  protected:
    /**
     * Checks the parameters and makes the folder.
     * @param default_name name of the parameter file without its ending
     * @param folder_of_call folder from the command line; empty: none
     * @throws InputError if it exists and may not be used, or cannot be written
     */
    void
    make_folder(const std::string &default_name,
                const std::string &folder_of_call);

    /** Writes summary.json. */
    void
    write_summary_file() const;

    const MPI_Comm comm;
    const bool     writes; ///< whether this is the rank that writes tables
    Log           &log;

    std::string path;
    std::string name;
    bool        with_fields      = true;
    std::string fields_format    = "vtu";
    std::string report_for_tests = "none";
    CsvFile     statistics;
    Json        summary;

  private:
    std::string              if_exists = "number";
    bool                     pictures  = true;
    std::vector<std::string> expectation_texts;
    std::vector<Expectation> expectations;
  };
} // namespace geocone

#endif
