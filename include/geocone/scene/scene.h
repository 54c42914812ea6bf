// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_scene_h
#define geocone_scene_scene_h

#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/geometry.h>
#include <geocone/scene/loading.h>
#include <geocone/scene/observation.h>

namespace geocone
{
  /**
   * The mechanical problem, before any discretisation: where the body is, what
   * it is made of, what holds and loads it, and what is observed.
   */
  class Scene
  {
  public:
    explicit Scene(const ParameterFile &file);

    /** Checks all parameters. @throws InputError */
    void
    prepare();

    Geometry           geometry;
    Materials          materials;
    Regions            regions;
    Gravity            gravity;
    InitialVelocity    initial_velocity;
    InitialStress      initial_stress;
    BoundaryConditions dirichlet;
    BoundaryConditions tractions;
    LoadingProgramme   loading;
    Observation        observation;
  };
} // namespace geocone

#endif
