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
   * Displacements at the positions of "Observation/Points": either interpolated
   * by the shape functions of a cell at a fixed position, or of the initially
   * nearest material point, tracked across all ranks. All functions are
   * collective.
   */
  class ObservedPoints
  {
  public:
    /** Locates the observed positions in a mesh. @throws InputError for a
     *  position outside of the mesh */
    void
    prepare_field(const Scene          &scene,
                  const BackgroundMesh &mesh,
                  const Space          &space);

    /** Selects the nearest material points. @throws InputError for a position
     *  outside of the body */
    void
    prepare_points(const Scene          &scene,
                   const MaterialPoints &points,
                   const MPI_Comm        comm);
    void
    prepare_points(const Scene                    &scene,
                   const std::vector<PointArrays> &groups,
                   const MPI_Comm                  comm);

    /** @name Displacements in the order of the observed positions (m); NaN for
     *  a material point that has left the mesh */
    /** @{ */
    std::vector<dealii::Tensor<1, dim>>
    displacements(const MaterialPoints &points,
                  const Vector         &nodal_displacement) const;
    std::vector<dealii::Tensor<1, dim>>
    displacements(const std::vector<PointArrays> &groups) const;
    /** @} */

    /** Excess pore pressures in undrained soil (Pa): at the material point
     *  nearest to the observed position within the cell, or at the tracked
     *  material point. */
    std::vector<double>
    pressures(const MaterialPoints &points) const;

  private:
    /** Observed position in a cell of this rank. */
    struct InCell
    {
      std::vector<unsigned int> nodes; ///< local; empty if on another rank
      std::vector<double>       values;
      dealii::Point<dim>        position;

      /** Index among all cells of this rank. */
      unsigned int cell = dealii::numbers::invalid_unsigned_int;
    };

    /** Candidate for the material point nearest to an observed position. */
    struct Candidate
    {
      dealii::Point<dim> position;
      double             volume = 0.;
      unsigned int       id     = 0;
    };

    /** Selects the nearest material points over all ranks. @param own
     *  candidates of this rank, one for each position */
    void
    choose(const Scene                                 &scene,
           const std::vector<std::optional<Candidate>> &own);

    /** Sums displacement components over all ranks; NaN if no rank has a value. */
    std::vector<dealii::Tensor<1, dim>>
    gather(std::vector<double> &sums) const;

    MPI_Comm                  comm = MPI_COMM_SELF;
    std::vector<InCell>       in_cell;
    std::vector<unsigned int> id; ///< of material points
  };
} // namespace geocone::GEOCONE_DIM

#endif
