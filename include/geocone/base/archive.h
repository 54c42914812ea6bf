// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_archive_h
#define geocone_base_archive_h

#include <geocone/base/hdf5_file.h>
#include <geocone/base/state_row.h>

#include <mpi.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Checkpoint of a run, stored as named arrays in an HDF5 file. It can be read
   * on any number of ranks. The first rank buffers the file in memory and
   * writes it in one piece, with a checksum over all arrays, so that a damaged
   * file is detected before any array is used. An archive without a file
   * transfers state between the ranks of a run: each rank then stores all data
   * written. All functions are collective.
   */
  class Archive
  {
  public:
    /** Creates an archive for writing. The digest @p run identifies the
     *  parameters of the run. */
    Archive(const MPI_Comm     comm,
            const std::string &file_name,
            const std::string &run);

    /** Creates an archive in memory, to be read by the ranks that wrote it. */
    explicit Archive(const MPI_Comm comm);

    /**
     * Opens an archive for reading.
     * @param why_not set to the reason why the file cannot be read
     * @return the archive, or null if the file cannot be read
     */
    static std::unique_ptr<Archive>
    open(const MPI_Comm     comm,
         const std::string &file_name,
         const std::string &run,
         std::string       &why_not);

    /** Writes an array, concatenated from the arrays of all ranks in rank
     *  order. */
    void
    write(const std::string &name, const std::vector<double> &of_this_rank);

    /** Writes variables whose values are equal on all ranks. */
    void
    write_row(const std::string &name, const StateRow &row);

    /** Writes the archive to its file on disk. @throws RunError on all ranks */
    void
    close();

    bool
    has(const std::string &name) const;

    /** Returns an array, concatenated over all ranks, on every rank. */
    std::vector<double>
    read(const std::string &name) const;

    /** Returns those entries of an array that were written by this rank. If the
     *  number of ranks has changed, an equal share of the array is returned, in
     *  complete records of @p size numbers each. */
    std::vector<double>
    read_part(const std::string &name, const std::size_t size) const;

    /** Returns the number of ranks that wrote an array. */
    unsigned int
    n_ranks_of(const std::string &name) const;

    StateRow
    read_row(const std::string &name) const;

  private:
    Archive(const MPI_Comm comm, const std::string &file_name);

    void
    add(const std::string &name, const std::vector<double> &values);

    const MPI_Comm    comm;
    const std::string file_name;
    std::string       names;
    unsigned long     checksum = 0;

    /** HDF5 file of the archive. A new file is open on the first rank only,
     *  a file to be read on all ranks. */
    std::unique_ptr<Hdf5File> file;

    /** Named arrays of an archive that is kept in memory, without a file. */
    std::map<std::string, std::vector<double>> arrays;
  };
} // namespace geocone

#endif
