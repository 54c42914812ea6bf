// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/mechanics/particle_contact.h>
#include <geocone/mechanics/point_functions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  using namespace dealii;

  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Obstacles                &obstacles,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space)
  {
    std::vector<Vector> all(obstacles.list.size());
    for (unsigned int o = 0; o < all.size(); ++o)
      {
        all[o].reinit(space.partitioner());
        for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
          all[o].local_element(dim * node) = 1e300;
        for_each_point(points,
                       [&](const unsigned int p,
                           const unsigned int /* cell */,
                           const PointFunctions &at) {
                         const double half = length_of(points.weight[p]) / 2.;
                         const double gap =
                           obstacles.list[o]
                             ->nearest(points.position[p], moved[o], {})
                             .distance -
                           half;
                         for (unsigned int i = 0; i < at.n; ++i)
                           if (at.N[i] > 1e-12)
                             {
                               double &least =
                                 all[o].local_element(dim * at.nodes[i]);
                               least = std::min(least, gap);
                             }
                       });
        all[o].compress(VectorOperation::min);
        all[o].update_ghost_values();
      }
    return all;
  }

  void
  check_particles_outside(const MaterialPoints &points,
                          const Obstacles      &obstacles,
                          const MPI_Comm        comm)
  {
    for (const auto &obstacle : obstacles.list)
      {
        double least = 1e300;
        for (const Point<dim> &x : points.position)
          least = std::min(least, obstacle->nearest(x, {}, {}).distance);
        least = Utilities::MPI::min(least, comm);
        if (!(least > 0.))
          obstacle->refuse_overlap(
            format("a particle is %.3g m inside it", -least));
      }
  }
} // namespace geocone
