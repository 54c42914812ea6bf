// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_check_removal_h
#define geocone_time_stepping_check_removal_h

#include <geocone/base/exceptions.h>
#include <geocone/boundary/loading.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Checks before the run that a stage removes some, but not all, of the
   *  material.
   *  @throws InputError */
  inline void
  check_removal(const Stage        &stage,
                const unsigned long n_removed,
                const unsigned long n_all,
                const std::string  &what)
  {
    try
      {
        stage.removal_text(n_removed, n_all, what);
      }
    catch (const StepFailure &failure)
      {
        throw InputError(failure.what());
      }
  }
} // namespace geocone::GEOCONE_DIM

#endif
