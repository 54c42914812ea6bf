// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_point_record_h
#define geocone_points_point_record_h

#include <geocone/base/archive.h>
#include <geocone/mesh/cell_record.h>
#include <geocone/points/material_points.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Checks that the points of a checkpoint have the same state variables as
   *  the current run. The variables are listed by PointState::variables().
   *  @throws RunError */
  void
  check_variables(const std::string &written, const std::string &here);

  /** Checks that each point lies in its cell. This fails for a checkpoint of
   *  another mesh. Collective. @throws RunError */
  void
  check_places(const MaterialPoints &points, const MPI_Comm comm);

  /** Saves the material points to a checkpoint, cell by cell. Collective. */
  void
  save_points(Archive &archive, const MaterialPoints &points);

  /** Material points read from a checkpoint written by any number of ranks. */
  class PointRecord
  {
  public:
    /** Reads the points of a checkpoint, with the same state variables as @p
     *  like. Collective.
     *  @throws RunError if the variables do not match */
    PointRecord(const Archive &archive, const MaterialPoints &like);

    bool
    has(const BackgroundMesh::Cell &cell) const
    {
      return cells->has(cell);
    }

    /** State variables of the points of a cell as stored in a checkpoint, one
     *  row per point. @throws RunError for an unknown cell */
    std::vector<const double *>
    of(const BackgroundMesh::Cell &cell) const;

  private:
    std::size_t                 size; ///< number of values per point
    std::vector<double>         rows;
    std::unique_ptr<CellRecord> cells;
  };
} // namespace geocone::GEOCONE_DIM

#endif
