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
   * Manages the particles of the material point method. The class generates
   * particles, locates them in cells, sends them to the ranks that own the cells,
   * and evaluates the shape functions at the particles. The state of particles is
   * in MaterialPoints, sorted by cell and particle number.
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

    /** Removes all particles p for which stays[p] is false. */
    void
    keep(const std::vector<bool> &stays, MaterialPoints &points) const;

    /** Appends the particles of a material that is placed in a stage. Collective.
     *  @return number of appended particles, over all ranks */
    unsigned long
    add(const unsigned int material, MaterialPoints &points);

    /** Discards the prepared particles of a material that was already placed before
     *  the run was resumed. */
    void
    forget(const unsigned int material)
    {
      waiting.erase(material);
    }

    /**
     * Assigns particles to their new cells and ranks after a motion. Collective.
     * @throws StepFailure if a particle leaves the mesh and this is an error
     */
    void
    sort(MaterialPoints &points);

    /**
     * Prepares weights and gradients before each step: those of consistent
     * integration, and of the B-bar method, which are volume-weighted
     * projections within cells. Collective.
     * @param consistent whether to call make_consistent(): for splines with B-bar
     * or loaded sides, without contact of bodies
     * @param boundary sides that limit the soil, for make_consistent()
     */
    void
    prepare_integration(const bool          consistent,
                        const SoilBoundary &boundary,
                        MaterialPoints     &points) const;

    /** Sends particles to the ranks that own their cells. Called after
     *  BackgroundMesh::repartition() and Space::follow_ranks(). Collective. */
    void
    follow_ranks(MaterialPoints &points) const
    {
      find_cells(points);
    }

    /** @name Checkpoints. Collective. */
    /** @{ */
    void
    save(Archive &archive, const MaterialPoints &points);

    /** Replaces the current particles with the particles of a checkpoint. */
    void
    load(const Archive &archive, MaterialPoints &points);

    /** Resets the number of particles that left the mesh to zero. */
    void
    forget_lost()
    {
      n_lost_all = 0;
    }
    /** @} */

    /** Updates the cell search after a motion of the mesh; to be called before
     *  sort(). */
    void
    follow_mesh()
    {
      search = std::make_unique<CellSearch>(*mesh);
    }

    /** Number of particles that have left the mesh, over all ranks. */
    unsigned int
    n_lost() const
    {
      return n_lost_all;
    }

    /** Returns true if particles may leave the mesh. Such particles are removed and
     *  counted. */
    bool
    may_leave() const
    {
      return !outflow.is_error();
    }

    /** Layout of the initial particles. */
    Seeding &
    seeds()
    {
      return seeding;
    }

  private:
    /** Locates the particles in the cells of this rank and sorts them by cell.
     *  @return a message on one particle that has left the mesh, and the number of
     *  such particles on this rank */
    std::pair<std::string, unsigned int>
    find_cells(MaterialPoints &points) const;

    /** A warning if cubic elements have fewer particles per cell than they need,
     *  otherwise empty. */
    std::string
    warning_of_few_particles() const;

    /** Determines the node numbers and evaluates the shape functions at all
     *  particles. */
    void
    evaluate(MaterialPoints &points) const;

    /**
     * Limits unit coordinates of a particle to a distance of at least 1e-6 from the
     * cell boundary. On the boundary, shape functions of the adjacent cell would
     * vanish with a non-zero gradient: their nodes without mass would be fixed, and
     * resist a body in free flight.
     */
    dealii::Point<dim>
    inside(const dealii::Point<dim> &unit) const;

    Seeding seeding;
    Outflow outflow;
    double  margin = 0.; ///< used by inside(); zero for splines

    std::unique_ptr<CellSearch> search;

    /** Particles prepared for materials that are placed in later stages, by
     *  material. */
    std::map<unsigned int, MaterialPoints> waiting;

    const Contacts       *contacts = nullptr;
    const BackgroundMesh *mesh     = nullptr;
    const Space          *space    = nullptr;
    MPI_Comm              comm;
    unsigned int          n_lost_all = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
