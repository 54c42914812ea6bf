// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_field_files_h
#define geocone_output_field_files_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * What a file of fields holds of this rank: cells that share no nodes, and
   * values at the nodes. Arrays are asked for one at a time, so that a file costs
   * the memory of one of them.
   */
  struct FieldTable
  {
    /** What each cell is; its nodes stand one after another, those of quadrilaterals
     *  and hexahedra in lexicographic order. */
    enum class Cell
    {
      point,
      triangle,
      quadrilateral,
      tetrahedron,
      hexahedron
    };

    /** What a kind of cells is in VTK's and XDMF's terms. */
    struct Kind
    {
      unsigned int                n_nodes, vtk_type;
      const char                 *xdmf_type;
      std::array<unsigned int, 8> order; ///< of the nodes
    };
    const Kind &
    kind() const;

    /** Fills an array with the values of each node one after another. */
    using Fill = std::function<void(std::vector<double> &)>;

    struct Column
    {
      std::string  name;
      unsigned int n_components; ///< 1, or dim of a vector
      Fill         fill;         ///< its argument has the right length
    };

    Cell                cell    = Cell::point;
    std::size_t         n_nodes = 0;
    Fill                positions; ///< dim values per node (m)
    std::vector<Column> columns;

    unsigned int
    nodes_per_cell() const
    {
      return kind().n_nodes;
    }

    /** The numbers of the nodes of all cells in VTK's order, @p n_nodes in all. */
    template <typename Number>
    std::vector<Number>
    connectivity(const std::size_t n_nodes) const
    {
      const auto &[n, type, name, order] = kind();
      std::vector<Number> nodes(n_nodes);
      for (std::size_t i = 0; i < n_nodes; ++i)
        nodes[i] = i / n * n + order[i % n];
      return nodes;
    }

    std::size_t
    n_cells() const
    {
      return n_nodes / nodes_per_cell();
    }

    /** The array of a column, or the positions. */
    std::vector<double>
    values(const Fill &fill, const unsigned int n_components) const;
  };

  /** What fields are written as. */
  enum class FieldsFormat
  {
    vtu,
    hdf5,
    both
  };

  /**
   * The files of one kind of cells at all times, in the formats wanted:
   *  - vtu: base-NNNN.vtu, or a file per rank and base-NNNN.pvtu, and the series
   *    base.pvd. Single precision, compressed in haste.
   *  - hdf5: base-NNNN.h5, of all ranks, with the arrays nodes, cells and one for
   *    each column, vectors with a third component 0. Double precision, not
   *    compressed. The first rank holds the file in memory. Two records of the
   *    series: base.xdmf, and base.vtkhdf, a VTKHDF file (version 2.0, of an
   *    unstructured grid) of all times whose arrays are those of the .h5 files, which
   *    it names and does not copy.
   * Each file is written whole.
   */
  class FieldFiles
  {
  public:
    /** @param base e.g. "points" */
    FieldFiles(const std::string &base, const FieldsFormat format);

    /** Writes base-NNNN and adds it to the series. Collective.
     *  @throws StepFailure, on all ranks, if one of them cannot write */
    void
    write(const FieldTable  &table,
          const std::string &folder,
          const double       time,
          const MPI_Comm     comm);

    /** The series so far, for a checkpoint. */
    void
    state(StateRow &row)
    {
      row(number, vtu, hdf5);
    }

  private:
    /** The .vtu file of a rank. */
    std::string
    piece(const unsigned int rank, const unsigned int n_ranks) const;

    /** Writes the piece of this rank. */
    void
    write_as_vtu(const FieldTable  &table,
                 const std::string &folder,
                 const double       time,
                 const MPI_Comm     comm) const;

    /** Enters the pieces of all ranks, which have been written, in the record. */
    void
    record_vtu(const FieldTable  &table,
               const std::string &folder,
               const double       time,
               const MPI_Comm     comm);

    /** @param problem what has gone wrong on this rank; then nothing is done */
    void
    write_as_hdf5(const FieldTable  &table,
                  const std::string &folder,
                  const double       time,
                  const MPI_Comm     comm,
                  std::string       &problem);

    /** The records of the .h5 files so far, whose columns are those of @p table. */
    void
    write_xdmf(const FieldTable &table, const std::string &folder) const;
    void
    write_vtkhdf(const FieldTable &table, const std::string &folder) const;

    /** What a .h5 file holds. */
    struct Hdf5State
    {
      double      time;
      std::string file;
      std::size_t n_nodes; ///< of all ranks

      void
      state(StateRow &row)
      {
        row(time, file, n_nodes);
      }
    };

    const std::string  base;
    const FieldsFormat format;
    unsigned int       number = 0;

    /** Of the first rank: times and files. */
    std::vector<std::pair<double, std::string>> vtu;
    std::vector<Hdf5State>                      hdf5;
  };
} // namespace geocone::GEOCONE_DIM

#endif
