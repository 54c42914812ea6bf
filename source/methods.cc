// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/element/element_test.h>
#include <geocone/limit_analysis/limit_analysis.h>
#include <geocone/limit_analysis/mesh_from_bounds.h>
#include <geocone/methods.h>
#include <geocone/reliability/reliability.h>
#include <geocone/run/explicit_simulation.h>
#include <geocone/run/implicit_simulation.h>
#include <geocone/run/seepage_simulation.h>
#include <geocone/shakedown/shakedown.h>

namespace geocone::GEOCONE_DIM
{
  struct Methods::Runs
  {
    Runs(const ParameterFile &file, Log &log)
      : point(MPI_COMM_WORLD, file, log)
      , implicit(MPI_COMM_WORLD, file, log, sizes_from_bounds)
      , explicit_mpm(MPI_COMM_WORLD, file, log)
      , limit_analysis(MPI_COMM_WORLD, file, log)
      , reliability(MPI_COMM_WORLD, file, log)
      , shakedown(MPI_COMM_WORLD, file, log)
      , seepage(MPI_COMM_WORLD, file, log)
    {}

    ElementTest        point;
    ImplicitSimulation implicit;
    ExplicitSimulation explicit_mpm;
    LimitAnalysis      limit_analysis;
    Reliability        reliability;
    Shakedown          shakedown;
    SeepageSimulation  seepage;
  };

  Methods::Methods(const ParameterFile &file, Log &log)
    : runs(std::make_unique<Runs>(file, log))
  {}

  Methods::~Methods() = default;

  Simulation &
  Methods::chosen()
  {
    if (runs->limit_analysis.kind() == AnalysisKind::seepage)
      return runs->seepage;
    if (runs->limit_analysis.kind() == AnalysisKind::reliability)
      return runs->reliability;
    if (runs->limit_analysis.kind() == AnalysisKind::shakedown)
      return runs->shakedown;
    if (runs->limit_analysis.kind() != AnalysisKind::steps)
      return runs->limit_analysis;
    const std::string name = ParameterFile::value("Discretisation/Method");
    if (name == "point")
      return runs->point;
    if (name == "explicit MPM")
      return runs->explicit_mpm;
    return runs->implicit;
  }
} // namespace geocone::GEOCONE_DIM
