// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_rank_balance_h
#define geocone_points_rank_balance_h

#include <geocone/space/space.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Load balancing: redistributes cells over the ranks, so that each rank has
   *  about the same number of particles. */
  class RankBalance : public dealii::ParameterAcceptor
  {
  public:
    RankBalance();

    /** Checks the parameters. @throws InputError */
    void
    prepare() const;

    /** Returns true if the load imbalance in particles per rank exceeds the
     *  tolerance. Collective. @param n_particles number of particles on this
     *  rank */
    bool
    is_due(const double n_particles, const MPI_Comm comm) const;

    /** Redistributes the cells over the ranks, weighted by the number of
     *  particles per cell. Nodes are renumbered.
     *  @param n_in_cell number of particles per cell on this rank, by active
     *  cell index. Collective. */
    void
    repartition(std::vector<unsigned int> n_in_cell,
                BackgroundMesh           &mesh,
                Space                    &space);

    /** Number of repartitions since the start of the run. */
    unsigned int
    n_repartitions() const
    {
      return n;
    }

  private:
    /** Tolerance for the load imbalance, and the imbalance that remained after
     *  the last repartition. The latter exceeds 1 since cells are not
     *  divided. */
    double       largest = 1.2, least = 1.;
    unsigned int n = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
