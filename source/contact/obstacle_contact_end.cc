// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact with obstacles at the end of a step: forces and reactions of the solution,
// motion of the obstacles, and bonds.
#include <geocone/base/over_ranks.h>
#include <geocone/contact/obstacle_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  Tensor<1, dim>
  ObstacleContact::force(const Contact &contact, const unsigned int i)
  {
    return contact.free_part(contact.nodal_contacts()[i].force,
                             contact.nodes()[i].node);
  }

  ContactReport
  ObstacleContact::report(const Contact &contact,
                          const Vector  &v,
                          const double   h) const
  {
    // Open, stick, slip, work, dissipation, width, size of F, sticking width,
    // work of rebounds; error, penetration, pressure, shear.
    std::array<double, 9> sums  = {};
    std::array<double, 4> most  = {};
    const auto           &nodes = contact.nodes();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const unsigned int node = nodes[i].node;
        if (node >= space.n_owned_nodes())
          continue;
        const Contact::NodalContact &nodal_contact =
          contact.nodal_contacts()[i];
        ++sums[nodal_contact.state == Contact::State::open    ? 0
               : nodal_contact.state == Contact::State::stick ? 1
                                                              : 2];
        const Tensor<1, dim> u        = value_at(v, node),
                             relative = u - nodes[i].velocity;
        most[0]                       = std::max(most[0], nodal_contact.error);
        sums[6] += nodal_contact.size;
        const double         s = nodes[i].free_part_of_normal();
        const Tensor<1, dim> n = s * nodes[i].whole(nodes[i].normal);
        // Final gap from the initial one, -least h, unless the node rebounds.
        if (!nodes[i].rebounds)
          most[1] = std::max(
            most[1],
            -h * s *
              (nodal_contact.relative * nodes[i].normal - nodes[i].least));
        if (!contact.carries_load(i))
          continue;
        const Tensor<1, dim> free = force(contact, i), r = nodes[i].whole(free);
        // Vertices of quadratic tetrahedra have no tributary area.
        if (const double l = nodes[i].length;
            mesh_is_body && l > 0. &&
            nodal_contact.state != Contact::State::open)
          {
            sums[5] += l;
            if (nodal_contact.state == Contact::State::stick)
              sums[7] += l;
            const double pressure = (r * n) / l;
            most[2]               = std::max(most[2], pressure);
            most[3] = std::max(most[3], (r / l - pressure * n).norm());
          }
        // The work of a pair of bodies is the dissipation by friction and
        // impact. That of the part in supports is in their work.
        sums[3] += h * (free * (nodes[i].touches_body() ? relative : u));
        sums[4] -= h * (r * relative);
        if (nodes[i].impact < 0.)
          sums[8] += h * (r * n) * (nodes[i].impact - relative * n) / 2.;
      }
    sum_over_ranks(sums, comm);
    Utilities::MPI::max(ArrayView<const double>(most.data(), most.size()),
                        comm,
                        ArrayView<double>(most.data(), most.size()));
    ContactReport report;
    report.open        = sums[0];
    report.stick       = sums[1];
    report.slip        = sums[2];
    report.work        = sums[3];
    report.dissipation = sums[4];
    report.error       = sums[6] > 0. ? most[0] / sums[6] : 0.;
    report.penetration = most[1];
    report.width       = sums[5];
    report.stick_width = sums[7];
    report.of_rebound  = sums[8];
    report.pressure    = most[2];
    report.shear       = most[3];
    return report;
  }

  std::vector<Reaction>
  ObstacleContact::reactions(const Contact &contact) const
  {
    const auto           &list = scene.obstacles.list;
    const unsigned int    n    = list.size() + scene.contacts.list.size();
    std::vector<Reaction> result(n);
    const auto           &nodes = contact.nodes();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        if (nodes[i].node >= space.n_owned_nodes() || !contact.carries_load(i))
          continue;
        const Tensor<1, dim> r     = nodes[i].whole(force(contact, i));
        const unsigned int   o     = nodes[i].obstacle;
        const Point<dim>     about = scene.observation.moment_centre().value_or(
          nodes[i].touches_body() ? Point<dim>() : centre(o));
        for (unsigned int d = 0; d < dim; ++d)
          result[o].add(place(nodes[i].node) - about, d, r[d]);
      }
    sum_states_over_ranks(result, comm);
    return result;
  }

  void
  ObstacleContact::relieve_supports(const Contact  &contact,
                                    const Unknowns &unknowns,
                                    Vector         &reaction)
  {
    for (unsigned int i = 0; i < contact.nodes().size(); ++i)
      if (const ContactNode &at = contact.nodes()[i];
          contact.is_owned(at) && contact.carries_load(i))
        {
          const Tensor<1, dim> r = at.whole(force(contact, i));
          for (unsigned int d = 0; d < dim; ++d)
            if (unknowns.is_prescribed(dim * at.node + d))
              reaction.local_element(dim * at.node + d) -= r[d];
        }
  }

  double
  ObstacleContact::settle(const Contact  &contact,
                          const Unknowns &unknowns,
                          const Vector   &v,
                          const Vector   &mass,
                          Vector         &v_end) const
  {
    const auto &nodes = contact.nodes();
    // Includes contacts and masses of other ranks, for the same result on all
    // ranks.
    Vector closed_nodes(space.partitioner()), of_impulse(space.partitioner());
    for (unsigned int dof = 0; dof < of_impulse.locally_owned_size(); ++dof)
      if (unknowns.is_free(dof))
        of_impulse.local_element(dof) = 1. / mass.local_element(dof);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].node < space.n_owned_nodes())
        closed_nodes.local_element(dim * nodes[i].node + nodes[i].is_second) =
          contact.nodal_contacts()[i].state == Contact::State::open    ? 0.
          : contact.nodal_contacts()[i].state == Contact::State::stick ? 2.
                                                                       : 1.;
    closed_nodes.update_ghost_values();
    of_impulse.update_ghost_values();
    v.update_ghost_values();
    v_end.update_ghost_values();

    double lost = 0.;
    for (const ContactNode &at : nodes)
      {
        const double state =
          closed_nodes.local_element(dim * at.node + at.is_second);
        if (state == 0.)
          continue;
        std::vector<Tensor<1, dim>> axes = {at.whole(at.normal)};
        if (state == 2.)
          axes.insert(axes.end(),
                      at.tangents.begin(),
                      at.tangents.begin() + at.n_tangents);
        for (const Tensor<1, dim> &along : axes)
          {
            // Relative velocity along the axis: solved, extrapolated, and per
            // unit impulse.
            double solved = 0., end = 0., mobility = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int dof = dim * at.node + d;
                solved += (v.local_element(dof) - at.velocity[d]) * along[d];
                end += v_end.local_element(dof) * along[d];
                mobility += along[d] * along[d] * of_impulse.local_element(dof);
                if (!at.touches_body())
                  end -= at.velocity[d] * along[d];
                for (const ContactNode::Partner &other : at.partners)
                  {
                    const unsigned int its = dim * other.node + d;
                    end -= other.part * v_end.local_element(its) * along[d];
                    mobility += std::pow(other.part * along[d], 2) *
                                of_impulse.local_element(its);
                  }
              }
            if (std::abs(end) <= std::abs(solved) || mobility == 0.)
              continue;
            const double impulse = (solved - end) / mobility;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int dof = dim * at.node + d;
                v_end.local_element(dof) +=
                  impulse * along[d] * of_impulse.local_element(dof);
                for (const ContactNode::Partner &other : at.partners)
                  v_end.local_element(dim * other.node + d) -=
                    impulse * other.part * along[d] *
                    of_impulse.local_element(dim * other.node + d);
              }
            if (at.node < space.n_owned_nodes())
              lost -= impulse * (solved + end) / 2.;
          }
      }
    v_end.zero_out_ghost_values();
    return Utilities::MPI::sum(lost, comm);
  }

  void
  ObstacleContact::add_displacements(
    const Contact               &contact,
    const Vector                &v,
    const double                 h,
    const unsigned int           first,
    std::vector<Tensor<1, dim>> &supports) const
  {
    const unsigned int n_obstacles = displacement.size(),
                       n_pairs     = scene.contacts.list.size();
    for (unsigned int o = 0; o < n_obstacles; ++o)
      supports[first + o] += h * contact.motions().velocities()[o].centre;
    if (n_pairs == 0)
      return;
    std::vector<double> sums((dim + 1) * n_pairs, 0.);
    const auto         &nodes = contact.nodes();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].touches_body() && nodes[i].node < space.n_owned_nodes() &&
          contact.nodal_contacts()[i].state != Contact::State::open)
        {
          double *own = &sums[(dim + 1) * (nodes[i].obstacle - n_obstacles)];
          for (unsigned int d = 0; d < dim; ++d)
            own[d] +=
              nodes[i].length *
              (v.local_element(dim * nodes[i].node + d) - nodes[i].velocity[d]);
          own[dim] += nodes[i].length;
        }
    sum_over_ranks(sums, comm);
    for (unsigned int k = 0; k < n_pairs; ++k)
      if (const double *own = &sums[(dim + 1) * k]; own[dim] > 0.)
        for (unsigned int d = 0; d < dim; ++d)
          supports[first + n_obstacles + k][d] += h * own[d] / own[dim];
  }

  void
  ObstacleContact::commit(const Contact &contact,
                          const Vector  &v,
                          const double   h,
                          const double   solved_h,
                          const bool     moves)
  {
    for (unsigned int o = 0; o < displacement.size(); ++o)
      {
        const RigidMotion &solved        = contact.motions().velocities()[o];
        const double       extrapolation = h / solved_h;
        if (moves)
          displacement[o].add({h * solved.centre, h * solved.rotation});
        for (unsigned int k = 0; k < RigidMotion::n_components; ++k)
          velocity[o][k] =
            extrapolation * solved[k] - (extrapolation - 1.) * velocity[o][k];
      }
    if (!moves)
      return;
    if (mesh_is_body && exists())
      {
        nodal_displacement.zero_out_ghost_values();
        nodal_displacement.add(h, v);
        nodal_displacement.update_ghost_values();
        check_held(contact, v, h);
      }
    if (mesh_is_body && has_bonds())
      {
        bonds.zero_out_ghost_values();
        bonds = 0.;
        for (unsigned int i = 0; i < contact.nodes().size(); ++i)
          if (const ContactNode &at = contact.nodes()[i];
              contact.is_owned(at) &&
              contact.nodal_contacts()[i].state != Contact::State::open)
            bonds.local_element(dim * at.node) = at.obstacle + 1.;
        bonds.update_ghost_values();
      }
  }
} // namespace geocone::GEOCONE_DIM
