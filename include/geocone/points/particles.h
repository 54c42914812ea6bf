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
   * The particles of the material point method: seeds them, finds their cells, sends
   * them to the ranks that own these, and evaluates the functions where they are.
   * Their state is all in MaterialPoints, sorted by cell and number.
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
    prepare(const Scene          &scene,
            const BackgroundMesh &mesh,
            const Space          &space,
            MaterialPoints       &points);

    /** Takes away those that do not stay. */
    void
    keep(const std::vector<bool> &stays, MaterialPoints &points) const;

    /** Adds those of a material that a stage adds. Collective.
     *  @return how many, of all ranks */
    unsigned long
    add(const unsigned int material, MaterialPoints &points);

    /** Forgets those that a stage of a resumed run has added. */
    void
    forget(const unsigned int material)
    {
      waiting.erase(material);
    }

    /**
     * Sorts the particles, which have moved, into their new cells and ranks.
     * Collective.
     * @throws StepFailure if a particle leaves the mesh and may not
     */
    void
    sort(MaterialPoints &points);

    /**
     * Prepares the projection of B-bar, before each step: the means over cells, with the
     * weights of the points. Collective.
     * @param consistent make_consistent() first, of splines and where no bodies touch
     * @param limits of the soil
     */
    void
    prepare_b_bar(const bool                    consistent,
                  const std::vector<SoilLimit> &limits,
                  MaterialPoints               &points) const;

    /** After BackgroundMesh::repartition(), and Space::follow_ranks(): sends particles to
     *  where their cells are. Collective. */
    void
    follow_ranks(MaterialPoints &points) const
    {
      find_cells(points);
    }

    /** @name The state, as part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive, const MaterialPoints &points);

    /** In place of what is there. */
    void
    load(const Archive &archive, MaterialPoints &points);

    /** Counts those that are lost from here on. */
    void
    forget_lost()
    {
      n_lost_all = 0;
    }
    /** @} */

    /** After the mesh has moved, before sort(). */
    void
    follow_mesh()
    {
      search = std::make_unique<CellSearch>(*mesh);
    }

    /** Particles that left the mesh, of all ranks. */
    unsigned int
    n_lost() const
    {
      return n_lost_all;
    }

    /** Whether those that leave the mesh are counted, and the run goes on. */
    bool
    may_leave() const
    {
      return !outflow.is_error();
    }

    /** Where they come from. */
    Seeding &
    seeds()
    {
      return seeding;
    }

  private:
    /** Sorts them. @return a text of one of those that have left the mesh, and their
     *  number, of this rank */
    std::pair<std::string, unsigned int>
    find_cells(MaterialPoints &points) const;

    /** What depends on the cells of the points: functions, nodes. */
    void
    evaluate(MaterialPoints &points) const;

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

    /** Particles of materials that stages will add. */
    std::map<unsigned int, MaterialPoints> waiting;

    const Contacts       *contacts = nullptr;
    const BackgroundMesh *mesh     = nullptr;
    const Space          *space    = nullptr;
    MPI_Comm              comm;
    unsigned int          n_lost_all = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
