// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_particles_h
#define geocone_points_particles_h

#include <geocone/base/archive.h>
#include <geocone/mesh/cell_search.h>
#include <geocone/points/consistent_integration.h>
#include <geocone/points/material_points.h>
#include <geocone/points/outflow.h>
#include <geocone/points/seeding.h>
#include <geocone/space/space.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * The particles of the material point method: generates them, finds their
   * cells, sends them to the ranks that own these, and evaluates the shape
   * functions at their positions. Their state is in MaterialPoints, sorted by
   * cell and number.
   */
  class Particles
  {
  public:
    explicit Particles(const ParameterFile &file);

    /**
     * Fills the body with particles.
     * @return a warning if the layout is too coarse for the space, otherwise
     * empty
     * @throws InputError for invalid parameters or an empty region
     */
    std::string
    prepare(const Scene          &scene,
            const BackgroundMesh &mesh,
            const Space          &space,
            MaterialPoints       &points);

    /** Removes the particles with stays = false. */
    void
    keep(const std::vector<bool> &stays, MaterialPoints &points) const;

    /** Adds the particles of a material that a stage adds. Collective.
     *  @return their number on all ranks */
    unsigned long
    add(const unsigned int material, MaterialPoints &points);

    /** Discards the waiting particles of a material that was added before the
     *  run was resumed. */
    void
    forget(const unsigned int material)
    {
      waiting.erase(material);
    }

    /**
     * Sorts moved particles into their new cells and ranks. Collective.
     * @throws StepFailure if a particle leaves the mesh and this is an error
     */
    void
    sort(MaterialPoints &points);

    /**
     * Prepares the projection of B-bar, before each step: means over cells,
     * weighted by the points. Collective.
     * @param consistent make_consistent() first, for splines and without
     * contact of bodies
     * @param limits of the soil
     */
    void
    prepare_b_bar(const bool                    consistent,
                  const std::vector<SoilLimit> &limits,
                  MaterialPoints               &points) const;

    /** Sends particles to the ranks of their cells, after
     *  BackgroundMesh::repartition() and Space::follow_ranks(). Collective. */
    void
    follow_ranks(MaterialPoints &points) const
    {
      find_cells(points);
    }

    /** @name State for a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive, const MaterialPoints &points);

    /** Replaces the present particles. */
    void
    load(const Archive &archive, MaterialPoints &points);

    /** Resets the number of lost particles. */
    void
    forget_lost()
    {
      n_lost_all = 0;
    }
    /** @} */

    /** Updates the search after the mesh has moved, before sort(). */
    void
    follow_mesh()
    {
      search = std::make_unique<CellSearch>(*mesh);
    }

    /** Number of particles that left the mesh, on all ranks. */
    unsigned int
    n_lost() const
    {
      return n_lost_all;
    }

    /** Whether particles that leave the mesh are counted instead of ending the
     *  run. */
    bool
    may_leave() const
    {
      return !outflow.is_error();
    }

    /** Source of the particles. */
    Seeding &
    seeds()
    {
      return seeding;
    }

  private:
    /** Sorts the particles. @return a message on one of the particles that have
     *  left the mesh, and their number on this rank */
    std::pair<std::string, unsigned int>
    find_cells(MaterialPoints &points) const;

    /** Evaluates the functions and nodes of the points. */
    void
    evaluate(MaterialPoints &points) const;

    /**
     * Unit coordinates of a particle in an element: at least 1e-6 of the cell
     * inside of it. On the boundary, functions of the adjacent cell would
     * vanish with a non-zero gradient: being without mass they would be fixed,
     * and resist a body in free flight.
     */
    dealii::Point<dim>
    inside(const dealii::Point<dim> &unit) const;

    Seeding seeding;
    Outflow outflow;
    double  margin = 0.; ///< of inside(); zero for splines

    std::unique_ptr<CellSearch> search;

    /** Particles of materials that later stages add. */
    std::map<unsigned int, MaterialPoints> waiting;

    const Contacts       *contacts = nullptr;
    const BackgroundMesh *mesh     = nullptr;
    const Space          *space    = nullptr;
    MPI_Comm              comm;
    unsigned int          n_lost_all = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
