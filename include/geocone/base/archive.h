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
   * State of a run as a file of named arrays (HDF5), independent of the number
   * of ranks. The first rank holds it in memory and writes it in one piece,
   * with a checksum over all arrays, so that a damaged file is detected before
   * any of it is used. Without a file it transfers state between the ranks of a
   * run: each of them then holds all data written. All functions are
   * collective.
   */
  class Archive
  {
  public:
    /** A new archive, with the digest of the run that it belongs to. */
    Archive(const MPI_Comm     comm,
            const std::string &file_name,
            const std::string &run);

    /** A new archive without a file, read by the ranks that write it. */
    explicit Archive(const MPI_Comm comm);

    /**
     * @return an archive to be read, or null
     * @param why_not is set to the reason why the file cannot be read
     */
    static std::unique_ptr<Archive>
    open(const MPI_Comm     comm,
         const std::string &file_name,
         const std::string &run,
         std::string       &why_not);

    /** Writes the concatenated arrays of all ranks. */
    void
    write(const std::string &name, const std::vector<double> &of_this_rank);

    /** Writes variables that are equal on all ranks. */
    void
    write_row(const std::string &name, const StateRow &row);

    /** Writes the file. @throws RunError, on all ranks */
    void
    close();

    bool
    has(const std::string &name) const;

    /** The concatenated array of all ranks, on each of them. */
    std::vector<double>
    read(const std::string &name) const;

    /** The entries that this rank has written. If the number of ranks has
     *  changed, an equal share of the array instead, in complete records of
     *  @p size numbers. */
    std::vector<double>
    read_part(const std::string &name, const std::size_t size) const;

    /** Number of ranks that have written an array. */
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

    /** File of the first rank or, while reading, of all ranks. */
    std::unique_ptr<Hdf5File> file;

    /** The arrays of an archive without a file. */
    std::map<std::string, std::vector<double>> arrays;
  };
} // namespace geocone

#endif
