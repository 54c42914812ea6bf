// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/contact/obstacle_step.h>

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
    size             = 1e300;
    for (const auto &cell : mesh.own_cells())
      size = std::min(size, cell->diameter());
    size = Utilities::MPI::min(size, comm);
    check_start_of_free(scene.obstacles, margin());
    if (!mesh_is_body)
      {
        check_thin();
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
  ObstacleContact::check_thin() const
  {
    double side = 1e300;
    for (const auto &cell : mesh.own_cells())
      side = std::min(side, BackgroundMesh::size_of(cell));
    side = Utilities::MPI::min(side, comm);
    for (const auto &obstacle : scene.obstacles.list)
      {
        const auto distance = [&](const Point<dim> &x) {
          return obstacle->nearest(x, {}, {}).distance;
        };
        if (!is_thinner(*obstacle, side))
          continue;
        bool is_lost = obstacle->is_free();
        constexpr unsigned int n_times = 1000; // at which it may move
        for (unsigned int i = 0; i <= n_times && !is_lost; ++i)
          {
            const RigidMotion V = obstacle->velocity(double(i) / n_times *
                                                     scene.loading.duration());
            for (unsigned int k = 0; k < n_motions; ++k)
              is_lost = is_lost || V[k] != 0.;
          }
        // Cells that it crosses between their vertices.
        for (const auto &cell : mesh.own_cells())
          {
            bool         has_node = false, is_crossed = false;
            const double n = 16.;
            for (const unsigned int a : cell->vertex_indices())
              {
                const Point<dim> &x = cell->vertex(a);
                has_node = has_node || distance(x) <= closed_gap * size;
                for (unsigned int b = 0; b < a; ++b)
                  for (double k = 1.; k < n; ++k)
                    is_crossed = is_crossed ||
                                 distance(x + k / n * (cell->vertex(b) - x)) <
                                   -1e-3 * side;
              }
            is_lost = is_lost || (is_crossed && !has_node);
          }
        if (Utilities::MPI::logical_or(is_lost, comm))
          refuse_thin(*obstacle, side);
      }
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
    return free.norm() < least_free_normal;
  }

  ContactStep
  ObstacleContact::begin(const Vector              &velocity_n,
                         const double               t,
                         const double               h,
                         const double               solved_h,
                         const std::vector<Vector> &gaps,
                         std::vector<FacingNode>    facing) const
  {
    check_free(scene.obstacles, displacement, margin());
    const double solved_at = t + solved_h;
    ContactStep  step;
    step.bodies =
      bodies_of_step(scene, velocity, solved_at, solved_at, solved_h);
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
            if (mesh_is_body && gap <= closable_gap(h, u_n))
              refuse_turned(node, *list[o], refusal);
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
  ObstacleContact::refuse_turned(const unsigned int node,
                                 const Obstacle    &obstacle,
                                 std::string       &refusal) const
  {
    for (const Unknowns::TurnedNode &turned : supports->turned_nodes)
      if (turned.node == node)
        refusal =
          format("the obstacle '%s' touches the node at (%s), of which a "
                 "boundary condition holds the 'Velocity normal'"
                 "\n  remedy:  hold components of its velocity ('Velocity x'), "
                 "replace the side by an obstacle, or end the condition before "
                 "it ('Box')",
                 obstacle.name.c_str(),
                 text_of_place(place(node)).c_str());
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
} // namespace geocone::GEOCONE_DIM
