// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_rank_balance_h
#define geocone_points_rank_balance_h

#include <geocone/space/space.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Hands over cells between ranks, so that each has about as many particles. */
  class RankBalance : public dealii::ParameterAcceptor
  {
  public:
    RankBalance();

    /** @throws InputError */
    void
    prepare() const;

    /** Whether the fullest rank has too many particles. @param n_particles of this rank.
     *  Collective. */
    bool
    is_due(const double n_particles, const MPI_Comm comm) const;

    /** Parts the cells anew, by the particles in them; nodes are numbered anew.
     *  @param n_in_cell that this rank has, by the active cell index. Collective. */
    void
    repartition(std::vector<unsigned int> n_in_cell,
                BackgroundMesh           &mesh,
                Space                    &space);

    /** How often cells were handed over. */
    unsigned int
    n_repartitions() const
    {
      return n;
    }

  private:
    /** What is borne, of imbalance(), and what the last time left, since cells are not
     *  divided. */
    double       largest = 1.2, least = 1.;
    unsigned int n = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
