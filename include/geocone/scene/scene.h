// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_scene_h
#define geocone_scene_scene_h

#include <geocone/boundary/boundary_conditions.h>
#include <geocone/boundary/contacts.h>
#include <geocone/boundary/loading.h>
#include <geocone/boundary/obstacles.h>
#include <geocone/geometry/regions.h>
#include <geocone/scene/initial_state.h>
#include <geocone/scene/observation.h>
#include <geocone/scene/structures.h>
#include <geocone/scene/water.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Mechanical problem before discretisation: body, materials, supports, loads
   * and observed quantities.
   */
  class Scene
  {
  public:
    explicit Scene(const ParameterFile &file);

    /** Checks all parameters. @throws InputError */
    void
    prepare();

    /** Returns the names of all supports with observable reactions. These are
     *  boundary conditions with prescribed velocities, then obstacles and
     *  contacts. */
    std::vector<std::string>
    supports() const;

    /** Returns true if the scene contains obstacles or contacts between
     *  bodies. */
    bool
    has_contact() const
    {
      return !obstacles.list.empty() || !contacts.list.empty();
    }

    /** Checks and initialises all boundary conditions. */
    void
    prepare_conditions();

    /** Checks gravity and pore water, and passes the gravitational acceleration
     *  to the materials. */
    void
    prepare_weight();

    /** Returns the mass density of a material at the point x (kg/m^3). Below
     *  the initial water table it is the saturated density. */
    double
    density(const unsigned int material, const dealii::Point<dim> &x) const;

    /** Rejects scenes with obstacles or contacts. @throws InputError @param
     *  what feature that does not support contact */
    void
    refuse_contact(const std::string &what, const std::string &remedy) const
    {
      obstacles.refuse(what, remedy);
      contacts.refuse(what, remedy);
    }

    /** Returns a warning about time histories that end before the loading
     *  programme with a non-zero value, which then remains constant, or about
     *  gravity that has not reached its value by the end. The text is empty if
     *  there are none. */
    std::string
    warn_of_time_histories() const;

    /** Returns the text of the warning that loads and reactions do not include
     *  the water pressure. The text is empty without water. */
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
