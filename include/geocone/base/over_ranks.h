// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_over_ranks_h
#define geocone_base_over_ranks_h

#include <geocone/base/exceptions.h>
#include <geocone/base/state_row.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <exception>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace geocone
{
  /** Sums an array over all ranks, in place. The array (std::array,
   *  std::vector, Eigen matrix) must have the same size on all ranks.
   *  Collective. */
  template <typename Array>
  void
  sum_over_ranks(Array &x, const MPI_Comm comm)
  {
    using Number = std::remove_reference_t<decltype(*x.data())>;
    if (x.size() > 0)
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const Number>(x.data(), x.size()),
        comm,
        dealii::ArrayView<Number>(x.data(), x.size()));
  }

  /** Load imbalance: maximum load divided by mean load over all ranks. The
   *  imbalance is 1 if all loads are zero. Collective. */
  inline double
  imbalance(const double of_this_rank, const MPI_Comm comm)
  {
    const double sum     = dealii::Utilities::MPI::sum(of_this_rank, comm),
                 fullest = dealii::Utilities::MPI::max(of_this_rank, comm);
    return sum > 0.
             ? fullest * dealii::Utilities::MPI::n_mpi_processes(comm) / sum
             : 1.;
  }

  /** Calls a function on the first rank. Its errors are thrown on all ranks.
   *  Collective. @param failure what an error other than of input means
   *  @throws InputError */
  template <typename Function>
  void
  on_first_rank(const MPI_Comm     comm,
                const std::string &failure,
                const Function    &function)
  {
    std::string fault;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          function();
        }
      catch (const InputError &error)
        {
          fault = error.what();
        }
      catch (const std::exception &error)
        {
          fault =
            failure + ": " + error.what() +
            "\n  remedy:  take fewer cells, or a machine with more memory";
        }
    fault = dealii::Utilities::MPI::broadcast(comm, fault);
    if (!fault.empty())
      throw InputError(fault);
  }

  /** Returns the place that belongs to the largest of the values of all ranks.
   *  Collective. @param largest of all ranks */
  template <typename Place>
  Place
  place_of_largest(const double   of_this_rank,
                   const double   largest,
                   Place          place,
                   const MPI_Comm comm)
  {
    for (unsigned int d = 0; d < Place::dimension; ++d)
      place[d] = dealii::Utilities::MPI::max(
        of_this_rank == largest ? place[d]
                                : std::numeric_limits<double>::lowest(),
        comm);
    return place;
  }

  /** Sums the state variables of each object in a list over all ranks, in
   *  place. State variables are listed by state(); their number must be equal
   *  on all ranks. Collective. */
  template <typename Class>
  void
  sum_states_over_ranks(std::vector<Class> &list, const MPI_Comm comm)
  {
    StateRow of_rank;
    for (Class &x : list)
      of_rank(x);
    std::vector<double> sums = of_rank.values();
    sum_over_ranks(sums, comm);
    StateRow of_all(std::move(sums));
    for (Class &x : list)
      of_all(x);
  }
} // namespace geocone

#endif
