// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/units.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/folder/run_status.h>
#include <geocone/folder/watcher.h>
#include <geocone/output/model_file.h>
#include <geocone/output/output_base.h>
#include <geocone/output/statistics_table.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <new>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_output_base[] = {
      {"Output/Fields format", "Output/Fields", {"true"}}};
  } // namespace

  namespace
  {
    /** Path of the first number of a summary that is not finite, or nothing. */
    std::string
    first_not_finite(const Json &json, const std::string &place)
    {
      if (json.is_number_float() && !std::isfinite(json.get<double>()))
        return place;
      if (json.is_structured())
        for (const auto &[key, value] : json.items())
          if (const std::string found = first_not_finite(
                value, place + (place.empty() ? "" : "/") + key);
              !found.empty())
            return found;
      return "";
    }
  } // namespace

  OutputBase::OutputBase(const MPI_Comm comm, Log &log)
    : dealii::ParameterAcceptor("/Output")
    , comm(comm)
    , writes(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , log(log)
  {
    declare_units();
    add_parameter("Folder",
                  path,
                  "Result folder; empty: results/NAME for NAME.prm. The option "
                  "--output takes precedence.");
    if_exists.declare(
      *this,
      "If folder exists",
      ". How to treat a result folder that is not empty. Number: use NAME-2, "
      "NAME-3, ... Overwrite: delete the files listed in its files.txt. "
      "Automatic: refuse if the folder was named, number results/NAME.");
    add_parameter(
      "Fields",
      with_fields,
      "Whether fields are written (see 'Loading/NAME/Output every').");
    fields_format.declare(*this,
                          "Fields format",
                          ". VTU: compressed, single precision, a file per "
                          "rank, with a PVD index. HDF5: double precision, "
                          "with VTKHDF (ParaView >= 5.12) and XDMF indices.");
    add_parameter(
      "Pictures", pictures, "Whether scripts/plot draws pictures at the end.");
    add_parameter(
      "Principal stresses",
      stress_pictures,
      "Whether the pictures include principal_stresses.png: crosses "
      "of the principal stresses in the plane over the mesh at the "
      "end; those of the lower bound with strict bounds.");
    add_parameter("Verbosity",
                  verbosity,
                  "0: results only; 1: progress; 2: also each Newton "
                  "iteration, or each increment of a material point.",
                  prm,
                  dealii::Patterns::Integer(0, 2));
    add_parameter(
      "Expectations",
      expectation_texts,
      "Comma-separated conditions on summary.json; if one is violated at the "
      "end, the exit code is 1. TOPIC/NAME <= NUMBER, >= NUMBER or = NUMBER +- "
      "NUMBER, e.g. newton/iterations_mean <= 7.");
    report_for_tests.declare(
      *this,
      "Report for tests",
      ". Writes a file 'output' with results and expectations, or with "
      "expectations only, into the working folder. Loads and states are "
      "aliases of results.");
  }

  void
  OutputBase::make_folder(const RunOptions &options)
  {
    name           = options.name;
    resumes        = options.resumes;
    parameter_file = options.parameter_file;
    for (const std::string &text : expectation_texts)
      expectations.emplace_back(text, "Output/Expectations");
    reference_case.prepare();
    if (!options.folder.empty())
      path = options.folder;
    const bool was_named = !path.empty();
    if (!was_named)
      path = "results/" + name;
    if (resumes)
      enter_run_folder(comm, path);
    else
      path = make_run_folder(comm, path, was_named, if_exists);
    if (writes)
      {
        Watcher::watch(path);
        if (!resumes) // else a checkpoint is needed first
          log.open(path + "/log.txt");
      }
  }

  void
  OutputBase::make_folder_of_model(const RunOptions &options)
  {
    name                 = options.name;
    const bool was_named = !options.folder.empty();
    path = was_named ? options.folder : "results/" + name + "-model";
    path = make_run_folder(
      comm, path, was_named, was_named ? if_exists.get() : IfExists::overwrite);
  }

  void
  OutputBase::write_model(Json description) const
  {
    description["name"] = name;
    if (writes)
      write_file(path + "/" + model_file,
                 [&](std::ostream &out) { out << description.dump() << "\n"; });
  }

  void
  OutputBase::state_of_run(StateRow &row)
  {
    row(statistics);
    std::vector<std::string> warnings = log.warnings();
    row(warnings);
    if (row.is_read())
      log.add_earlier_warnings(warnings);
  }

  bool
  OutputBase::summary_is_old() const
  {
    using namespace std::chrono;
    const bool old = steady_clock::now() - summary_written > seconds(10);
    return dealii::Utilities::MPI::broadcast(comm, old);
  }

  bool
  OutputBase::end_with(
    const std::exception                           &error,
    const std::function<void(const std::string &)> &write_all) const noexcept
  {
    std::string status;
    bool        together = true;
    try
      {
        const bool is_stopped =
          dynamic_cast<const Stopped *>(&error) != nullptr;
        const bool is_step =
          dynamic_cast<const StepFailure *>(&error) != nullptr;
        status = is_stopped
                   ? error.what() + std::string("; its files are whole")
                   : "failed: " + text_of(error);
        if (is_stopped || is_step)
          write_all(status);
      }
    catch (const StepFailure &)
      {}
    catch (...)
      {
        together = dealii::Utilities::MPI::n_mpi_processes(comm) == 1;
      }
    end_status(path, status); // unless already done
    return together;
  }

  namespace
  {
    /** A summary with present units in place of those of SI. */
    Json
    summary_in_units(const Json &of_si)
    {
      if (!of_si.is_structured())
        return of_si;
      Json out = of_si.is_array() ? Json::array() : Json::object();
      for (const auto &[key, value] : of_si.items())
        if (of_si.is_array())
          out.push_back(summary_in_units(value));
        else if (key == "unit" && value.is_string())
          out[key] = present_unit(value.get<std::string>());
        else
          out[key_in_units(key)] = summary_in_units(value);
      return out;
    }
  } // namespace

  void
  OutputBase::write_summary(const std::string &status, const Json &topics)
  {
    if (!writes)
      return;
    summary_written = std::chrono::steady_clock::now();
    summary         = {{"name", name}, {"status", status}};
    summary.update(mass_unit() == 1. ? topics : summary_in_units(topics));
    summary["run"]                   = run_topic();
    summary["run"]["parameter_file"] = parameter_file;
    summary["warnings"]              = log.warnings();
    if (reference_case.is_given())
      summary["reference"] = reference_case.topic(summary);
    std::string what;
    if (summary["status"] == "finished")
      {
        what = first_not_finite(summary, "");
        if (!what.empty())
          summary["status"] =
            "failed: '" + what + "' of the summary" + not_finite_remedy;
      }
    check_folder();
    write_file(path + "/summary.json", [&](std::ostream &out) {
      out << summary.dump(2, ' ', false, Json::error_handler_t::replace)
          << "\n";
    });
    if (!what.empty())
      throw RunError("'" + what + "' of the summary" + not_finite_remedy);
  }

  void
  OutputBase::report() const
  {
    if (writes && report_for_tests != Report::none)
      write_file("output", [&](std::ostream &out) {
        if (report_for_tests == Report::results)
          report_results(out);
      });
  }

  bool
  OutputBase::expectations_hold() const
  {
    bool hold = true;
    if (writes && reference_case.is_asked())
      {
        const std::string text = reference_case.text(summary);
        if (summary["reference"]["value"].is_null())
          log.warn(text);
        else
          log.print(text);
      }
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
          if (report_for_tests != Report::none)
            std::ofstream("output", std::ios::app) << answer << "\n";
        }
    return dealii::Utilities::MPI::broadcast(comm, hold);
  }
} // namespace geocone::GEOCONE_DIM
