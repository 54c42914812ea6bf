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
   * Displacements at the positions of "Observation/Points": either of the
   * field, by the shape functions of the cell at the position, or of the
   * material point that is initially nearest, followed from then on across all
   * ranks. All functions are collective.
   */
  class ObservedPoints
  {
  public:
    /** Positions in a mesh. @throws InputError for one outside of it */
    void
    prepare_field(const Scene          &scene,
                  const BackgroundMesh &mesh,
                  const Space          &space);

    /** Material points. @throws InputError for a position outside of the
     *  body */
    void
    prepare_points(const Scene          &scene,
                   const MaterialPoints &points,
                   const MPI_Comm        comm);
    void
    prepare_points(const Scene                    &scene,
                   const std::vector<PointArrays> &groups,
                   const MPI_Comm                  comm);

    /** @name Displacements in the order of the positions (m); NaN for a
     *  material point that has left the mesh */
    /** @{ */
    std::vector<dealii::Tensor<1, dim>>
    displacements(const MaterialPoints &points,
                  const Vector         &nodal_displacement) const;
    std::vector<dealii::Tensor<1, dim>>
    displacements(const std::vector<PointArrays> &groups) const;
    /** @} */

    /** Excess pore pressures of undrained soil (Pa): of the material point of
     *  the cell nearest to a position in a mesh, or of the material point that
     *  is followed. */
    std::vector<double>
    pressures(const MaterialPoints &points) const;

  private:
    /** A position in a cell of this rank. */
    struct InCell
    {
      std::vector<unsigned int> nodes; ///< local; empty if not in its cells
      std::vector<double>       values;
      dealii::Point<dim>        position;

      /** Number among all cells of this rank. */
      unsigned int cell = dealii::numbers::invalid_unsigned_int;
    };

    /** A candidate for the nearest material point. */
    struct Candidate
    {
      dealii::Point<dim> position;
      double             volume = 0.;
      unsigned int       id     = 0;
    };

    /** Sets the ids. @param own candidates of this rank, one for each
     *  position */
    void
    choose(const Scene                                 &scene,
           const std::vector<std::optional<Candidate>> &own);

    /** Sums the values over the ranks; NaN if none has one. */
    std::vector<dealii::Tensor<1, dim>>
    gather(std::vector<double> &sums) const;

    MPI_Comm                  comm = MPI_COMM_SELF;
    std::vector<InCell>       in_cell;
    std::vector<unsigned int> id; ///< of material points
  };
} // namespace geocone::GEOCONE_DIM

#endif
