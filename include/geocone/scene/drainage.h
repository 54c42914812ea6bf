// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_drainage_h
#define geocone_scene_drainage_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Parameters of pore water that flows relative to saturated soil
   *  (consolidation), for the methods that compute this flow. */
  class Drainage : public dealii::ParameterAcceptor
  {
  public:
    Drainage();

    /** Name of the parameter "Time stepping/Consolidation", for error
     *  messages. */
    static const char *const parameter;

    /** Name of the parameter "Time stepping/Drained sides". */
    static const char *const parameter_of_sides;

    bool acts = false; ///< whether excess pore pressures dissipate

    /** Names of the sides on which the excess pore pressure is zero. */
    std::vector<std::string> sides;
  };
} // namespace geocone

#endif
