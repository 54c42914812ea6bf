// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_cell_record_h
#define geocone_mesh_cell_record_h

#include <geocone/base/exceptions.h>
#include <geocone/mesh/background_mesh.h>

#include <deal.II/grid/cell_id.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Table that assigns checkpoint records to mesh cells, independently of the
   * number of MPI ranks. Cells are identified by their CellId.
   */
  class CellRecord
  {
  public:
    /** Creates an empty table for writing a checkpoint. */
    CellRecord() = default;

    /** Reads a table. @throws RunError if the table does not match the records */
    CellRecord(const std::vector<double> &numbers, const std::size_t n_records)
    {
      std::size_t begin = 0;
      for (std::size_t i = 0; i + 5 <= numbers.size(); i += 5)
        {
          Name name;
          for (unsigned int k = 0; k < 4; ++k)
            name[k] = static_cast<unsigned int>(numbers[i + k]);
          const auto n = static_cast<std::size_t>(numbers[i + 4]);
          ranges[name] = {begin, begin + n};
          begin += n;
        }
      if (begin != n_records)
        throw RunError("the cells of the checkpoint have other numbers of "
                       "records than it holds");
    }

    /** Assigns the next n records of the checkpoint to a cell. */
    void
    add(const BackgroundMesh::Cell &cell, const std::size_t n)
    {
      for (const unsigned int part : cell->id().to_binary<dim>())
        numbers.push_back(part);
      numbers.push_back(n);
    }

    bool
    has(const BackgroundMesh::Cell &cell) const
    {
      return ranges.count(cell->id().to_binary<dim>()) > 0;
    }

    /** Index range of the checkpoint records of a cell. @throws RunError for an
     *  unknown cell */
    std::pair<std::size_t, std::size_t>
    range(const BackgroundMesh::Cell &cell) const
    {
      const auto found = ranges.find(cell->id().to_binary<dim>());
      if (found == ranges.end())
        throw RunError("the checkpoint is of another mesh");
      return found->second;
    }

    std::vector<double> numbers; ///< five per cell: its CellId, and n

  private:
    using Name = dealii::CellId::binary_type;
    std::map<Name, std::pair<std::size_t, std::size_t>> ranges;
  };
} // namespace geocone::GEOCONE_DIM

#endif
