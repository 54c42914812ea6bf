// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/output/output_base.h>
#include <geocone/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace geocone
{
  OutputBase::OutputBase(const MPI_Comm comm, Log &log)
    : dealii::ParameterAcceptor("/Output")
    , comm(comm)
    , writes(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , log(log)
  {
    add_parameter("Folder",
                  path,
                  "Folder of the run; empty: results/NAME for NAME.prm. The "
                  "option --output goes before it.");
    add_parameter("If folder exists",
                  if_exists,
                  "number (take NAME-2, NAME-3, ...) | refuse | overwrite (the "
                  "files of the run before are removed).");
    add_parameter("Fields",
                  with_fields,
                  "Whether VTU files are written (see Loading/.../Output "
                  "every).");
    add_parameter("Fields format",
                  fields_format,
                  "vtu (for ParaView and the pictures) | hdf5 (with XDMF "
                  "records) | both.");
    add_parameter("Pictures",
                  pictures,
                  "Whether the curve and the fields are drawn at the end, by "
                  "scripts/plot.");
    add_parameter("Verbosity",
                  verbosity,
                  "0: results only, 1: progress, 2: also the table of every "
                  "Newton iteration.");
    add_parameter("Expectations",
                  expectation_texts,
                  "Comma-separated statements about summary.json that must "
                  "hold at the end, else the exit code is 1: TOPIC/NAME <= "
                  "NUMBER or >= NUMBER, e.g. newton/iterations_mean <= 7.");
    add_parameter("Report for tests",
                  report_for_tests,
                  "none | loads | expectations: writes a file 'output' into "
                  "the folder of the call, with the load of each step and the "
                  "expectations, or the latter only.");
  }

  void
  OutputBase::make_folder(const std::string &default_name,
                          const std::string &folder_of_call)
  {
    name = default_name;
    check_choice(
      "Output/If folder exists", if_exists, {"number", "refuse", "overwrite"});
    check_choice(
      "Output/Fields format", fields_format, {"vtu", "hdf5", "both"});
    check_choice("Output/Report for tests",
                 report_for_tests,
                 {"none", "loads", "expectations"});
    for (const std::string &text : expectation_texts)
      expectations.emplace_back(text, "Output/Expectations");
    if (!folder_of_call.empty())
      path = folder_of_call;
    if (path.empty())
      path = "results/" + default_name;
    path = make_run_folder(comm, path, if_exists);
    if (writes)
      log.open(path + "/log.txt");
  }

  void
  add_observation_columns(const Observation        &observation,
                          const BoundaryConditions &conditions,
                          std::vector<std::string> &columns)
  {
    for (const unsigned int c : observation.conditions)
      columns.push_back("moment " + conditions.list[c]->name + " (N m/m)");
    for (unsigned int i = 1; i <= observation.points.size(); ++i)
      for (const char direction : {'x', 'y'})
        columns.push_back(
          format("displacement of point %u %c (m)", i, direction));
  }

  void
  add_observations(const std::vector<double>                 &moments,
                   const std::vector<dealii::Tensor<1, dim>> &displacements,
                   std::vector<double>                       &line)
  {
    line.insert(line.end(), moments.begin(), moments.end());
    for (const auto &displacement : displacements)
      for (unsigned int d = 0; d < dim; ++d)
        line.push_back(displacement[d]);
  }

  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             Json                                      &summary)
  {
    for (unsigned int i = 0; i < displacements.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = displacements[i][d];
          summary["points"][format("displacement_%u_%c_m", i + 1, "xy"[d])] =
            std::isfinite(u) ? Json(u) : Json();
        }
  }

  void
  OutputBase::write_summary_file() const
  {
    write_file(path + "/summary.json",
               [&](std::ostream &out) { out << summary.dump(2) << "\n"; });
  }

  bool
  OutputBase::expectations_hold() const
  {
    bool hold = true;
    if (writes)
      for (const Expectation &expectation : expectations)
        {
          const bool        holds = expectation.holds(summary);
          const std::string answer =
            "expected " + expectation.text + ": " + (holds ? "yes" : "NO");
          const std::string line =
            answer + " (" + expectation.found(summary) + ")";
          hold = hold && holds;
          if (holds)
            log.print(line);
          else
            log.warn(line);
          if (report_for_tests != "none")
            std::ofstream("output", std::ios::app) << answer << "\n";
        }
    return dealii::Utilities::MPI::broadcast(comm, hold);
  }
} // namespace geocone
