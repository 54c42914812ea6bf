// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/points/rank_balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_rank_balance[] = {
      {"Material point method/Largest imbalance",
       "Discretisation/Method",
       {"MPM", "explicit MPM"}}};
  } // namespace

  RankBalance::RankBalance()
    : ParameterAcceptor("/Material point method")
  {
    add_parameter(
      "Largest imbalance",
      largest,
      "Largest ratio of the particles of a rank to the mean over the ranks "
      "[-], >= 1; beyond it cells are redistributed. (Explicit steps on a "
      "uniform grid are rebalanced by columns whenever points are sorted.)");
  }

  void
  RankBalance::prepare() const
  {
    if (!(largest >= 1.))
      throw InputError("Material point method/Largest imbalance",
                       largest,
                       ">= 1, the fullest rank beside the mean",
                       "1.2 is usual; 1000 leaves all cells where they are");
  }

  bool
  RankBalance::is_due(const double n_particles, const MPI_Comm comm) const
  {
    return Utilities::MPI::n_mpi_processes(comm) > 1 &&
           imbalance(n_particles, comm) > std::max(largest, 1.1 * least);
  }

  void
  RankBalance::repartition(std::vector<unsigned int> n_in_cell,
                           BackgroundMesh           &mesh,
                           Space                    &space)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    sum_over_ranks(n_in_cell, comm);
    const auto particles_in = [&](const BackgroundMesh::Cell &cell) {
      return n_in_cell[cell->active_cell_index()];
    };
    // Empty cells are almost free but have an owner.
    mesh.repartition([&](const BackgroundMesh::Cell &cell) {
      return 1 + 100 * particles_in(cell);
    });
    double n_cells = 0., n_particles = 0.;
    for (const auto &cell : mesh.own_cells())
      {
        ++n_cells;
        n_particles += particles_in(cell);
      }
    least = imbalance(n_particles, comm);
    if (Utilities::MPI::min(n_cells, comm) == 0.)
      {
        // Too few cells, an idle rank: returns to the initial partition for
        // good.
        mesh.repartition([](const BackgroundMesh::Cell &) { return 1; });
        least = std::numeric_limits<double>::infinity();
      }
    space.follow_ranks();
    ++n;
  }
} // namespace geocone::GEOCONE_DIM
