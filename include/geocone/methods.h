// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_methods_h
#define geocone_methods_h

#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/types.h>
#include <geocone/run/simulation.h>

#include <memory>

namespace geocone::GEOCONE_DIM
{
  /** Container of all numerical methods available in this space dimension. All methods
   *  are created, so that a parameter file may contain the parameters of every
   *  method. */
  class Methods
  {
  public:
    Methods(const ParameterFile &file, Log &log);
    ~Methods();

    /** Simulation object of the numerical method selected in the parameter file. To be
     *  called after ParameterFile::parse(). @throws InputError */
    Simulation &
    chosen();

  private:
    struct Runs;
    std::unique_ptr<Runs> runs;
  };
} // namespace geocone::GEOCONE_DIM

#endif
