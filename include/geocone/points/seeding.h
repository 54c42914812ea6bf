// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_seeding_h
#define geocone_points_seeding_h

#include <geocone/base/choice.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/points/particle_file.h>
#include <geocone/space/cartesian_grid.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Generates the initial particles (seeds) in the body. The layouts are:
   *
   *  - Gauss: the k x k Gauss points of each quadrilateral, with their weights;
   *    for triangles the 1, 3, 7, 15, 19 points of symmetric rules for k = 1 to
   *    5;
   *  - sub-cells: the centres of k x k equal parts of each cell;
   *  - lattice: a square lattice, at half a spacing from the lower left corner
   *    of the box around the body, independent of the mesh;
   *  - random: uniformly distributed, independent of the number of ranks;
   *  - file: a particle file, optionally with data beyond position and volume.
   *
   * All layouts except files yield only points within the body.
   *
   * Seeds are passed on one by one, so that no rank stores seeds of other
   * ranks, nor its own seeds twice; callers that need arrays of the right
   * length count the seeds first. The order depends only on the parameters and
   * the cells.
   */
  class Seeding : public dealii::ParameterAcceptor
  {
  public:
    explicit Seeding(const ParameterFile &file);

    /** Checks the parameters. @throws InputError */
    void
    prepare(const Scene &scene);

    /** Type of functions that are called with each seed (initial particle). */
    using Take = std::function<void(const Seed &)>;

    /** @name Seeds in the cells of this rank of a mesh (collective). Seeds on
     *  cell boundaries belong to the lowest rank. */
    /** @{ */
    void
    for_each(const Scene          &scene,
             const BackgroundMesh &mesh,
             const Take           &take) const;

    /**
     * Number of seeds (initial particles) of each material.
     * @throws InputError, on all ranks, for unreadable files, points outside of
     * the mesh, and materials without points; so does make()
     */
    std::vector<std::size_t>
    count(const Scene &scene, const BackgroundMesh &mesh) const;

    std::vector<Seed>
    make(const Scene &scene, const BackgroundMesh &mesh) const;
    /** @} */

    /** @name Seeds in a range of columns of a uniform grid */
    /** @{ */
    void
    for_each(const Scene                       &scene,
             const CartesianGrid               &grid,
             const std::array<unsigned int, 2> &columns,
             const Take                        &take) const;

    /** Number of seeds of each material in each column of the grid. Collective.
     *  @throws InputError as above */
    std::vector<std::vector<std::size_t>>
    count(const Scene         &scene,
          const CartesianGrid &grid,
          const MPI_Comm       comm) const;
    /** @} */

    /** Number k of points per direction in cell-based layouts; 0 for other
     *  layouts. */
    unsigned int
    points_per_direction() const;

    /**
     * Expected number of seeds on all ranks, in closed form, before a mesh is
     * created. It is the number of seeds per cell times the number of cells in
     * the body, the area of the body divided by the area of a lattice square,
     * the given number, or the number of rows of the file. To be called after
     * prepare() of this object and of the scene.
     */
    double
    expected_number(const Scene                    &scene,
                    const BackgroundMesh::Expected &mesh) const;

    /** Name of the parameter that determines the number of seeds. Empty if the
     *  number of cells determines it. */
    std::string
    size_parameter() const;

  private:
    /** Rejects lattices and random seeds that take too long to generate.
     *  @throws InputError if a lattice or random points would take too long */
    void
    check_effort(const Geometry &geometry) const;

    /** Data of the seeds to be determined: position and material only, or all
     *  data. */
    enum class Detail
    {
      material,
      all
    };

    void
    visit(const Scene          &scene,
          const BackgroundMesh &mesh,
          const Detail          detail,
          const Take           &take) const;

    void
    visit(const Scene                       &scene,
          const CartesianGrid               &grid,
          const std::array<unsigned int, 2> &columns,
          const Detail                       detail,
          const Take                        &take) const;

    /** Block of seeds read from a particle file, with flags for the columns
     *  that the file contains. */
    using Block     = std::vector<Seed>;
    using Given     = std::array<bool, ParticleFile::n_columns>;
    using TakeBlock = std::function<void(Block &, const Given &)>;

    /** Generates the seeds of layouts that do not depend on the mesh. The
     *  blocks of seeds are equal on all ranks. */
    void
    visit_all(const Scene &scene, const TakeBlock &take) const;

    /** Completes a seed with the data that the particle file does not contain,
     *  taken from the scene. */
    void
    describe(Seed        &seed,
             const Scene &scene,
             const Given &given,
             const Detail detail) const;

    enum class Layout
    {
      gauss,
      sub_cells,
      lattice,
      random,
      file
    };

    Choice<Layout> layout = {{{"Gauss", Layout::gauss},
                              {"sub-cells", Layout::sub_cells},
                              {"lattice", Layout::lattice},
                              {"random", Layout::random},
                              {"file", Layout::file}}};

    const std::string folder_of_parameters;
    unsigned int      k           = 2;
    double            spacing     = 0.05;
    unsigned int      number      = 1000;
    unsigned int      random_seed = 1;
    std::string       file;
  };
} // namespace geocone::GEOCONE_DIM

#endif
