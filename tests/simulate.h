// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_simulate_h
#define tests_simulate_h

#include <geocone/base/version.h>
#include <geocone/limit_analysis/mesh_from_bounds.h>
#include <geocone/run/implicit_simulation.h>

#include <fstream>
#include <iostream>

/** Runs a parameter file with overrides, silently, and returns its summary. */
inline geocone::Json
simulate(const std::string              &file_name,
         const std::vector<std::string> &overrides)
{
  dealii::ParameterAcceptor::clear();
  std::vector<std::string> all = {"Output/Pictures = false",
                                  "Output/Fields = false",
                                  "Output/Verbosity = 0",
                                  "Output/Report for tests = none",
                                  "Output/If folder exists = overwrite",
                                  "Output/Folder = results"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const geocone::ParameterFile file(file_name, all);
  geocone::Log                 log(MPI_COMM_WORLD, true);
  geocone::ImplicitSimulation  simulation(
    MPI_COMM_WORLD, file, log, geocone::sizes_from_bounds);
  file.parse();
  geocone::RunOptions options;
  options.name               = "test";
  std::streambuf *const cerr = std::cerr.rdbuf(nullptr); // warnings
  simulation.run(options);
  std::cerr.rdbuf(cerr);
  geocone::Json summary;
  std::ifstream("results/summary.json") >> summary;
  return summary;
}

#endif
