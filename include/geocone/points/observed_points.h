// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_observed_points_h
#define geocone_points_observed_points_h

#include <geocone/points/material_points.h>
#include <geocone/points/point_arrays.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Displacements at the places of "Observation/Points": of the field, by the
   * shape functions of the cell that holds the place, or of the material point
   * that is nearest to the place at the start and is followed from then on,
   * through all ranks. All functions are collective.
   */
  class ObservedPoints
  {
  public:
    /** Places in a mesh. @throws InputError for one outside of it */
    void
    prepare_field(const Scene          &scene,
                  const BackgroundMesh &mesh,
                  const Space          &space);

    /** Material points. @throws InputError for a place outside of the body */
    void
    prepare_points(const Scene          &scene,
                   const MaterialPoints &points,
                   const MPI_Comm        comm);
    void
    prepare_points(const Scene                    &scene,
                   const std::vector<PointArrays> &groups,
                   const MPI_Comm                  comm);

    /** @name Displacements in the order of the places (m); of a material point
     *  that has left the mesh, not a number */
    /** @{ */
    std::vector<dealii::Tensor<1, dim>>
    displacements(const MaterialPoints &points,
                  const Vector         &nodal_displacement) const;
    std::vector<dealii::Tensor<1, dim>>
    displacements(const std::vector<PointArrays> &groups) const;
    /** @} */

    /** Excess pore pressures of undrained soil (Pa): of the material point nearest to
     *  a place of a mesh, in its cell, or of the one that is followed. */
    std::vector<double>
    pressures(const MaterialPoints &points) const;

  private:
    /** A place in a cell of this rank. */
    struct InCell
    {
      std::vector<unsigned int> nodes; ///< local; none where not in the cells
      std::vector<double>       values;
      dealii::Point<dim>        position;

      /** Number among all cells of this rank. */
      unsigned int cell = dealii::numbers::invalid_unsigned_int;
    };

    /** A material point that may be the nearest one. */
    struct Candidate
    {
      dealii::Point<dim> position;
      double             volume = 0.;
      unsigned int       id     = 0;
    };

    /** Sets the ids. @param own candidates of this rank, one for each place */
    void
    choose(const Scene                                 &scene,
           const std::vector<std::optional<Candidate>> &own);

    /** Sums over the ranks what each knows of, with the count of those. */
    std::vector<dealii::Tensor<1, dim>>
    gather(std::vector<double> &sums) const;

    MPI_Comm                  comm = MPI_COMM_SELF;
    std::vector<InCell>       in_cell;
    std::vector<unsigned int> id; ///< of material points
  };
} // namespace geocone::GEOCONE_DIM

#endif
