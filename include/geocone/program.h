// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_program_h
#define geocone_program_h

#include <geocone/base/types.h>

namespace geocone::GEOCONE_DIM
{
  /** All that the program does with its arguments, for scenes of one dimension: that of
   *  the build. @return its exit code */
  int
  run_geocone(int argc, char **argv);
} // namespace geocone::GEOCONE_DIM

#endif
