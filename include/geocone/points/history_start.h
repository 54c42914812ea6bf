// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_history_start_h
#define geocone_points_history_start_h

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/materials/constitutive_law.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Initialises the history variables of material points from their stresses.
   *  Errors and remarks of the constitutive laws are collected. */
  class HistoryStart
  {
  public:
    /** Initialises the history variables of a material point at @p place. */
    void
    set(const ConstitutiveLaw         &law,
        const ConstitutiveLaw::Stress &stress,
        const double                   size,
        const dealii::Point<dim>      &place,
        double                        *history)
    {
      try
        {
          law.initialise_at(place, history);
          const std::string remark = law.initialise(stress, size, history);
          if (!remark.empty() && n_changed++ == 0)
            change = remark;
        }
      catch (const InputError &error)
        {
          refuse(error.what() +
                 format("\n  at:      the point (%g, %g)", place[0], place[1]));
        }
    }

    /** Stores the reason why a material point is rejected. Only the first reason
     *  is reported. */
    void
    refuse(const std::string &why)
    {
      if (refusal.empty())
        refusal = why;
    }

    bool
    is_refused() const
    {
      return !refusal.empty();
    }

    /** Throws an exception of type Error if a material point was rejected on
     *  any rank. Collective.
     *  @throws Error */
    template <typename Error>
    void
    check(const MPI_Comm comm) const
    {
      const std::string why = text_of_any_rank(comm, refusal);
      if (!why.empty())
        throw Error(why);
    }

    /** Appends a remark to the list @p remarks if the constitutive laws
     *  modified the initial states of material points. Collective. */
    void
    remark(const MPI_Comm comm, std::vector<std::string> &remarks) const
    {
      const std::string   first = text_of_any_rank(comm, change);
      const unsigned long n     = dealii::Utilities::MPI::sum(n_changed, comm);
      if (n > 0)
        remarks.push_back(format("%lu points: ", n) + first);
    }

  private:
    unsigned long n_changed = 0;
    std::string   change, refusal;
  };
} // namespace geocone::GEOCONE_DIM

#endif
