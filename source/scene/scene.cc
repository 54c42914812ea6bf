// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/scene/scene.h>

namespace geocone
{
  Scene::Scene(const ParameterFile &file)
    : geometry(file)
    , materials(file)
    , regions(file)
    , dirichlet(
        file,
        "Boundary conditions",
        "Velocity",
        "Prescribed velocity (m/s)",
        "free",
        "Names of the conditions with prescribed velocities, "
        "comma-separated; each has a subsection of that name. Where two "
        "of them prescribe the same component of a node, the later one "
        "holds.")
    , tractions(
        file,
        "Tractions",
        "Traction",
        "Traction (Pa)",
        "none",
        "Names of the conditions with given tractions, comma-separated; "
        "each has a subsection of that name. They add up.")
    , loading(file)
  {}

  void
  Scene::prepare()
  {
    geometry.prepare();
    materials.prepare();
    regions.prepare(geometry);
    gravity.prepare();
    initial_velocity.prepare();
    initial_stress.prepare(gravity, geometry, regions);
    dirichlet.prepare();
    tractions.prepare();
    loading.prepare();
    observation.prepare(dirichlet, materials, gravity);
  }
} // namespace geocone
