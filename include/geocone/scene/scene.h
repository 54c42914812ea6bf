// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_scene_h
#define geocone_scene_scene_h

#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/contacts.h>
#include <geocone/scene/geometry.h>
#include <geocone/scene/initial_state.h>
#include <geocone/scene/loading.h>
#include <geocone/scene/observation.h>
#include <geocone/scene/obstacles.h>
#include <geocone/scene/water.h>

#include <vector>

namespace geocone::GEOCONE_DIM
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

    /** Names of what holds the body and can be observed: the conditions with
     *  prescribed velocities, then the obstacles and the contacts. */
    std::vector<std::string>
    supports() const;

    /** Whether something may touch. */
    bool
    has_contact() const
    {
      return !obstacles.list.empty() || !contacts.list.empty();
    }

    /** Prepares gravity, water, and the densities that follow from them. */
    void
    prepare_weight();

    /** Mass density of a material at x (kg/m^3), which is saturated below the water of
     *  the start. */
    double
    density(const unsigned int material, const dealii::Point<dim> &x) const;

    /** @throws InputError if something may touch, with what can have none of it */
    void
    refuse_contact(const std::string &what, const std::string &remedy) const
    {
      obstacles.refuse(what, remedy);
      contacts.refuse(what, remedy);
    }

    /** What a record leaves as it is before the end of the loading; empty: none does. */
    std::string
    warn_of_records() const;

    /** That loads and reactions lack the pressure of water; empty: there is none. */
    std::string
    warn_of_effective_loads() const;

    Geometry           geometry;
    Materials          materials;
    Regions            regions;
    Gravity            gravity;
    Water              water;
    InitialVelocity    initial_velocity;
    InitialStress      initial_stress;
    BoundaryConditions dirichlet;
    BoundaryConditions tractions;
    BoundaryConditions absorbing; ///< with velocities of waves that come in
    Obstacles          obstacles;
    Contacts           contacts;
    LoadingProgramme   loading;
    Observation        observation;
  };
} // namespace geocone::GEOCONE_DIM

#endif
