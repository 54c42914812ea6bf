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
   * Part of a field file that one rank writes. Cells do not share nodes; values
   * are nodal. Arrays are generated one at a time, so that only one of them is
   * held in memory.
   */
  struct FieldTable
  {
    /** Cell type of a field file. The nodes of a cell are consecutive, those of
     *  quadrilaterals and hexahedra in lexicographic order. */
    enum class Cell
    {
      point,
      triangle,
      quadrilateral,
      tetrahedron,
      hexahedron
    };

    /** Properties of a cell type in VTK and XDMF. */
    struct Kind
    {
      unsigned int                n_nodes, vtk_type;
      const char                 *xdmf_type;
      std::array<unsigned int, 8> order; ///< of the nodes in VTK
    };
    const Kind &
    kind() const;

    /** Function that fills an array with nodal values, node by node. */
    using Fill = std::function<void(std::vector<double> &)>;

    struct Column
    {
      std::string  name;
      unsigned int n_components; ///< 1, or dim for a vector
      Fill         fill;         ///< receives an array of the right length
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

    /** Returns the connectivity: the node numbers of all cells in VTK's order (@p
     *  n_nodes entries). */
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

    /** Evaluates a column of nodal values, or the nodal positions, at all
     *  nodes. */
    std::vector<double>
    values(const Fill &fill, const unsigned int n_components) const;
  };

  /** Format of field files. */
  enum class FieldsFormat
  {
    vtu,
    hdf5,
    both
  };

  /**
   * Time series of field files with one cell type. The formats are:
   *  - vtu: base-NNNN.vtu, or a file per rank and base-NNNN.pvtu, and the series
   *    base.pvd. Single precision, with fast compression.
   *  - hdf5: base-NNNN.h5 for all ranks, with the arrays nodes, cells and one for each
   *    column; vectors have a third component 0. Double precision, uncompressed. The
   *    first rank holds the file in memory. Two indices of the series: base.xdmf, and
   *    base.vtkhdf, a VTKHDF file (version 2.0, unstructured grid) of all times whose
   *    arrays link to the .h5 files instead of copying them.
   * Each file is written completely or not at all.
   */
  class FieldFiles
  {
  public:
    /** Creates an empty time series.
     *  @param base prefix of the file names, e.g. "points" */
    FieldFiles(const std::string &base, const FieldsFormat format);

    /** Writes the field files of one time and appends them to the time series.
     *  Collective.
     *  @throws StepFailure, on all ranks, if one rank cannot write */
    void
    write(const FieldTable  &table,
          const std::string &folder,
          const double       time,
          const MPI_Comm     comm);

    /** Saves the list of field files written so far to a checkpoint, or
     *  restores it from one. */
    void
    state(StateRow &row)
    {
      row(number, vtu, hdf5);
    }

  private:
    /** Name of the .vtu file of a rank. */
    std::string
    piece(const unsigned int rank, const unsigned int n_ranks) const;

    /** Writes the .vtu file of this rank. */
    void
    write_as_vtu(const FieldTable  &table,
                 const std::string &folder,
                 const double       time,
                 const MPI_Comm     comm) const;

    /** Appends the .vtu files of all ranks to the time series base.pvd. They must
     *  already be written. */
    void
    record_vtu(const FieldTable  &table,
               const std::string &folder,
               const double       time,
               const MPI_Comm     comm);

    /** Writes the data of all ranks to one .h5 file. @param problem error message of
     *  this rank; if not empty, nothing is written */
    void
    write_as_hdf5(const FieldTable  &table,
                  const std::string &folder,
                  const double       time,
                  const MPI_Comm     comm,
                  std::string       &problem);

    /** Writes the XDMF index of all .h5 files of the time series, with the columns of
     *  @p table. */
    void
    write_xdmf(const FieldTable &table, const std::string &folder) const;
    void
    write_vtkhdf(const FieldTable &table, const std::string &folder) const;

    /** Entry of the XDMF index for one .h5 file. */
    struct Hdf5State
    {
      double      time;
      std::string file;
      std::size_t n_nodes; ///< summed over all ranks

      void
      state(StateRow &row)
      {
        row(time, file, n_nodes);
      }
    };

    const std::string  base;
    const FieldsFormat format;
    unsigned int       number = 0;

    /** Times and file names of the time series, stored on the first rank. */
    std::vector<std::pair<double, std::string>> vtu;
    std::vector<Hdf5State>                      hdf5;
  };
} // namespace geocone::GEOCONE_DIM

#endif
