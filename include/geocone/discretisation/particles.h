// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_particles_h
#define geocone_discretisation_particles_h

#include <geocone/base/archive.h>
#include <geocone/discretisation/cell_search.h>
#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/outflow.h>
#include <geocone/discretisation/seeding.h>
#include <geocone/discretisation/space.h>

#include <map>
#include <memory>
#include <vector>

namespace geocone
{
  /**
   * The particles of the material point method: the owner of their state between
   * steps, which finds their cells and sends them to other ranks. A step works on the contiguous copy that collect() makes, and
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

    /** Takes away those whose place in collect() is not true. */
    void
    keep(const std::vector<bool> &stays);

    /** Adds those of a material that a stage adds. Collective.
     *  @return how many, of all ranks */
    unsigned long
    add(const unsigned int material);

    /** Takes the state and the positions from the arrays that collect() made. */
    void
    store(MaterialPoints &points);

    /**
     * As store(), and sorts the particles into their new cells and ranks.
     * @throws StepFailure if a particle leaves the mesh and may not
     */
    void
    move(MaterialPoints &points);

    /** @name The state, as part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive, const BackgroundMesh &mesh);

    /** In place of what is there. */
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
    /** Who is where: the cell by its active cell index. */
    struct Place
    {
      unsigned int       id, cell;
      dealii::Point<dim> position, unit;
    };
    static constexpr unsigned int unknown_cell =
      dealii::numbers::invalid_unsigned_int;

    /** Finds the cells and ranks of all particles. Collective.
     *  @return those of this rank that have left the mesh, and are no more */
    std::vector<Place>
    sort();

    /**
     * The unit coordinates that a particle of elements is given: at least a part
     * of 1e-6 of the cell inside of it. On the border functions of the cell beyond
     * would vanish with a gradient that does not: without mass they would be held,
     * and resist a body that only flies.
     */
    dealii::Point<dim>
    inside(const dealii::Point<dim> &unit) const;

    Seeding seeding;
    Outflow outflow;
    double  margin = 0.; ///< of inside(); splines need none

    std::unique_ptr<CellSearch> search;
    std::vector<Place>          places; ///< sorted by cell, and in it by id
    std::vector<double>         states; ///< n_state numbers of each

    /** Particles of a material that a stage will add. */
    struct Waiting
    {
      std::vector<dealii::Point<dim>> position;
      std::vector<unsigned int>       id;
      std::vector<double>             states;
    };
    std::map<unsigned int, Waiting> waiting; ///< by material

    MPI_Comm     comm;
    unsigned int n_history  = 0; ///< history variables of a particle
    unsigned int n_state    = 0; ///< numbers of MaterialPoints::state()
    unsigned int n_lost_all = 0;
  };
} // namespace geocone

#endif
