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
  /** Runs of all methods available in this dimension, so that a file may contain the
   *  parameters of all of them. */
  class Methods
  {
  public:
    Methods(const ParameterFile &file, Log &log);
    ~Methods();

    /** The method selected by the parameter file, which has been parsed. @throws
     *  InputError */
    Simulation &
    chosen();

  private:
    struct Runs;
    std::unique_ptr<Runs> runs;
  };
} // namespace geocone::GEOCONE_DIM

#endif
