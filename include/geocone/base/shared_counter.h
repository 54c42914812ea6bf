// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_shared_counter_h
#define geocone_base_shared_counter_h

#include <mpi.h>

namespace geocone
{
  /** Counter of all ranks, by which they take pieces of work that differ in cost: each
   *  number is given to one rank only. Construction and destruction are collective. */
  class SharedCounter
  {
  public:
    /** @param first number that is given */
    SharedCounter(const MPI_Comm comm, const unsigned int first)
    {
      int rank;
      MPI_Comm_rank(comm, &rank);
      MPI_Win_allocate(rank == 0 ? sizeof(unsigned int) : 0,
                       sizeof(unsigned int),
                       MPI_INFO_NULL,
                       comm,
                       &next_of_first,
                       &window);
      if (rank == 0)
        {
          MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window);
          *next_of_first = first;
          MPI_Win_unlock(0, window);
        }
      MPI_Barrier(comm);
    }
    SharedCounter(const SharedCounter &) = delete;
    SharedCounter &
    operator=(const SharedCounter &) = delete;
    ~SharedCounter()
    {
      MPI_Win_free(&window);
    }

    /** Takes the next number. */
    unsigned int
    take()
    {
      const unsigned int one = 1;
      unsigned int       number;
      MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, window);
      MPI_Fetch_and_op(&one, &number, MPI_UNSIGNED, 0, 0, MPI_SUM, window);
      MPI_Win_unlock(0, window);
      return number;
    }

  private:
    MPI_Win       window;
    unsigned int *next_of_first = nullptr;
  };
} // namespace geocone

#endif
