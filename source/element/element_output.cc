// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/element/element_output.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Summary key of a column: "stress_xx_Pa" for "stress xx (Pa)", "R" for "R
     *  (-)". */
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

  void
  ElementOutput::add_columns(const ElementPoint &point, const double volume)
  {
    table = element_columns(point, volume);
    names = table.names();
  }

  void
  ElementOutput::prepare(const RunOptions &options)
  {
    make_folder(options);
    statistics.open(path + "/path.csv", names, resumes);
    surface_table.open(path + "/surfaces.csv",
                       {"state", "surface", "p (Pa)", "q (Pa)"});
  }

  void
  ElementOutput::add_line(const ElementRecord &record)
  {
    last = table.line(record);
    statistics.add_line(last);
    if (start.empty())
      start = least = most = last;
    for (std::size_t i = 0; i < last.size(); ++i)
      {
        least[i] = std::min(least[i], last[i]);
        most[i]  = std::max(most[i], last[i]);
      }
  }

  double
  ElementOutput::value_of(const std::string &column) const
  {
    return last[std::find(names.begin(), names.end(), column) - names.begin()];
  }

  void
  ElementOutput::state_of_run(StateRow &row)
  {
    OutputBase::state_of_run(row);
    row(start, last, stages, least, most);
  }

  void
  ElementOutput::add_yield_curves(const unsigned int             at,
                                  const std::vector<YieldCurve> &curves)
  {
    // Surfaces by number: 0 yield, 1 subloading.
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (const auto &[p, q] : curves[i])
        surface_table.add_line(
          {static_cast<double>(at), static_cast<double>(i), p, q});
  }

  void
  ElementOutput::add_states(Json &summary) const
  {
    const auto state = [&](const std::vector<double> &line) {
      Json all;
      for (std::size_t i = 0; i < line.size(); ++i)
        all[key(names[i])] = line[i];
      return all;
    };
    summary["start"] = state(start);
    Json &of_stages  = summary["stages"];
    for (const auto &[stage, line] : stages)
      of_stages[stage] = state(line);
    summary["final"] = state(last);
    Json &extremes   = summary["extremes"];
    for (std::size_t i = 0; i < last.size(); ++i)
      {
        extremes[key(names[i]) + "_least"] = least[i];
        extremes[key(names[i]) + "_most"]  = most[i];
      }
  }

  void
  ElementOutput::report_results(std::ostream &out) const
  {
    for (const auto &[stage, values] : summary["stages"].items())
      {
        out << "after " + stage + "\n";
        for (const auto &[entry, value] : values.items())
          {
            // In units that make numbers of order one; substeps depend on the
            // last digits.
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
            out << format("  %s %.6f %s\n",
                          entry.c_str(),
                          std::abs(shown) < 1e-6 ? 0. : shown,
                          is_stress   ? "k"
                          : is_strain ? "%"
                                      : "");
          }
      }
  }
} // namespace geocone::GEOCONE_DIM
