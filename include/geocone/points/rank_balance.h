// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_rank_balance_h
#define geocone_points_rank_balance_h

#include <geocone/space/space.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Redistributes cells over the ranks, so that each has about the same number
   *  of particles. */
  class RankBalance : public dealii::ParameterAcceptor
  {
  public:
    RankBalance();

    /** @throws InputError */
    void
    prepare() const;

    /** Whether the imbalance exceeds the tolerance. @param n_particles of this
     *  rank. Collective. */
    bool
    is_due(const double n_particles, const MPI_Comm comm) const;

    /** Redistributes the cells by their numbers of particles; nodes are
     *  renumbered.
     *  @param n_in_cell on this rank, by active cell index. Collective. */
    void
    repartition(std::vector<unsigned int> n_in_cell,
                BackgroundMesh           &mesh,
                Space                    &space);

    /** Number of repartitions so far. */
    unsigned int
    n_repartitions() const
    {
      return n;
    }

  private:
    /** Tolerated imbalance(), and the imbalance that the last repartition could
     *  not remove, since cells are not divided. */
    double       largest = 1.2, least = 1.;
    unsigned int n = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
