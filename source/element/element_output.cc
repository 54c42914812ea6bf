// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/element/element_output.h>
#include <geocone/output/statistics_table.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** "stress xx (Pa)" is "stress_xx_Pa" in the summary, "R (-)" is "R". */
    std::string
    key(const std::string &column)
    {
      std::string text;
      for (const char c : column)
        if (c == ' ')
          text += '_';
        else if (c != '(' && c != ')' && c != '-')
          text += c;
      while (!text.empty() && text.back() == '_')
        text.pop_back();
      return text;
    }
  } // namespace

  ElementOutput::ElementOutput(const MPI_Comm comm, Log &log)
    : OutputBase(comm, log)
  {}

  void
  ElementOutput::prepare(const RunOptions               &options,
                         const std::vector<std::string> &all_columns)
  {
    columns = all_columns;
    make_folder(options);
    statistics.open(path + "/path.csv", columns, resumes);
    surface_table.open(path + "/surfaces.csv",
                       {"state", "surface", "p (Pa)", "q (Pa)"});
  }

  Json
  ElementOutput::state(const std::vector<double> &values) const
  {
    Json all;
    for (std::size_t i = 0; i < columns.size(); ++i)
      all[key(columns[i])] = values[i];
    return all;
  }

  void
  ElementOutput::add_line(const std::vector<double> &values)
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
      check_finite(columns[i], values[i]);
    statistics.add_line(values);
    last = state(values);
    if (n_lines++ == 0)
      start = last;
    for (const auto &[entry, value] : last.items())
      for (const bool largest : {false, true})
        {
          Json &extreme  = extremes[entry + (largest ? "_most" : "_least")];
          const double x = value.get<double>();
          if (extreme.is_null() ||
              (largest ? x > extreme.get<double>() : x < extreme.get<double>()))
            extreme = x;
        }
  }

  void
  ElementOutput::state_of_run(StateRow &row)
  {
    OutputBase::state_of_run(row);
    row(n_lines);
    for (Json *topic : {&start, &last, &stages, &extremes})
      {
        std::string text = topic->dump();
        row(text);
        *topic = Json::parse(text);
      }
  }

  void
  ElementOutput::add_stage(const std::string         &stage,
                           const std::vector<double> &values)
  {
    stages[stage] = state(values);
  }

  void
  ElementOutput::add_yield_curves(const unsigned int             at,
                                  const std::vector<YieldCurve> &curves)
  {
    // The surfaces by number: 0 yield, 1 subloading.
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (const auto &[p, q] : curves[i])
        surface_table.add_line(
          {static_cast<double>(at), static_cast<double>(i), p, q});
  }

  void
  ElementOutput::write_summary(const std::string &status, const Json &topics)
  {
    summary = {{"name", name},
               {"status", status},
               {"size", {{"method", "point"}, {"points", 1}}}};
    for (const auto &[entry, value] : topics.items())
      summary[entry] = value;
    summary["start"]    = start;
    summary["stages"]   = stages;
    summary["final"]    = last;
    summary["extremes"] = extremes;
    write_summary_file();
  }

  void
  ElementOutput::report() const
  {
    if (report_for_tests == Report::none)
      return;
    if (report_for_tests == Report::expectations)
      return write_file("output", [](std::ostream &) {});
    std::string report;
    for (const auto &[stage, values] : stages.items())
      {
        report += "after " + stage + "\n";
        for (const auto &[entry, value] : values.items())
          {
            // In units that make numbers of order one; substeps depend on last
            // digits.
            if (entry.find("substeps") != std::string::npos)
              continue;
            const bool is_stress =
              entry.size() > 3 && entry.substr(entry.size() - 3) == "_Pa";
            const bool is_strain = entry.find("eps_") == 0 ||
                                   entry.find("strain") != std::string::npos;
            const double shown = (is_stress   ? 1e-3
                                  : is_strain ? 1e2
                                              : 1.) *
                                 value.get<double>();
            report += format("  %s %.6f %s\n",
                             entry.c_str(),
                             std::abs(shown) < 1e-6 ? 0. : shown,
                             is_stress   ? "k"
                             : is_strain ? "%"
                                         : "");
          }
      }
    write_file("output", [&](std::ostream &out) { out << report; });
  }
} // namespace geocone::GEOCONE_DIM
