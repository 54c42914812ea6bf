// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_observed_points_h
#define geocone_points_observed_points_h

#include <geocone/points/material_points.h>
#include <geocone/points/point_arrays.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Displacements at the observed positions (parameter "Observation/Points"). They
   * are either interpolated by the shape functions of a cell at a fixed position,
   * or those of the initially nearest material point, tracked across all ranks.
   * All functions are collective.
   */
  class ObservedPoints
  {
  public:
    /** Locates the observed positions in the cells of a mesh. @throws InputError
     *  for a position outside of the mesh */
    void
    prepare_field(const Scene          &scene,
                  const BackgroundMesh &mesh,
                  const Space          &space);

    /** Selects the material point nearest to each observed position. @throws
     *  InputError for a position outside of the body */
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

    /** Excess pore pressures at the observed positions in undrained soil (Pa).
     *  They are taken at the nearest material point within the cell, or at the
     *  tracked material point. */
    std::vector<double>
    pressures(const MaterialPoints &points) const;
    /** @param excess_pressure of a point of a group (Pa) */
    std::vector<double>
    pressures(
      const std::vector<PointArrays>                    &groups,
      const std::function<double(const PointArrays &group,
                                 const unsigned int p)> &excess_pressure) const;

    /** Writes the identities of material points into a checkpoint, or reads
     *  them: another number of ranks numbers points in another order. */
    void
    state(StateRow &row)
    {
      row(id);
    }

  private:
    /** Observed position in a cell of this rank. */
    struct InCell
    {
      std::vector<unsigned int> nodes; ///< local; empty if on another rank
      std::vector<double>       values;
      dealii::Point<dim>        position;

      /** Index of the cell among all cells of this rank. */
      unsigned int cell = dealii::numbers::invalid_unsigned_int;
    };

    /** Candidate for the material point nearest to an observed position. */
    struct Candidate
    {
      dealii::Point<dim> position;
      double             volume = 0.;
      unsigned int       id     = 0;
    };

    /** Selects, over all ranks, the material point nearest to each observed
     *  position. @param own candidates of this rank, one for each position */
    void
    choose(const Scene                                 &scene,
           const std::vector<std::optional<Candidate>> &own);

    /** Sums values over all ranks. @param sums a value for each observed
     *  position, then the number of points that have it; without a point, the
     *  result is NaN */
    std::vector<double>
    gather_values(std::vector<double> &sums) const;

    /** Sums displacement components over all ranks. The result is NaN if no rank
     *  has a value. */
    std::vector<dealii::Tensor<1, dim>>
    gather(std::vector<double> &sums) const;

    MPI_Comm                  comm = MPI_COMM_SELF;
    std::vector<InCell>       in_cell;
    std::vector<unsigned int> id; ///< of material points
  };
} // namespace geocone::GEOCONE_DIM

#endif
