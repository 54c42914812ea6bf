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
  /** @throws RunError if the rows of points in a checkpoint have other variables than
   *  those of this run, as PointState::variables() lists them */
  void
  check_variables(const std::string &written, const std::string &here);

  /** @throws RunError if points are not in their cells, as those of a checkpoint are that
   *  is of another mesh. Collective. */
  void
  check_places(const MaterialPoints &points, const MPI_Comm comm);

  /** The points as part of a checkpoint, by cell. Collective. */
  void
  save_points(Archive &archive, const MaterialPoints &points);

  /** Those of a checkpoint, which any number of ranks may have written. */
  class PointRecord
  {
  public:
    /** Reads them, of the variables that @p like uses. Collective.
     *  @throws RunError if they do not fit */
    PointRecord(const Archive &archive, const MaterialPoints &like);

    bool
    has(const BackgroundMesh::Cell &cell) const
    {
      return cells->has(cell);
    }

    /** The rows of the points of a cell. @throws RunError if it is not known */
    std::vector<const double *>
    of(const BackgroundMesh::Cell &cell) const;

  private:
    std::size_t                 size; ///< numbers of a point
    std::vector<double>         rows;
    std::unique_ptr<CellRecord> cells;
  };
} // namespace geocone::GEOCONE_DIM

#endif
