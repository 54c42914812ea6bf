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
   * How the body is filled with particles:
   *  - Gauss: the k x k Gauss points of each quadrilateral, with their weights; of
   *    triangles the 1, 3, 7, 15, 19 points of symmetric rules for k = 1 to 5;
   *  - sub-cells: the centres of k x k equal parts of each cell;
   *  - lattice: a square lattice, half a spacing off the lower left corner of
   *    the box around the body, whatever the mesh;
   *  - random: uniformly distributed, the same on every number of ranks;
   *  - file: a table, which may know more of them than place and volume.
   * All but a file give the points within the body only.
   *
   * Seeds come one after another, so that nobody needs to hold those of other
   * ranks, nor all of its own twice: who wants arrays of the right length counts
   * first. Their order depends on nothing but the parameters and the cells.
   */
  class Seeding : public dealii::ParameterAcceptor
  {
  public:
    explicit Seeding(const ParameterFile &file);

    /** Checks the parameters. @throws InputError */
    void
    prepare(const Scene &scene);

    /** What is called with each seed. */
    using Take = std::function<void(const Seed &)>;

    /** @name Seeds in the cells of this rank of a mesh (collective)
     *  One on the border of cells belongs to the lowest rank. */
    /** @{ */
    void
    for_each(const Scene          &scene,
             const BackgroundMesh &mesh,
             const Take           &take) const;

    /**
     * Their numbers by material.
     * @throws InputError, on all ranks, for files that cannot be understood,
     * points outside the mesh, and materials without points; so does make()
     */
    std::vector<std::size_t>
    count(const Scene &scene, const BackgroundMesh &mesh) const;

    std::vector<Seed>
    make(const Scene &scene, const BackgroundMesh &mesh) const;
    /** @} */

    /** @name Seeds in some columns of cells of a uniform grid */
    /** @{ */
    void
    for_each(const Scene                       &scene,
             const CartesianGrid               &grid,
             const std::array<unsigned int, 2> &columns,
             const Take                        &take) const;

    /** Their numbers by column and material, in all columns (collective).
     *  @throws InputError as above */
    std::vector<std::vector<std::size_t>>
    count(const Scene         &scene,
          const CartesianGrid &grid,
          const MPI_Comm       comm) const;
    /** @} */

    /** The k of the layouts that follow the cells, 0 for the others. */
    unsigned int
    points_per_direction() const;

    /**
     * How many seeds there will be on all ranks, in closed form, before a mesh is
     * made: so many in each cell times the cells that the body fills, its area over
     * that of a square, the number asked for, or the rows of the file. To be called
     * after prepare(), here and of the scene.
     */
    double
    expected_number(const Scene                    &scene,
                    const BackgroundMesh::Expected &mesh) const;

    /** The parameter that the number of seeds comes from; empty: that of the
     *  cells. */
    std::string
    size_parameter() const;

  private:
    /** @throws InputError if a lattice or random points would take for ever */
    void
    check_effort(const Geometry &geometry) const;

    /** What is asked of seeds: only where they are and of which material. */
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

    /** Seeds, and whether a file has said their columns. */
    using Block     = std::vector<Seed>;
    using Given     = std::array<bool, ParticleFile::n_columns>;
    using TakeBlock = std::function<void(Block &, const Given &)>;

    /** The seeds of the layouts that do not follow cells, all of them in blocks
     *  that are the same on all ranks. */
    void
    visit_all(const Scene &scene, const TakeBlock &take) const;

    /** What the scene says of a seed, where a file has not said it. */
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
