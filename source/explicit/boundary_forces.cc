// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/explicit/boundary_forces.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  BoundaryForces::BoundaryForces(const Scene          &scene,
                                 const BackgroundMesh &mesh,
                                 const Space          &space)
    : scene(scene)
    , mesh(mesh)
    , space(space)
    , has_tractions(!scene.tractions.list.empty())
  {
    follow_ranks();
  }

  void
  BoundaryForces::follow_ranks()
  {
    StateRow places;
    if (moving)
      moving->state(places);
    moving = std::make_unique<MovingLoads>(scene, mesh, space);
    if (StateRow row(places.values()); !row.at_end())
      moving->state(row);
    absorbing =
      std::make_unique<AbsorbingBoundary>(scene, mesh, space, nullptr);
    for (Vector *vector : {&tractions, &coefficient, &incoming})
      vector->reinit(space.partitioner());
    bool oblique = false;
    for (const AbsorbingBoundary::Dashpot &dashpot : absorbing->all())
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double C = dashpot.C[d][d];
          coefficient.local_element(dim * dashpot.node + d) += C;
          for (unsigned int e = 0; e < dim; ++e)
            oblique =
              oblique || (e != d && std::abs(dashpot.C[d][e]) > 1e-9 * C);
        }
    if (Utilities::MPI::logical_or(oblique,
                                   mesh.triangulation().get_communicator()))
      throw InputError(scene.absorbing.list[0]->parameter("Sides"),
                       scene.absorbing.list[0]->part(),
                       "sides along the axes, not at their corners, with "
                       "explicit MPM",
                       "leave the last nodes out by a Box, or set "
                       "Discretisation/Method = MPM");
    // Values that stay zero are also read.
    for (Vector *vector : {&tractions, &coefficient, &incoming})
      vector->update_ghost_values();
  }

  void
  BoundaryForces::begin_step(const double t)
  {
    if (has_tractions)
      {
        tractions.zero_out_ghost_values();
        tractions = 0.;
        moving->add_forces(tractions, {}, t);
        tractions.update_ghost_values();
      }
    if (absorbing->exists())
      {
        incoming.zero_out_ghost_values();
        absorbing->incoming_force(t, incoming);
        incoming.update_ghost_values();
      }
  }

  void
  BoundaryForces::add_tractions(GridTransfer &nodes) const
  {
    for (unsigned int i = 0; i < nodes.n_nodes() && has_tractions; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        nodes.write[node_size * i + change_of_node + d] +=
          tractions.local_element(dim * i + d);
  }

  BoundaryForces::Done
  BoundaryForces::add_dashpots(
    GridTransfer                     &nodes,
    const double                      dt,
    const double                      least_mass,
    const std::vector<unsigned char> &is_prescribed) const
  {
    Done               done;
    const unsigned int n_owned = space.n_owned_nodes();
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int dof = dim * i + d;
          const double       T   = tractions.local_element(dof),
                       C         = coefficient.local_element(dof);
          const double m         = nodes.mass[i];
          if ((T == 0. && C == 0.) || !(m > least_mass))
            continue;
          double      &f = nodes.write[node_size * i + change_of_node + d];
          const double v = nodes.read[node_size * i + d];
          double mean = v, D = 0.; // of held nodes, which are at rest mostly
          if (!is_prescribed[dof])
            {
              const double in   = incoming.local_element(dof),
                           half = dt / (2. * m);
              mean              = (v + half * (f + in)) / (1. + half * C);
              D                 = in - C * mean;
              f += D;
            }
          if (i < n_owned)
            {
              done.work += dt * (T + D) * mean;
              done.impulse[d] += dt * (T + D);
            }
        }
    return done;
  }

  void
  BoundaryForces::move(const GridTransfer &nodes, const double dt)
  {
    if (!has_tractions)
      return;
    Vector v(space.partitioner());
    for (unsigned int i = 0; i < space.n_owned_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        v.local_element(dim * i + d) = nodes.read[node_size * i + d];
    v.update_ghost_values();
    moving->move({}, v, dt);
  }
} // namespace geocone::GEOCONE_DIM
