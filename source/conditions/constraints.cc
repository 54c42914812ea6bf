// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/conditions/constraints.h>
#include <geocone/conditions/vector_at.h>
#include <geocone/surfaces/face_points.h>
#include <geocone/surfaces/sides_of_body.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Conditions whose directions differ by less (10 degrees) prescribe one
     *  direction. */
    const double least_sine = std::sin(radians(10.));

    /** Faces of one condition that meet in a sharper corner (60 degrees) have
     *  no common normal there: |sum of n dA| over the sum of dA. */
    const double least_mean_normal = std::cos(radians(30.));
  } // namespace

  Constraints::Constraints(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space,
                           const std::string    &stage)
    : scene(scene)
    , space(space)
    , comm(mesh.triangulation().get_communicator())
    , is_active(scene.dirichlet.acting_in(stage))
  {
    node_positions   = &space.node_positions();
    const auto &list = scene.dirichlet.list;
    nodes.resize(list.size());
    for (unsigned int c = 0; c < list.size(); ++c)
      {
        owned_nodes.emplace_back();
        n_nodes.push_back(0);
        // Minima of the coordinates and of their negatives.
        std::array<double, 2 * dim> bounds;
        bounds.fill(1e300);
        const auto extend = [&](const Point<dim> &x) {
          for (unsigned int d = 0; d < dim; ++d)
            {
              bounds[d]       = std::min(bounds[d], x[d]);
              bounds[dim + d] = std::min(bounds[dim + d], -x[d]);
            }
        };
        if (list[c]->moves_with_body())
          for (const SidePart &panel :
               segments_of_body(*list[c], scene.geometry))
            for (const Point<dim> &corner : panel.corners)
              extend(corner);
        else
          {
            for (const unsigned int node :
                 space.nodes_on_sides(mesh.side_ids(*list[c])))
              if (list[c]->holds_at(space.node_positions()[node]))
                {
                  nodes[c].push_back(node);
                  extend(space.node_positions()[node]);
                  if (node < space.n_owned_nodes())
                    owned_nodes[c].push_back(node);
                }
            n_nodes[c] = Utilities::MPI::sum(owned_nodes[c].size(), comm);
            list[c]->check_selection(n_nodes[c]);
          }
        Utilities::MPI::min(ArrayView<const double>(bounds.data(), 2 * dim),
                            comm,
                            ArrayView<double>(bounds.data(), 2 * dim));
        centres.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          centres.back()[d] = (bounds[d] - bounds[dim + d]) / 2.;
        if (const auto given = scene.observation.moment_centre())
          centres.back() = *given;
      }
    find_prescribed(mesh);
  }

  bool
  Constraints::begin_stage(const BackgroundMesh &mesh, const std::string &stage)
  {
    std::vector<bool> next    = scene.dirichlet.acting_in(stage);
    const bool        changes = next != is_active;
    if (changes)
      {
        is_active = std::move(next);
        prescribed.clear();
        oblique.clear();
        turned_nodes.clear();
        shared.clear();
        n_shares = 0;
        first_part.clear();
        parts.clear();
        find_prescribed(mesh);
      }
    return changes;
  }

  void
  Constraints::find_prescribed(const BackgroundMesh &mesh)
  {
    // Conditions that prescribe each local dof; the last one determines it.
    std::map<unsigned int, std::vector<unsigned int>> of_dof;
    for (unsigned int c = 0; c < nodes.size(); ++c)
      for (unsigned int i = 0; i < dim && is_active[c]; ++i)
        if (scene.dirichlet.list[c]->components[i])
          for (const unsigned int node : nodes[c])
            of_dof[dim * node + i].push_back(c);
    find_oblique_nodes(mesh, of_dof);
    find_shared(mesh, of_dof);
    for (const auto &[dof, conditions] : of_dof)
      prescribed.push_back({dof / dim,
                            dof % dim,
                            conditions.back(),
                            space.node_positions()[dof / dim],
                            dof / dim < space.n_owned_nodes(),
                            carrier_of(dof, conditions)});
  }

  unsigned int
  Constraints::carrier_of(const unsigned int               dof,
                          const std::vector<unsigned int> &conditions) const
  {
    const auto found = shared.find(space.partitioner()->local_to_global(dof));
    if (found == shared.end())
      return conditions.back();
    const auto   &list    = scene.dirichlet.list;
    const Shared &among   = found->second;
    unsigned int  carrier = conditions.back();
    double        largest = 0.;
    for (unsigned int k = among.conditions.size(); k-- > 0;)
      if (const double size = std::abs(among.normal[k]);
          size > largest * (1. + 1e-6) &&
          list[among.conditions[k]]->formula(dof % dim) ==
            list[conditions.back()]->formula(dof % dim))
        {
          carrier = among.conditions[k];
          largest = size;
        }
    return carrier;
  }

  std::map<unsigned int, Tensor<1, dim>>
  Constraints::normals_of(const BoundaryCondition         &condition,
                          const BackgroundMesh            &mesh,
                          const std::vector<unsigned int> &nodes) const
  {
    std::map<unsigned int, Tensor<1, dim>> normals;
    // Sums of N_i n dA and of N_i dA.
    Vector normal(space.partitioner()), size(space.partitioner());
    for_each_face_point(
      mesh,
      space,
      condition,
      [&](const BackgroundMesh::Cell &, const FacePoint &point) {
        for (unsigned int i = 0; i < point.nodes.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int dof  = dim * point.nodes[i] + d;
              const double       part = point.weight * point.values[i];
              normal.local_element(dof) += part * point.normal[d];
              size.local_element(dof) += part;
            }
      });
    for (Vector *sum : {&normal, &size})
      {
        sum->compress(VectorOperation::add);
        sum->update_ghost_values();
      }
    std::string corner;
    for (const unsigned int node : nodes)
      {
        const Tensor<1, dim> n = value_at(normal, node);
        if (n.norm() > least_mean_normal * size.local_element(dim * node))
          normals[node] = n / n.norm();
        else
          corner = "(" + text_of_place(space.node_positions()[node]) + ")";
      }
    corner = text_of_any_rank(comm, corner);
    if (!corner.empty())
      throw InputError(
        condition.parameter("Velocity normal"),
        condition.formula(dim),
        "sides that have a normal at each node: they meet in corners of "
        "less than 60 degrees, and a box holds whole faces",
        "give the sides that meet at " + corner +
          " conditions of their own, or enlarge the box");
    return normals;
  }

  Constraints::Oblique
  Constraints::independent(const unsigned int            node,
                           const std::vector<Direction> &directions)
  {
    Oblique held;
    held.node = node;

    std::vector<Tensor<1, dim>> axes; // with the same span
    const auto                  rest_of = [&axes](Tensor<1, dim> d) {
      for (const Tensor<1, dim> &axis : axes)
        d -= (d * axis) * axis;
      return d;
    };
    for (auto i = directions.rbegin(); i != directions.rend(); ++i)
      if (const Tensor<1, dim> rest = rest_of(i->d); rest.norm() > least_sine)
        {
          held.directions.push_back(*i);
          axes.push_back(rest / rest.norm());
        }

    // The remaining axes are free: orthogonal to all prescribed directions.
    if (dim == 2 && held.is_turned())
      axes.push_back(Tensor<1, dim>({-axes[0][1], axes[0][0]}));
    while (axes.size() < dim)
      {
        Tensor<1, dim> best;
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto rest = rest_of(Point<dim>::unit_vector(d));
              rest.norm() > best.norm())
            best = rest;
        axes.push_back(best / best.norm());
      }
    for (unsigned int d = 0; d < dim; ++d)
      held.axes[d] = axes[d];
    return held;
  }

  void
  Constraints::find_oblique_nodes(
    const BackgroundMesh                              &mesh,
    std::map<unsigned int, std::vector<unsigned int>> &of_dof)
  {
    const auto                                    &list = scene.dirichlet.list;
    std::map<unsigned int, std::vector<Direction>> of_node;
    for (unsigned int c = 0; c < list.size(); ++c)
      if (list[c]->normal && is_active[c])
        for (const auto &[node, n] : normals_of(*list[c], mesh, nodes[c]))
          of_node[node].push_back({c, dim, n});

    for (auto &[node, directions] : of_node)
      {
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto held = of_dof.find(dim * node + d);
              held != of_dof.end())
            for (const unsigned int c : held->second)
              directions.push_back({c, d, Point<dim>::unit_vector(d)});
        std::stable_sort(directions.begin(),
                         directions.end(),
                         [](const Direction &a, const Direction &b) {
                           return a.condition < b.condition;
                         });
        const Oblique held = independent(node, directions);
        if (!held.has_normal())
          continue; // along coordinates only
        for (unsigned int d = 0; d < dim; ++d)
          of_dof.erase(dim * node + d);
        oblique.push_back(held);
        if (held.is_turned())
          turned_nodes.push_back({node, held.axes});
      }
  }

  void
  Constraints::number_shared(
    const std::map<unsigned int, std::vector<unsigned int>> &of_dof)
  {
    // Dof and conditions of each shared component, on all ranks.
    std::vector<std::vector<types::global_dof_index>> own;
    for (const auto &[dof, conditions] : of_dof)
      if (conditions.size() > 1)
        {
          own.emplace_back(1, space.partitioner()->local_to_global(dof));
          own.back().insert(
            own.back().end(), conditions.begin(), conditions.end());
        }
    if (Utilities::MPI::sum(own.size(), comm) == 0)
      return;
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
      for (const auto &entry : of_rank)
        shared[entry[0]].conditions.assign(entry.begin() + 1, entry.end());
    for (auto &entry : shared)
      {
        entry.second.first = n_shares;
        n_shares += entry.second.conditions.size();
      }
  }

  void
  Constraints::find_shared(
    const BackgroundMesh                                    &mesh,
    const std::map<unsigned int, std::vector<unsigned int>> &of_dof)
  {
    number_shared(of_dof);
    if (shared.empty())
      return;

    // A face belongs to the last condition that prescribes the component there.
    const auto                               &list = scene.dirichlet.list;
    std::vector<std::set<types::boundary_id>> ids(list.size());
    std::vector<double>                       sizes(n_shares, 0.);
    std::vector<double>                       normals(n_shares, 0.);
    std::map<unsigned int, std::map<std::array<unsigned int, 2>, FaceMoments>>
      of_cell;
    for (unsigned int c = 0; c < list.size(); ++c)
      if (!list[c]->moves_with_body())
        ids[c] = mesh.side_ids(*list[c]);
    for (const auto &cell : mesh.own_cells())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          for (const FacePoint &point : points_on_face(mesh, space, cell, f))
            for (unsigned int d = 0; d < dim; ++d)
              {
                unsigned int holder = list.size();
                for (unsigned int c = 0; c < list.size(); ++c)
                  if (is_active[c] && list[c]->components[d] &&
                      ids[c].count(cell->face(f)->boundary_id()) > 0 &&
                      list[c]->holds_at(point.position))
                    holder = c;
                if (holder == list.size())
                  continue;
                for (unsigned int i = 0; i < point.nodes.size(); ++i)
                  {
                    const auto found =
                      shared.find(space.partitioner()->local_to_global(
                        dim * point.nodes[i] + d));
                    if (found == shared.end() || point.values[i] == 0.)
                      continue;
                    const auto &conditions = found->second.conditions;
                    const auto  at =
                      std::find(conditions.begin(), conditions.end(), holder);
                    if (at == conditions.end())
                      continue;
                    const unsigned int place =
                      found->second.first + (at - conditions.begin());
                    const double part = point.weight * point.values[i];
                    sizes[place] += std::abs(part);
                    normals[place] += std::abs(part) * point.normal[d];
                    FaceMoments &faces =
                      of_cell[cell->active_cell_index()][{{place, d}}];
                    const Tensor<1, dim> arm = point.position - cell->center();
                    faces.normal += part * point.normal;
                    for (unsigned int k = 0; k < dim; ++k)
                      faces.along[k] += part * arm[k] * point.normal;
                  }
              }
    sum_over_ranks(sizes, comm);
    sum_over_ranks(normals, comm);
    for (auto &entry : shared)
      {
        const unsigned int first = entry.second.first,
                           end   = first + entry.second.conditions.size();
        entry.second.size.assign(sizes.begin() + first, sizes.begin() + end);
        entry.second.normal.assign(normals.begin() + first,
                                   normals.begin() + end);
      }
    const unsigned int n_cells = mesh.triangulation().n_active_cells();
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        first_part.push_back(parts.size());
        if (const auto found = of_cell.find(c); found != of_cell.end())
          for (const auto &[key, faces] : found->second)
            parts.push_back({key[0], key[1], faces});
      }
    first_part.push_back(parts.size());
  }

  void
  Constraints::number_unknowns(const Vector *mass)
  {
    // A mass within rounding is no mass.
    const double       least   = mass ? 1e-14 * mass->linfty_norm() : 0.;
    const unsigned int n_local = space.n_local_nodes();
    free_row.assign(dim * n_local, 0);
    with_mass.assign(dim * n_local, true);
    if (mass != nullptr)
      for (unsigned int dof = 0; dof < dim * n_local; ++dof)
        if (!(mass->local_element(dof) > least))
          {
            free_row[dof]  = massless_row;
            with_mass[dof] = false;
          }
    for (const PrescribedNode &p : prescribed)
      free_row[dim * p.node + p.component] = prescribed_row;
    for (const Oblique &o : oblique)
      for (unsigned int d = 0; d < o.directions.size(); ++d)
        free_row[dim * o.node + d] = prescribed_row;

    // Owned dofs first, numbered through the ranks; a ghost's number comes from
    // its owner.
    int n_local_rows = 0;
    for (unsigned int dof = 0; dof < dim * n_local; ++dof)
      {
        if (dof == dim * space.n_owned_nodes())
          n_owned_rows = n_local_rows;
        if (free_row[dof] == 0)
          free_row[dof] = n_local_rows++;
      }
    if (n_local == space.n_owned_nodes())
      n_owned_rows = n_local_rows;
    int first = 0;
    MPI_Exscan(&n_owned_rows, &first, 1, MPI_INT, MPI_SUM, comm);
    n_rows = Utilities::MPI::sum(n_owned_rows, comm);

    Vector number(space.partitioner());
    for (unsigned int dof = 0; dof < dim * space.n_owned_nodes(); ++dof)
      if (is_free(dof))
        number.local_element(dof) = first + free_row[dof];
    number.update_ghost_values();
    global_row.clear();
    for (unsigned int dof = 0; dof < dim * n_local; ++dof)
      if (is_free(dof))
        global_row.push_back(std::lround(number.local_element(dof)));
    if (n_rows == 0)
      throw InputError("all nodes are prescribed: there is nothing to solve\n"
                       "  remedy:  take smaller cells, or free some sides");
  }

  std::string
  Constraints::warn_of_nonlinear_values() const
  {
    if (space.degree() == 1 || !space.is_non_negative())
      return "";
    std::string names;
    // At the end, where time functions have their final values.
    const double t    = scene.loading.duration();
    const auto  &list = scene.dirichlet.list;
    for (unsigned int c = 0; c < list.size(); ++c)
      {
        if (list[c]->moves_with_body())
          continue;
        // A linear function has at each midpoint the mean of both ends.
        double largest = 0., bend = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          for (std::size_t i = 1;
               list[c]->components[d] && i < owned_nodes[c].size();
               ++i)
            {
              const unsigned int a = owned_nodes[c][i - 1],
                                 b = owned_nodes[c][i];
              const double at_a = value(c, d, a, t), at_b = value(c, d, b, t);
              const Point<dim> &x = space.node_positions()[a],
                               &y = space.node_positions()[b];
              largest = std::max({largest, std::abs(at_a), std::abs(at_b)});
              try
                {
                  const double between =
                    list[c]->value(d, Point<dim>(x + (y - x) / 2.), t);
                  bend = std::max(bend, std::abs(between - (at_a + at_b) / 2.));
                }
              catch (const RunError &)
                {
                  bend = std::numeric_limits<double>::max(); // no value there
                }
            }
        const bool is_bent = Utilities::MPI::max(bend, comm) >
                             1e-6 * Utilities::MPI::max(largest, comm);
        if (is_bent)
          names += (names.empty() ? "'" : ", '") + list[c]->name + "'";
      }
    if (names.empty())
      return "";
    return "values of " + names +
           " are not linear in space: coefficients of Bernstein's polynomials "
           "and of splines take them, which is of order two only; set "
           "Discretisation/Basis = Lagrange for FEM";
  }

  void
  Constraints::set_values(Vector &v, const double t) const
  {
    for (const PrescribedNode &p : prescribed)
      v.local_element(dim * p.node + p.component) =
        scene.dirichlet.list[p.condition]->value(p.component, p.place, t);
    for (const Oblique &o : oblique)
      {
        // Forward substitution, as d_i is a combination of the first axes up to
        // i.
        const auto    &held = o.directions;
        Tensor<1, dim> along; // components along the axes
        for (unsigned int i = 0; i < held.size(); ++i)
          {
            const Tensor<1, dim> d = o.axes * held[i].d;
            along[i] = (value(held[i].condition, held[i].component, o.node, t) -
                        d * along) /
                       d[i];
          }
        double *at = &v.local_element(dim * o.node);
        if (held.size() == dim)
          put(transpose(o.axes) * along, at);
        else
          for (unsigned int i = 0; i < held.size(); ++i)
            at[i] = along[i];
      }
  }

  void
  Constraints::turn(Vector &v) const
  {
    for (const TurnedNode &turned : turned_nodes)
      if (turned.node < space.n_owned_nodes())
        {
          double *at = &v.local_element(dim * turned.node);
          put(turned.axes * taken(at), at);
        }
    if (!turned_nodes.empty() && v.has_ghost_elements())
      v.update_ghost_values();
  }

  void
  Constraints::turn_back(Vector &v) const
  {
    for (const TurnedNode &turned : turned_nodes)
      if (turned.node < space.n_owned_nodes())
        {
          double *at = &v.local_element(dim * turned.node);
          put(transpose(turned.axes) * taken(at), at);
        }
    if (!turned_nodes.empty() && v.has_ghost_elements())
      v.update_ghost_values();
  }

  std::vector<double>
  Constraints::exerted_on_faces(const MaterialPoints      &points,
                                const BackgroundMesh      &mesh,
                                const std::vector<Mandel> &stress) const
  {
    std::vector<double> exerted(n_shares, 0.);
    if (n_shares == 0)
      return exerted;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int cell = points.cells[c]->active_cell_index();
        if (first_part[cell] == first_part[cell + 1])
          continue;
        const LinearStress in_cell(points, c, mesh, space, stress);
        for (unsigned int i = first_part[cell]; i < first_part[cell + 1]; ++i)
          exerted[parts[i].place] +=
            in_cell.force(parts[i].component, parts[i].faces);
      }
    sum_over_ranks(exerted, comm);
    return exerted;
  }

  void
  Constraints::add_force(const unsigned int     condition,
                         const unsigned int     node,
                         const unsigned int     component,
                         const double           force,
                         std::vector<Reaction> &result) const
  {
    result[condition].add(
      space.node_positions()[node] - centres[condition], component, force);
  }

  void
  Constraints::divide(const PrescribedNode      &node,
                      const Shared              &among,
                      const double               force,
                      const std::vector<double> &exerted,
                      const double               t,
                      std::vector<Reaction>     &result) const
  {
    // Conditions that prescribe another velocity than the node has carry no
    // force.
    std::vector<double> size(among.size.size(), 0.);
    double              whole = 0., left = force;
    const double value_n = value(node.condition, node.component, node.node, t);
    for (unsigned int k = 0; k < among.conditions.size(); ++k)
      {
        double largest = 0.;
        for (const unsigned int c : {among.conditions[k], node.condition})
          for (unsigned int d = 0; d < dim; ++d)
            if (scene.dirichlet.list[c]->components[d])
              largest = std::max(largest, std::abs(value(c, d, node.node, t)));
        if (among.size[k] > 0. &&
            std::abs(value(among.conditions[k], node.component, node.node, t) -
                     value_n) <= 1e-9 * largest)
          {
            size[k] = among.size[k];
            whole += size[k];
            left -= exerted[among.first + k];
          }
      }
    for (unsigned int k = 0; k < among.conditions.size(); ++k)
      if (size[k] > 0.)
        add_force(among.conditions[k],
                  node.node,
                  node.component,
                  exerted[among.first + k] + left * size[k] / whole,
                  result);
  }

  std::vector<Reaction>
  Constraints::reactions(const Vector              &residual,
                         const MaterialPoints      &points,
                         const BackgroundMesh      &mesh,
                         const std::vector<Mandel> &stress,
                         const double               t) const
  {
    const std::vector<double> exerted = exerted_on_faces(points, mesh, stress);
    std::vector<Reaction>     result(scene.dirichlet.list.size());
    for (const PrescribedNode &p : prescribed)
      {
        if (!p.mine)
          continue;
        const unsigned int dof = dim * p.node + p.component;
        const double       f   = residual.local_element(dof);
        const auto         found =
          n_shares > 0 ? shared.find(space.partitioner()->local_to_global(dof))
                               : shared.end();
        if (found != shared.end() && found->second.size.back() > 0.)
          divide(p, found->second, f, exerted, t, result);
        else
          add_force(p.condition, p.node, p.component, f, result);
      }
    for (const Oblique &o : oblique)
      {
        if (o.node >= space.n_owned_nodes())
          continue;
        const auto    &held  = o.directions;
        Tensor<1, dim> force = taken(residual.begin() + dim * o.node);
        if (held.size() == dim) // the others have it along their axes
          force = o.axes * force;
        // f = sum_i along_i d_i, by back substitution.
        for (unsigned int i = held.size(); i-- > 0;)
          {
            const Tensor<1, dim> d     = o.axes * held[i].d;
            const double         along = force[i] / d[i];
            force -= along * d;
            for (unsigned int c = 0; c < dim; ++c)
              add_force(
                held[i].condition, o.node, c, along * held[i].d[c], result);
          }
      }
    sum_states_over_ranks(result, comm);
    return result;
  }

  double
  Constraints::mean(const Vector      &field,
                    const unsigned int condition,
                    const unsigned int component) const
  {
    double sum = 0.;
    for (const unsigned int node : owned_nodes[condition])
      sum += field.local_element(dim * node + component);
    return Utilities::MPI::sum(sum, comm) / n_nodes[condition];
  }
} // namespace geocone::GEOCONE_DIM
