// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_scene_h
#define geocone_scene_scene_h

#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/contacts.h>
#include <geocone/scene/regions.h>
#include <geocone/scene/initial_state.h>
#include <geocone/scene/loading.h>
#include <geocone/scene/observation.h>
#include <geocone/scene/obstacles.h>
#include <geocone/scene/structures.h>
#include <geocone/scene/water.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * The mechanical problem before any discretisation: body, materials,
   * supports, loads and observed quantities.
   */
  class Scene
  {
  public:
    explicit Scene(const ParameterFile &file);

    /** Checks all parameters. @throws InputError */
    void
    prepare();

    /** Names of all supports, whose reactions can be observed: boundary
     *  conditions with prescribed velocities, then obstacles and contacts. */
    std::vector<std::string>
    supports() const;

    /** Whether the scene contains obstacles or contacts between bodies. */
    bool
    has_contact() const
    {
      return !obstacles.list.empty() || !contacts.list.empty();
    }

    /** Prepares the conditions on the boundary. */
    void
    prepare_conditions();

    /** Prepares gravity, water, and the densities derived from them. */
    void
    prepare_weight();

    /** Mass density of a material at x (kg/m^3), saturated below the initial
     *  water table. */
    double
    density(const unsigned int material, const dealii::Point<dim> &x) const;

    /** Rejects obstacles and contacts. @throws InputError @param what feature
     *  that does not support contact */
    void
    refuse_contact(const std::string &what, const std::string &remedy) const
    {
      obstacles.refuse(what, remedy);
      contacts.refuse(what, remedy);
    }

    /** Warning about a time history that ends before the loading programme with
     *  a non-zero value, which then remains constant; empty: none. */
    std::string
    warn_of_records() const;

    /** Warning that loads and reactions do not include the water pressure;
     *  empty without water. */
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
    BoundaryConditions absorbing; ///< velocities of incoming waves
    Obstacles          obstacles;
    Contacts           contacts;
    LoadingProgramme   loading;
    Structures         structures;
    Observation        observation;
  };
} // namespace geocone::GEOCONE_DIM

#endif
