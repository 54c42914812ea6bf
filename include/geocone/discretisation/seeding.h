// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_seeding_h
#define geocone_discretisation_seeding_h

#include <geocone/discretisation/background_mesh.h>

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
    Mandel                 stress = Mandel::Zero();
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

    /** The k of the layouts that follow the cells, 0 for the others. */
    unsigned int
    points_per_direction() const;

  private:
    /** The points in this rank's cells, for layouts that follow the cells. */
    std::vector<Seed>
    follow_cells(const Geometry &geometry, const BackgroundMesh &mesh) const;

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
