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
   * The state of a run as a file of named arrays (HDF5), which any number of ranks
   * can read. Written whole by the first rank, which holds it in memory; with a
   * checksum over all arrays, so that a damaged file is found before any of it is
   * used. Or without a file, to hand state over between the ranks of a run: each of
   * them then holds all that is written. All functions are collective.
   */
  class Archive
  {
  public:
    /** A new one, with the digest of the run that it belongs to. */
    Archive(const MPI_Comm     comm,
            const std::string &file_name,
            const std::string &run);

    /** A new one without a file, read by the ranks that write it. */
    explicit Archive(const MPI_Comm comm);

    /**
     * @return one to be read, or nothing
     * @param why_not is set to what is wrong with the file
     */
    static std::unique_ptr<Archive>
    open(const MPI_Comm     comm,
         const std::string &file_name,
         const std::string &run,
         std::string       &why_not);

    /** The arrays of all ranks, one after another. */
    void
    write(const std::string &name, const std::vector<double> &of_this_rank);

    /** Variables that all ranks have alike. */
    void
    write_row(const std::string &name, const StateRow &row);

    /** Writes the file. @throws RunError, on all ranks */
    void
    close();

    bool
    has(const std::string &name) const;

    /** An array of all ranks, on each of them. */
    std::vector<double>
    read(const std::string &name) const;

    /** What this rank has written, or about as many of the array, in whole
     *  records of @p size numbers, where the number of ranks has changed. */
    std::vector<double>
    read_part(const std::string &name, const std::size_t size) const;

    /** The number of ranks that have written an array. */
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

    /** On the first rank, or on all where it is read. */
    std::unique_ptr<Hdf5File> file;

    /** The arrays, where there is no file. */
    std::map<std::string, std::vector<double>> arrays;
  };
} // namespace geocone

#endif
