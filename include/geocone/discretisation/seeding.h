// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_seeding_h
#define geocone_discretisation_seeding_h

#include <geocone/discretisation/background_mesh.h>
#include <geocone/discretisation/cartesian_grid.h>

#include <deal.II/base/tensor.h>

#include <set>
#include <string>
#include <vector>

namespace geocone
{
  /** A particle before its life: what the scene says of it. */
  struct Seed
  {
    dealii::Point<dim>     position;
    double                 volume   = 0.; ///< per unit thickness (m^2)
    unsigned int           material = 0;
    dealii::Tensor<1, dim> velocity;
    Mandel                 stress    = Mandel::Zero();
    double                 stress_zz = 0.;
  };

  /**
   * How the body is filled with particles:
   *  - Gauss: the k x k Gauss points of each cell, with their weights;
   *  - sub-cells: the centres of k x k equal parts of each cell;
   *  - lattice: a square lattice, half a spacing off the lower left corner of
   *    the box around the body, whatever the mesh;
   *  - random: uniformly distributed, the same on every number of ranks;
   *  - file: a table, which may know more of them than place and volume.
   * All but a file give the points within the body only.
   */
  class Seeding : public dealii::ParameterAcceptor
  {
  public:
    explicit Seeding(const ParameterFile &file);

    /** Checks the parameters. @throws InputError */
    void
    prepare(const Scene &scene);

    /**
     * The seeds in the cells of this rank (collective). One on the face between
     * two ranks belongs to the lower one.
     * @throws InputError, on all ranks, for files that cannot be understood,
     * points outside the mesh, and materials without points
     */
    std::vector<Seed>
    make(const Scene &scene, const BackgroundMesh &mesh) const;

    /** The same on a uniform grid, of which each rank gets a slab of columns. */
    std::vector<Seed>
    make(const Scene         &scene,
         const CartesianGrid &grid,
         const MPI_Comm       comm) const;

    /** The k of the layouts that follow the cells, 0 for the others. */
    unsigned int
    points_per_direction() const;

  private:
    /** The points in this rank's cells, for layouts that follow the cells. */
    std::vector<Seed>
    follow_cells(const Geometry &geometry, const BackgroundMesh &mesh) const;

    std::vector<Seed>
    follow_cells(const Geometry                    &geometry,
                 const CartesianGrid               &grid,
                 const std::array<unsigned int, 2> &columns) const;

    /** The points of the layouts that do not follow cells; all of them. */
    std::vector<Seed>
    make_all(const Scene &scene, std::set<std::string> &given) const;

    /** What the scene says of the seeds, where a file has not said it. */
    void
    describe(std::vector<Seed>           &seeds,
             const Scene                 &scene,
             const std::set<std::string> &given) const;

    std::vector<Seed>
    make_lattice(const Geometry &geometry) const;

    std::vector<Seed>
    make_random(const Geometry &geometry) const;

    /** The points of the file; @p given: the names of its columns. */
    std::vector<Seed>
    read_file(const Materials &materials, std::set<std::string> &given) const;

    const std::string folder_of_parameters;
    std::string       layout      = "Gauss";
    unsigned int      k           = 2;
    double            spacing     = 0.05;
    unsigned int      number      = 1000;
    unsigned int      random_seed = 1;
    std::string       file;
  };
} // namespace geocone

#endif
