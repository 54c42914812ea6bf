// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/points/point_record.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  void
  check_variables(const std::string &written, const std::string &here)
  {
    if (written != here)
      throw RunError("the checkpoint has other variables of points (" +
                     written + ") than this run (" + here + ")");
  }

  void
  check_places(const MaterialPoints &points, const MPI_Comm comm)
  {
    bool is_outside = false;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const auto box = points.cells[c]->bounding_box();
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          is_outside =
            is_outside || !box.point_inside(points.position[p], 1e-6);
      }
    if (dealii::Utilities::MPI::logical_or(is_outside, comm))
      throw RunError(
        "the checkpoint has points of another mesh\n"
        "  remedy:  what the mesh follows has to be the same in both "
        "runs (sides, 'Water/Table', sizes of cells)");
  }

  void
  save_points(Archive &archive, const MaterialPoints &points)
  {
    StateRow    list;
    std::string variables = points.variables();
    list(variables);
    archive.write_row("points/variables", list);
    CellRecord          cells;
    std::vector<double> rows;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int first = points.first_point[c],
                           last  = points.first_point[c + 1];
        cells.add(points.cells[c], last - first);
        for (unsigned int p = first; p < last; ++p)
          points.add_row(p, rows);
      }
    archive.write("points/cells", cells.numbers);
    archive.write("points/state", rows);
  }

  PointRecord::PointRecord(const Archive &archive, const MaterialPoints &like)
    : size(like.n_numbers())
  {
    std::string variables;
    archive.read_row("points/variables")(variables);
    check_variables(variables, like.variables());
    rows  = archive.read("points/state");
    cells = std::make_unique<CellRecord>(archive.read("points/cells"),
                                         rows.size() / size);
  }

  std::vector<const double *>
  PointRecord::of(const BackgroundMesh::Cell &cell) const
  {
    const auto [begin, end] = cells->range(cell);
    std::vector<const double *> of_cell;
    for (std::size_t i = begin; i < end; ++i)
      of_cell.push_back(&rows[i * size]);
    return of_cell;
  }
} // namespace geocone::GEOCONE_DIM
