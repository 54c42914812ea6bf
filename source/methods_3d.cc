// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Methods of three-dimensional scenes, instead of methods.cc.
#include <geocone/base/exceptions.h>
#include <geocone/methods.h>
#include <geocone/run/explicit_simulation.h>
#include <geocone/run/implicit_simulation.h>
#include <geocone/run/seepage_simulation.h>
#include <geocone/solid_bounds/solid_limit_analysis.h>

#include <algorithm>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  struct Methods::Runs
  {
    Runs(const ParameterFile &file, Log &log)
      : implicit(MPI_COMM_WORLD, file, log, {})
      , explicit_mpm(MPI_COMM_WORLD, file, log)
      , limit_analysis(MPI_COMM_WORLD, file, log)
      , seepage(MPI_COMM_WORLD, file, log)
    {}

    ImplicitSimulation implicit;
    ExplicitSimulation explicit_mpm;
    SolidLimitAnalysis limit_analysis;
    SeepageSimulation  seepage;
  };

  namespace
  {
    /** Refuses features of plane scenes. @param allowed the first one is the default */
    void
    check(const ParameterFile            &file,
          const std::string              &parameter,
          const std::vector<std::string> &allowed)
    {
      const std::string value = file.peek(parameter, allowed[0]);
      if (std::find(allowed.begin(), allowed.end(), value) != allowed.end())
        return;
      std::string words = allowed[0];
      for (std::size_t i = 1; i < allowed.size(); ++i)
        words += " | " + allowed[i];
      throw InputError(parameter,
                       value,
                       words + " where Geometry/Dimension = 3",
                       "the others are for plane and axisymmetric scenes");
    }
  } // namespace

  Methods::Methods(const ParameterFile &file, Log &log)
  {
    check(file, "Discretisation/Method", {"FEM", "MPM", "explicit MPM"});
    check(file,
          "Analysis/Kind",
          {"steps", "limit load", "strength reduction", "seepage"});
    runs = std::make_unique<Runs>(file, log);
  }

  Methods::~Methods() = default;

  Simulation &
  Methods::chosen()
  {
    if (runs->limit_analysis.is_seepage())
      return runs->seepage;
    if (runs->limit_analysis.is_chosen())
      return runs->limit_analysis;
    if (ParameterFile::value("Discretisation/Method") == "explicit MPM")
      return runs->explicit_mpm;
    return runs->implicit;
  }
} // namespace geocone::GEOCONE_DIM
