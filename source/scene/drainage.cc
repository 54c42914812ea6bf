// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/unused_parameters.h>
#include <geocone/scene/drainage.h>

namespace geocone
{
  namespace
  {
    const UsedWhere used_drainage[] = {
      {"Time stepping/Consolidation",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Time stepping/Drained sides",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Time stepping/Drained sides", "Time stepping/Consolidation", {"true"}}};
  } // namespace

  const char *const Drainage::parameter = "Time stepping/Consolidation";
  const char *const Drainage::parameter_of_sides =
    "Time stepping/Drained sides";

  Drainage::Drainage()
    : dealii::ParameterAcceptor("/Time stepping")
  {
    add_parameter(
      "Consolidation",
      acts,
      "Whether the excess pore pressures of undrained soil "
      "('Materials/NAME/Pore fluid bulk modulus') dissipate by flow "
      "through its 'Permeability': in time steps of backward Euler, or "
      "with explicit MPM by the velocities of soil and water, of which "
      "'Saturated "
      "water content' is the porosity. false: each point keeps its water.");
    add_parameter(
      "Drained sides",
      sides,
      "Sides on which the excess pore pressure of consolidating "
      "soil is zero, comma-separated. All other sides are "
      "impervious, except those of 'Seepage'; with particles, those "
      "whose velocity is prescribed: free surfaces of the body are drained.");
  }
} // namespace geocone
