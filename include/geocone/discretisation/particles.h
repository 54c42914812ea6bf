// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_particles_h
#define geocone_discretisation_particles_h

#include <geocone/base/archive.h>
#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/outflow.h>
#include <geocone/discretisation/seeding.h>
#include <geocone/discretisation/space.h>

#include <deal.II/particles/particle_handler.h>

namespace geocone
{
  /**
   * The particles of the material point method, in a ParticleHandler: the
   * owner of their state between steps, which finds their cells and sends them
   * to other ranks. A step works on the contiguous copy that collect() makes, and
   * hands it back to move().
   */
  class Particles
  {
  public:
    explicit Particles(const ParameterFile &file);

    /**
     * Seeds the body.
     * @return a warning, if the layout is too coarse for the space; or nothing
     * @throws InputError for wrong parameters or an empty region
     */
    std::string
    prepare(const Scene &scene, const BackgroundMesh &mesh, const Space &space);

    /** The particles as arrays, sorted by cell, with N and grad N. */
    MaterialPoints
    collect(const BackgroundMesh &mesh, const Space &space) const;

    /**
     * Takes the state and the positions from the arrays that collect() made,
     * and sorts the particles into their new cells and ranks.
     * @throws StepFailure if a particle leaves the mesh and may not
     */
    void
    move(MaterialPoints &points);

    /** @name The state, as part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive, const BackgroundMesh &mesh);

    /** In place of what prepare() has seeded. */
    void
    load(const Archive &archive, const BackgroundMesh &mesh);
    /** @} */

    /** Particles that left the mesh, of all ranks. */
    unsigned int
    n_lost() const
    {
      return n_lost_all;
    }

    /** Where they come from. */
    Seeding &
    seeds()
    {
      return seeding;
    }

  private:
    /** A particle without a cell. */
    struct Lost
    {
      unsigned int                                     id;
      dealii::Point<dim>                               position;
      std::vector<double>                              properties;
      dealii::Triangulation<dim>::active_cell_iterator last_cell;
    };

    /** Finds the cells and ranks of all particles. Collective. */
    void
    sort();

    Seeding seeding;
    Outflow outflow;

    std::unique_ptr<dealii::Particles::ParticleHandler<dim>> handler;

    MPI_Comm          comm;
    unsigned int      n_history = 0; ///< history variables of a particle
    unsigned int      n_state   = 0; ///< numbers of MaterialPoints::state()
    std::vector<Lost> lost;          ///< in move()
    unsigned int      n_lost_all = 0;
  };
} // namespace geocone

#endif
