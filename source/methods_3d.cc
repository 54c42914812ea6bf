// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Those of three dimensions, in place of methods.cc.
#include <geocone/base/exceptions.h>
#include <geocone/methods.h>
#include <geocone/run/implicit_simulation.h>

namespace geocone
{
  struct Methods::Runs
  {
    Runs(const ParameterFile &file, Log &log)
      : implicit(MPI_COMM_WORLD, file, log, {})
    {}

    ImplicitSimulation implicit;
  };

  namespace
  {
    void
    refuse(const ParameterFile &file,
           const std::string   &parameter,
           const std::string   &allowed)
    {
      if (const std::string value = file.peek(parameter, allowed);
          value != allowed)
        throw InputError(parameter,
                         value,
                         allowed + " where Geometry/Dimension = 3",
                         "the others are for plane and axisymmetric scenes");
    }
  } // namespace

  Methods::Methods(const ParameterFile &file, Log &log)
  {
    refuse(file, "Discretisation/Method", "FEM");
    refuse(file, "Analysis/Kind", "steps");
    runs = std::make_unique<Runs>(file, log);
  }

  Methods::~Methods() = default;

  Simulation &
  Methods::chosen()
  {
    return runs->implicit;
  }
} // namespace geocone
