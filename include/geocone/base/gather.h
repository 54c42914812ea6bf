// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_gather_h
#define geocone_base_gather_h

#include <mpi.h>

#include <algorithm>
#include <type_traits>
#include <vector>

namespace geocone
{
  /**
   * Concatenates the arrays of all ranks on the first rank, in rank order. On
   * all other ranks, the result is empty. Collective. Only the first rank
   * stores more than its own part.
   */
  template <typename T>
  std::vector<T>
  gather(const std::vector<T> &part, const MPI_Comm comm)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    int rank, n_ranks;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
    if (n_ranks == 1)
      return part;
    const unsigned long long        n = part.size();
    std::vector<unsigned long long> sizes(n_ranks);
    MPI_Gather(&n,
               1,
               MPI_UNSIGNED_LONG_LONG,
               sizes.data(),
               1,
               MPI_UNSIGNED_LONG_LONG,
               0,
               comm);
    MPI_Datatype item;
    MPI_Type_contiguous(sizeof(T), MPI_BYTE, &item);
    MPI_Type_commit(&item);
    std::vector<T> all;
    if (rank == 0)
      {
        unsigned long long place = n;
        for (int r = 1; r < n_ranks; ++r)
          place += sizes[r];
        all.resize(place);
        std::copy(part.begin(), part.end(), all.begin());
        place = n;
        for (int r = 1; r < n_ranks; place += sizes[r++])
          MPI_Recv(&all[place], sizes[r], item, r, 0, comm, MPI_STATUS_IGNORE);
      }
    else
      MPI_Send(part.data(), n, item, 0, 0, comm);
    MPI_Type_free(&item);
    return all;
  }
} // namespace geocone

#endif
