// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/contact/obstacle_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Gap in a corner of particles that counts as closed, over the size of a
     *  cell: their squares change with their volume. */
    constexpr double nearly_closed = 1e-3;

    constexpr char of_corner[] = "\n  remedy:  hold one of the sides by a "
                                 "boundary condition, or leave the "
                                 "corner out of the body";

    /** Sets the impact of a node that approaches faster than u_N = least. */
    void
    rebound(const double u_n, const InterfaceLaw &law, ContactNode &node)
    {
      if (!node.rebounds || u_n >= 0. || u_n >= node.least)
        return;
      node.impact = u_n;
      node.least  = -law.restitution * u_n;
    }
  } // namespace

  ObstacleContact::ObstacleContact(const Scene          &scene,
                                   const BackgroundMesh &mesh,
                                   const Space          &space,
                                   const Unknowns       *supports)
    : scene(scene)
    , mesh(mesh)
    , space(space)
    , comm(mesh.triangulation().get_communicator())
    , mesh_is_body(supports != nullptr)
    , supports(supports)
    , displacement(scene.obstacles.list.size())
    , velocity(scene.obstacles.list.size())
  {
    if (!exists())
      return;
    const auto &list = scene.obstacles.list;
    size             = 1e300;
    for (const auto &cell : mesh.own_cells())
      size = std::min(size, cell->diameter());
    size = Utilities::MPI::min(size, comm);
    if (const std::string overlap =
          scene.obstacles.overlap_of_free(displacement, margin());
        !overlap.empty())
      throw InputError("Obstacles/Names",
                       list.front()->name,
                       "free obstacles that do not overlap with others",
                       overlap + ": move it, or make one body of both");
    if (!mesh_is_body)
      {
        for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
          candidates.push_back(node);
        return;
      }

    nodal_displacement.reinit(space.partitioner());
    nodal_displacement.update_ghost_values(); // zero ghost values are read
    if (has_bonds())
      {
        bonds.reinit(space.partitioner());
        bonds.update_ghost_values();
      }
    if (!scene.contacts.list.empty())
      bodies.emplace(scene, mesh, space).check_start([this](const auto node) {
        return place(node);
      });
  }

  void
  ObstacleContact::set_body_cells(
    const std::vector<BackgroundMesh::Cell> &cells)
  {
    if (!exists())
      return;
    using Cell                       = BackgroundMesh::Cell;
    const std::vector<bool> is_there = mesh.marked_cells(cells);
    const auto is_bare = [&](const Cell &cell, const unsigned int f) {
      return is_there[cell->active_cell_index()] &&
             (cell->face(f)->at_boundary() ||
              !is_there[cell->neighbor(f)->active_cell_index()]);
    };
    candidates = space.nodes_on_faces(is_bare);
    sides.emplace(space);
    Vector                               of_body(space.partitioner());
    std::vector<types::global_dof_index> nodes;
    for (const Cell &cell : cells)
      {
        for (const unsigned int f : cell->face_indices())
          if (is_bare(cell, f))
            sides->add(points_on_face(mesh, space, cell, f));
        space.cell_nodes(cell, nodes);
        for (const types::global_dof_index node : nodes)
          for (unsigned int d = 0; d < dim; ++d)
            of_body.local_element(dim * space.local_node(node) + d) += 1.;
      }
    sides->exchange();
    of_body.compress(VectorOperation::add);
    of_body.update_ghost_values();
    std::vector<unsigned int> come;
    for (const unsigned int node : candidates)
      if (had_cells.empty() || !had_cells[node])
        come.push_back(node);
    had_cells.resize(space.n_local_nodes());
    for (unsigned int node = 0; node < had_cells.size(); ++node)
      had_cells[node] = of_body.local_element(dim * node) > 0.;
    for (Vector *const of_nodes : {&nodal_displacement, &bonds})
      if (of_nodes->size() > 0)
        {
          of_nodes->zero_out_ghost_values();
          for (unsigned int i = 0; i < of_body.locally_owned_size(); ++i)
            if (of_body.local_element(i) == 0.)
              of_nodes->local_element(i) = 0.;
          of_nodes->update_ghost_values();
        }
    check_overlap(come);
  }

  void
  ObstacleContact::check_overlap(const std::vector<unsigned int> &nodes) const
  {
    const auto         &list = scene.obstacles.list;
    std::vector<double> least(list.size(), 0.);
    for (unsigned int o = 0; o < list.size(); ++o)
      {
        for (const unsigned int node : nodes)
          least[o] = std::min(
            least[o],
            list[o]->nearest(place(node), displacement[o], {}).distance);
        least[o] = Utilities::MPI::min(least[o], comm);
        if (least[o] < -closed_gap * size)
          list[o]->refuse_overlap(
            format("it is penetrated by %.3g m", -least[o]));
      }
  }

  Point<dim>
  ObstacleContact::place(const unsigned int node) const
  {
    Point<dim> x = space.node_positions()[node];
    if (mesh_is_body)
      x += value_at(nodal_displacement, node);
    return x;
  }

  bool
  ObstacleContact::is_prescribed(const unsigned int    node,
                                 const Tensor<1, dim> &normal) const
  {
    Tensor<1, dim> free;
    for (unsigned int d = 0; d < dim; ++d)
      if (supports->is_free(dim * node + d))
        free[d] = normal[d];
    return free.norm() < least_free_component;
  }

  ContactStep
  ObstacleContact::begin(const Vector              &velocity_n,
                         const double               t,
                         const double               h,
                         const double               solved_h,
                         const std::vector<Vector> &gaps,
                         std::vector<FacingNode>    facing) const
  {
    const double solved_at = t + solved_h;
    const auto  &list      = scene.obstacles.list;
    if (const std::string overlap =
          scene.obstacles.overlap_of_free(displacement, margin());
        !overlap.empty())
      throw StepFailure(overlap + "\n  remedy:  end the loading before they "
                                  "meet, or let the soil part them");
    ContactStep step;
    step.bodies.resize(list.size());
    for (unsigned int o = 0; o < list.size(); ++o)
      {
        const Obstacle &obstacle = *list[o];
        ObstacleBody   &body     = step.bodies[o];
        body.without_contact     = obstacle.velocity(solved_at);
        RigidMotion force        = obstacle.load(solved_at);
        force.centre += obstacle.inertia(0) * scene.gravity.at(solved_at);
        for (unsigned int k = 0; k < RigidMotion::n_components; ++k)
          if (obstacle.is_free(k))
            {
              body.is_free[k]    = true;
              body.inertia[k]    = obstacle.inertia(k) / solved_h;
              body.velocity_n[k] = velocity[o][k];
              body.without_contact[k] =
                velocity[o][k] + force[k] / body.inertia[k];
            }
      }
    NearBodies near;
    if (!scene.contacts.list.empty())
      {
        step.has_pairs = true;
        if (mesh_is_body)
          facing = find_facing(velocity_n, h);
        near = near_bodies(velocity_n, h, facing);
      }
    add_nodes(velocity_n, h, gaps, near, step);
    return step;
  }

  std::vector<FacingNode>
  ObstacleContact::find_facing(const Vector &velocity_n, const double h) const
  {
    double fastest = 0.;
    for (const unsigned int node : candidates)
      fastest = std::max(fastest, value_at(velocity_n, node).norm());
    fastest = Utilities::MPI::max(fastest, comm);
    return bodies->find([this](const unsigned int node) { return place(node); },
                        4. * h * fastest);
  }

  double
  ObstacleContact::closable_gap(const double h, const double u_n) const
  {
    return (mesh_is_body ? closed_gap : nearly_closed) * size +
           2. * h * std::abs(u_n);
  }

  bool
  ObstacleContact::has_bonds() const
  {
    const auto is_bonded = [](const auto &one) {
      return one->law.tension > 0.;
    };
    const auto &obstacles = scene.obstacles.list;
    const auto &contacts  = scene.contacts.list;
    return std::any_of(obstacles.begin(), obstacles.end(), is_bonded) ||
           std::any_of(contacts.begin(), contacts.end(), is_bonded);
  }

  void
  ObstacleContact::apply_law(const InterfaceLaw &law, ContactNode &node) const
  {
    node.friction = law.friction;
    node.adhesion = law.adhesion * node.length;
    node.rebounds = law.restitution > 0.;
    if (law.tension > 0. &&
        (node.is_closed ||
         bonds.local_element(dim * node.node) == node.obstacle + 1.))
      node.tension = law.tension * node.length;
  }

  ObstacleContact::NearBodies
  ObstacleContact::near_bodies(const Vector                  &velocity_n,
                               const double                   h,
                               const std::vector<FacingNode> &facing) const
  {
    NearBodies near;
    for (const FacingNode &at : facing)
      {
        ContactNode          contact = at.node;
        const Tensor<1, dim> v       = value_at(velocity_n, contact.node);
        Tensor<1, dim>       u       = v;
        for (const ContactNode::Partner &other : contact.partners)
          u -= other.part * value_at(velocity_n, other.node);
        contact.least           = -at.gap / h;
        contact.is_closed       = at.gap <= closed_gap * size;
        contact.velocity        = v - u;
        const double        u_n = u * contact.normal;
        const InterfaceLaw &law =
          scene.contacts.list[contact.obstacle - scene.obstacles.list.size()]
            ->law;
        apply_law(law, contact);
        rebound(u_n, law, contact);
        near[contact.node] = {contact, at.gap, closable_gap(h, u_n)};
      }
    return near;
  }

  Obstacle::Nearest
  ObstacleContact::nearest(const unsigned int    o,
                           const unsigned int    node,
                           const Tensor<1, dim> &approach,
                           const Neighbours     &others) const
  {
    const Obstacle  &obstacle = *scene.obstacles.list[o];
    const Point<dim> x        = place(node);
    return obstacle.has_small_sliding()
             ? obstacle.nearest_to_start(space.node_positions()[node],
                                         x,
                                         displacement[o],
                                         approach,
                                         &others)
             : obstacle.nearest(x, displacement[o], approach, &others);
  }

  void
  ObstacleContact::check_held(const Contact &contact,
                              const Vector  &v,
                              const double   h) const
  {
    const auto &list   = scene.obstacles.list;
    const auto  others = scene.obstacles.neighbours(displacement, margin());
    std::string refusal;
    for (const unsigned int node : candidates)
      {
        bool has_support = false;
        for (unsigned int d = 0; d < dim; ++d)
          has_support = has_support || !supports->is_free(dim * node + d);
        for (unsigned int o = 0; has_support && o < list.size(); ++o)
          {
            Tensor<1, dim> u =
              contact.motions().velocities()[o].at(place(node) - centre(o));
            if (node < space.n_owned_nodes())
              u -= value_at(v, node);
            const Obstacle::Nearest at = nearest(o, node, h * u, others[o]);
            if (at.distance < -closed_gap * size &&
                is_prescribed(node, at.normal))
              refusal =
                format("the obstacle '%s' enters the node at (%s), "
                       "which a boundary condition holds, by %.3g m"
                       "\n  remedy:  end the condition before it ('Box'), "
                       "or move the obstacle less",
                       list[o]->name.c_str(),
                       text_of_place(place(node)).c_str(),
                       -at.distance);
          }
      }
    refusal = text_of_any_rank(comm, refusal);
    if (!refusal.empty())
      throw StepFailure(refusal);
  }

  void
  ObstacleContact::add_nodes(const Vector              &velocity_n,
                             const double               h,
                             const std::vector<Vector> &gaps,
                             const NearBodies          &bodies,
                             ContactStep               &step) const
  {
    const auto &list   = scene.obstacles.list;
    const auto  others = scene.obstacles.neighbours(displacement, margin());
    std::string refusal;
    for (const unsigned int node : candidates)
      {
        const Point<dim>              x = place(node);
        const Tensor<1, dim>          v = value_at(velocity_n, node);
        std::vector<PotentialContact> near;
        for (unsigned int o = 0; o < list.size(); ++o)
          {
            const Tensor<1, dim>    arm = x - centre(o);
            const Tensor<1, dim>    V = step.bodies[o].without_contact.at(arm);
            const Obstacle::Nearest at =
              nearest(o, node, h * (V - v), others[o]);
            // In a background mesh only nodes in or on the obstacle count; the
            // others belong to the body and may be arbitrarily close.
            if (!mesh_is_body && at.distance > closed_gap * size)
              continue;
            const double gap =
              mesh_is_body ? at.distance
                           : std::max(gaps[o].local_element(dim * node), 0.);
            ContactNode contact;
            contact.node      = node;
            contact.obstacle  = o;
            contact.normal    = at.normal;
            contact.arm       = arm;
            contact.velocity  = V;
            contact.least     = -gap / h;
            contact.is_closed = gap <= closed_gap * size;
            contact.length = mesh_is_body ? sides->facing(node, at.normal) : 0.;
            apply_law(list[o]->law, contact);
            const double u_n = (v - V) * at.normal;
            rebound(u_n, list[o]->law, contact);
            near.push_back({contact, gap, closable_gap(h, u_n)});
          }
        if (const auto other = bodies.find(node); other != bodies.end())
          near.push_back(other->second);
        add_nearest(near, refusal, step);
      }
    refusal = text_of_any_rank(comm, refusal);
    if (!refusal.empty())
      throw StepFailure(refusal);
  }

  void
  ObstacleContact::add_nearest(std::vector<PotentialContact> &near,
                               std::string                   &refusal,
                               ContactStep                   &step) const
  {
    // Contacts that may close in the step come before nearer ones that may not,
    // and obstacles before bodies at the same distance.
    std::stable_sort(near.begin(),
                     near.end(),
                     [](const PotentialContact &a, const PotentialContact &b) {
                       const bool a_is_far = a.gap > a.closable_gap,
                                  b_is_far = b.gap > b.closable_gap;
                       return a_is_far != b_is_far ? b_is_far : a.gap < b.gap;
                     });
    std::vector<const PotentialContact *> taken;
    for (const PotentialContact &at : near)
      if (std::isfinite(at.gap) &&
          (taken.empty() ||
           (at.gap <= at.closable_gap &&
            taken[0]->gap <= taken[0]->closable_gap &&
            std::all_of(
              taken.begin(), taken.end(), [&](const PotentialContact *other) {
                return at.contact.normal * other->contact.normal < parallel;
              }))))
        taken.push_back(&at);
    if (taken.size() > 1)
      {
        const std::string where =
          "the node at (" + text_of_place(place(taken[0]->contact.node)) + ") ";
        const auto name_of = [&](const PotentialContact *at) {
          const auto        &obstacles = scene.obstacles.list;
          const unsigned int i         = at->contact.obstacle;
          return i < obstacles.size()
                   ? obstacles[i]->name
                   : scene.contacts.list[i - obstacles.size()]->name;
        };
        const std::string both =
          "'" + name_of(taken[0]) + "' and '" + name_of(taken[1]) + "'";
        bool is_free = false;
        for (const PotentialContact *at : taken)
          is_free = is_free || (!at->contact.touches_body() &&
                                step.bodies[at->contact.obstacle].n_free() > 0);
        if (taken.size() > 2)
          refusal = where + "touches " + both + " and '" + name_of(taken[2]) +
                    "' at once" + of_corner;
        else if (taken[0]->contact.normal * taken[1]->contact.normal <
                 -parallel)
          refusal = where + "is squeezed between " + both + of_corner;
        else if (is_free)
          refusal = where + "touches " + both +
                    " at once, of which one is a free obstacle" + of_corner;
      }
    for (const PotentialContact *at : taken)
      step.nodes.push_back(at->contact);
  }

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
        // Final gap from the initial one, -least h, unless the node rebounds.
        if (!nodes[i].rebounds)
          most[1] = std::max(
            most[1], -h * (relative * nodes[i].normal - nodes[i].least));
        if (!contact.carries_load(i))
          continue;
        const Tensor<1, dim> r = force(contact, i);
        // Vertices of quadratic tetrahedra have no tributary area.
        if (const double l = nodes[i].length;
            mesh_is_body && l > 0. &&
            nodal_contact.state != Contact::State::open)
          {
            sums[5] += l;
            if (nodal_contact.state == Contact::State::stick)
              sums[7] += l;
            const double pressure = (r * nodes[i].normal) / l;
            most[2]               = std::max(most[2], pressure);
            most[3] =
              std::max(most[3], (r / l - pressure * nodes[i].normal).norm());
          }
        // The work of a pair of bodies is the dissipation by friction and
        // impact.
        sums[3] += h * (r * (nodes[i].touches_body() ? relative : u));
        sums[4] -= h * (r * relative);
        if (nodes[i].impact < 0.)
          sums[8] += h * (r * nodes[i].normal) *
                     (nodes[i].impact - relative * nodes[i].normal) / 2.;
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
        const Tensor<1, dim> r     = force(contact, i);
        const unsigned int   o     = nodes[i].obstacle;
        const Point<dim>     about = scene.observation.moment_centre().value_or(
          nodes[i].touches_body() ? Point<dim>() : centre(o));
        for (unsigned int d = 0; d < dim; ++d)
          result[o].add(place(nodes[i].node) - about, d, r[d]);
      }
    sum_states_over_ranks(result, comm);
    return result;
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
        std::vector<Tensor<1, dim>> axes = {at.normal};
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
