// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mechanics/constraints.h>

#include <Eigen/Eigenvalues>

#include <deal.II/base/mpi.h>

#include <map>

namespace geocone
{
  using namespace dealii;

  Constraints::Constraints(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space)
    : scene(scene)
    , space(space)
    , comm(mesh.triangulation().get_communicator())
  {
    // The last condition in the list that prescribes a dof holds it.
    const auto                        &list = scene.dirichlet.list;
    std::map<unsigned int, Prescribed> of_dof;
    for (unsigned int c = 0; c < list.size(); ++c)
      {
        owned_nodes.emplace_back();
        n_nodes.push_back(0);
        if (list[c]->moves())
          continue;
        for (const unsigned int node :
             space.nodes_on_sides(mesh.side_ids(*list[c])))
          if (list[c]->in_box(space.node_positions()[node]))
            {
              if (node < space.n_owned_nodes())
                owned_nodes[c].push_back(node);
              for (unsigned int i = 0; i < dim; ++i)
                if (list[c]->components[i])
                  of_dof[dim * node + i] = {node, i, c};
            }
        n_nodes[c] = Utilities::MPI::sum(owned_nodes[c].size(), comm);
        list[c]->check_selection(n_nodes[c]);
      }
    for (const auto &entry : of_dof)
      prescribed.push_back(entry.second);
  }

  void
  Constraints::number_unknowns(const Vector *mass)
  {
    // A function that has but a rounding's share of the mass moves nothing.
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
    for (const Prescribed &p : prescribed)
      free_row[dim * p.node + p.component] = prescribed_row;

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

  void
  Constraints::check_support(const BackgroundMesh &mesh,
                             const Space          &space) const
  {
    const std::vector<unsigned int> part_of_vertex = mesh.connected_parts();
    unsigned int                    n_parts        = 0;
    for (const unsigned int part : part_of_vertex)
      n_parts = std::max(n_parts, part + 1);

    // One representative part per node, and the centre and size of the parts.
    std::vector<int>    part_of_node(space.n_local_nodes(), -1);
    std::vector<double> sums(4 * n_parts, 0.);
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        for (const auto node : nodes)
          part_of_node[space.local_node(node)] =
            part_of_vertex[cell->vertex_index(0)];
      }
    for (unsigned int i = 0; i < space.n_owned_nodes(); ++i)
      {
        const Point<dim> &x = space.node_positions()[i];
        double           *s = &sums[4 * part_of_node[i]];
        s[0] += 1.;
        s[1] += x[0];
        s[2] += x[1];
        s[3] += x.norm_square();
      }
    Utilities::MPI::sum(
      ArrayView<const double>(sums), comm, ArrayView<double>(sums));

    // Rigid velocities (1,0), (0,1) and (-(y - y_c), x - x_c)/size: a motion is
    // free if it moves no prescribed dof.
    std::vector<double> gram(9 * n_parts, 0.);
    std::vector<double> xc(n_parts), yc(n_parts), size(n_parts);
    for (unsigned int p = 0; p < n_parts; ++p)
      {
        const double *s = &sums[4 * p];
        xc[p]           = s[1] / s[0];
        yc[p]           = s[2] / s[0];
        size[p]         = std::sqrt(
          std::max(1e-300, s[3] / s[0] - xc[p] * xc[p] - yc[p] * yc[p]));
      }
    for (const Prescribed &dof : prescribed)
      {
        const unsigned int node = dof.node;
        if (node >= space.n_owned_nodes())
          continue;
        const int         p      = part_of_node[node];
        const Point<dim> &x      = space.node_positions()[node];
        const double      row[3] = {
               dof.component == 0 ? 1. : 0.,
          dof.component == 0 ? 0. : 1.,
          (dof.component == 0 ? -(x[1] - yc[p]) : x[0] - xc[p]) / size[p]};
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            gram[9 * p + 3 * i + j] += row[i] * row[j];
      }
    Utilities::MPI::sum(
      ArrayView<const double>(gram), comm, ArrayView<double>(gram));
    for (unsigned int p = 0; p < n_parts; ++p)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
          Eigen::Map<const Eigen::Matrix3d>(&gram[9 * p]));
        if (eigen.eigenvalues()[0] > 1e-10)
          continue;
        const Eigen::Vector3d m = eigen.eigenvectors().col(0);
        const std::string     which =
          n_parts == 1
                ? std::string("the body")
                : format("the part of the body around (%g, %g)", xc[p], yc[p]);
        std::string motion;
        if (std::abs(m[2]) < 1e-6)
          motion = format("translate along (%.3g, %.3g)", m[0], m[1]) +
                   (std::abs(m[1]) < 1e-6
                      ? ": no node of it has its velocity x prescribed"
                    : std::abs(m[0]) < 1e-6
                      ? ": no node of it has its velocity y prescribed"
                      : "");
        else
          {
            const auto rounded = [&](const double x) {
              return std::abs(x) < 1e-9 * size[p] ? 0. : x;
            };
            motion = format("rotate about (%.3g, %.3g)",
                            rounded(xc[p] - m[1] / m[2] * size[p]),
                            rounded(yc[p] + m[0] / m[2] * size[p])) +
                     ": too few nodes are prescribed to stop it";
          }
        throw InputError("singular system (rigid body motion): " + which +
                         " can " + motion +
                         format(" (%.0f nodes)", sums[4 * p]) +
                         "\n  remedy:  add a boundary condition that holds it, "
                         "or switch the inertia on "
                         "('Time stepping/Inertia')");
      }
  }

  void
  Constraints::set_values(Vector &v, const double t) const
  {
    for (const Prescribed &p : prescribed)
      v.local_element(dim * p.node + p.component) =
        scene.dirichlet.list[p.condition]->components[p.component]->value(
          space.node_positions()[p.node], t);
  }

  double
  Constraints::resultant(const Vector      &residual,
                         const unsigned int condition,
                         const unsigned int component) const
  {
    double sum = 0.;
    for (const Prescribed &p : prescribed)
      if (p.condition == condition && p.component == component &&
          p.node < space.n_owned_nodes())
        sum += residual.local_element(dim * p.node + component);
    return Utilities::MPI::sum(sum, comm);
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
} // namespace geocone
