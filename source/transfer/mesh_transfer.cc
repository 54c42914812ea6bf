// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conditions/constraints.h>
#include <geocone/transfer/mesh_transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  MeshTransfer::MeshTransfer(const Scene    &scene,
                             BackgroundMesh &mesh,
                             Space          &space,
                             RankBalance    &balance)
    : scene(scene)
    , mesh(mesh)
    , space(space)
    , balance(balance)
    , comm(mesh.triangulation().get_communicator())
    , n(space.nodes_per_cell())
    , search(mesh)
    , stage(scene.loading.list.front()->name)
  {
    const Constraints constraints(scene, mesh, space, stage);
    store_nodes(constraints);
    for (unsigned int c = 0; c < scene.dirichlet.list.size(); ++c)
      centres.push_back(constraints.centre(c));
  }

  void
  MeshTransfer::store_nodes(const Constraints &constraints)
  {
    exchanged.reinit(space.partitioner());
    const auto &tria = mesh.triangulation();
    cell_nodes.assign(n * tria.n_active_cells(), numbers::invalid_unsigned_int);
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        for (unsigned int i = 0; i < n; ++i)
          cell_nodes[cell->active_cell_index() * n + i] =
            space.local_node(nodes[i]);
      }

    const std::size_t n_nodes = space.n_local_nodes();
    read.resize(node_size * n_nodes);
    write.resize(node_size * n_nodes);
    mass.resize(n_nodes);
    mine       = {{{0, space.n_owned_nodes()}}};
    prescribed = constraints.prescribed_nodes();
  }

  void
  MeshTransfer::redistribute(const std::vector<PointArrays> &groups)
  {
    std::vector<unsigned int> n_in_cell(mesh.triangulation().n_active_cells());
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        if (group.cell[p] != numbers::invalid_unsigned_int)
          ++n_in_cell[group.cell[p]];
    balance.repartition(std::move(n_in_cell), mesh, space);
    store_nodes(Constraints(scene, mesh, space, stage));
  }

  bool
  MeshTransfer::begin_stage(const std::string &next)
  {
    const bool changes =
      scene.dirichlet.acting_in(next) != scene.dirichlet.acting_in(stage);
    stage = next;
    if (changes)
      prescribed = Constraints(scene, mesh, space, stage).prescribed_nodes();
    return changes;
  }

  void
  MeshTransfer::sort(std::vector<PointArrays> &groups)
  {
    double n_here = 0.;
    for (PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        {
          unsigned int &cell  = group.cell[p];
          const auto    place = search.find(
            group.position.of(p),
            cell < mesh.triangulation().n_active_cells() ? search.cell(cell)
                                                            : Cell());
          cell = numbers::invalid_unsigned_int;
          if (place)
            {
              cell          = place->cell->active_cell_index();
              group.unit[p] = place->unit;
              ++n_here;
            }
        }
    if (balance.is_due(n_here, comm))
      redistribute(groups);

    lost.clear();
    functions.resize(groups.size());
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        // Points in cells of other ranks are sent there; the others have their
        // unit coordinates.
        PointArrays              &group = groups[g];
        std::vector<unsigned int> owner(group.n_points(), rank);
        unsigned int              n_staying = 0;
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            unsigned int &cell = group.cell[p];
            if (cell != numbers::invalid_unsigned_int)
              owner[p] = search.owner(search.cell(cell));
            else
              {
                lost.push_back({{g, n_staying}});
                cell = (*mesh.own_cells().begin())->active_cell_index();
                group.unit[p] = Point<dim>();
              }
            n_staying += owner[p] == rank;
          }
        migrate(group, owner, comm);
        group.pad();
        evaluate(group, functions[g]);
      }
    write.fill(0.);
    mass.fill(0.);
  }

  bool
  MeshTransfer::owns(const Point<dim> &x) const
  {
    const auto place = search.find(x);
    return place &&
           search.owner(place->cell) == Utilities::MPI::this_mpi_process(comm);
  }

  void
  MeshTransfer::evaluate(const PointArrays &group, Functions &at) const
  {
    const unsigned int padded = group.n_padded();
    at.nodes.resize(n * padded);
    at.N.resize(n * padded);
    for (std::vector<double> &slopes : at.slopes)
      slopes.resize(n * padded);
    std::vector<Tensor<1, dim>> gradient(n);
    for (unsigned int p = 0; p < padded; ++p)
      {
        const unsigned int c    = group.cell[p];
        const Cell         cell = search.cell(c);
        space.evaluate(cell, group.unit[p], &at.N[p * n], gradient.data());
        const Tensor<2, dim> inverse =
          mesh.inverse_jacobian(cell, group.unit[p]);
        for (unsigned int i = 0; i < n; ++i)
          {
            const Tensor<1, dim> slope = gradient[i] * inverse;
            for (unsigned int d = 0; d < dim; ++d)
              at.slopes[d][p * n + i] = slope[d];
            at.nodes[p * n + i] = cell_nodes[c * n + i];
          }
      }
  }

  PointFunctions
  MeshTransfer::functions_at(const TransferBlock &points,
                             const unsigned int   k) const
  {
    const Functions  &at    = functions[points.group];
    const std::size_t first = n * static_cast<std::size_t>(points.first + k);
    PointFunctions    here  = {n, &at.nodes[first], &at.N[first], {}};
    for (unsigned int d = 0; d < dim; ++d)
      here.slopes[d] = &at.slopes[d][first];
    return here;
  }

  template <bool with_gradients>
  void
  MeshTransfer::gather_any(const TransferBlock &points,
                           BlockScratch        &scratch) const
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        // The slopes are those of the first four doubles of a node.
        const PointFunctions at = functions_at(points, k);
        double *out = scratch.gathered + BlockScratch::n_gathered * k;
        double  first[4 + 4 * dim];
        at.gather<4, with_gradients, node_size>(read.data(), first);
        std::copy_n(first, 4, out);
        if constexpr (dim == 3)
          at.gather<4, false, node_size>(read.data() + 4, out + 4);
        if constexpr (with_gradients)
          std::copy_n(first + 4, 4 * dim, out + node_size);
      }
  }

  void
  MeshTransfer::gather(const TransferBlock &points, BlockScratch &scratch)
  {
    gather_any<true>(points, scratch);
  }

  void
  MeshTransfer::gather_values(const TransferBlock &points,
                              BlockScratch        &scratch)
  {
    gather_any<false>(points, scratch);
  }

  void
  MeshTransfer::gather_affine(const TransferBlock &points, BlockScratch &)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = points.x[d][k];
        const Tensor<2, dim> C =
          functions_at(points, k).gather_affine<node_size>(
            read.data(), x, space.node_positions(), cell_size());
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            points.c[dim * c + d][k] = C[c][d];
      }
  }

  template <bool with_gradients>
  void
  MeshTransfer::scatter_any(const TransferBlock &points,
                            const BlockScratch  &scratch,
                            const bool           with_mass)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const PointFunctions at = functions_at(points, k);
        const double *const  scattered =
          scratch.scattered + BlockScratch::n_scattered * k;
        if constexpr (dim == 2)
          at.scatter<4, with_gradients>(scattered, write.data());
        else
          {
            at.scatter<4, false, node_size>(scattered, write.data());
            if constexpr (with_gradients)
              {
                double forces[4 + 4 * dim] = {};
                std::copy_n(scattered + 4, 4 * dim, forces + 4);
                at.scatter<4, true, node_size>(forces,
                                               write.data() + change_of_node);
              }
          }
        if (with_mass)
          at.scatter<1, false>(&points.mass[k], mass.data());
      }
  }

  void
  MeshTransfer::scatter(const TransferBlock &points,
                        BlockScratch        &scratch,
                        const bool           with_mass)
  {
    scatter_any<true>(points, scratch, with_mass);
  }

  void
  MeshTransfer::scatter_values(const TransferBlock &points,
                               BlockScratch        &scratch,
                               const bool           with_mass)
  {
    scatter_any<false>(points, scratch, with_mass);
  }

  void
  MeshTransfer::scatter_affine(const TransferBlock &points, BlockScratch &)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        Point<dim>     x;
        Tensor<2, dim> C;
        for (unsigned int c = 0; c < dim; ++c)
          {
            x[c] = points.x[c][k];
            for (unsigned int d = 0; d < dim; ++d)
              C[c][d] = points.c[dim * c + d][k];
          }
        functions_at(points, k).scatter_affine<node_size>(
          points.mass[k], C, x, space.node_positions(), write.data());
      }
  }

  void
  MeshTransfer::find_cells(const TransferBlock &points,
                           unsigned int        *cells) const
  {
    std::copy_n(points.cell, points.n, cells);
  }

  std::size_t
  MeshTransfer::n_stored_cells() const
  {
    return mesh.triangulation().n_active_cells();
  }

  void
  MeshTransfer::exchange(const bool with_mass)
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    const unsigned int n_nodes = space.n_local_nodes();
    // Momentum, force, and mass (in all components of a vector).
    for (unsigned int part = 0; part < (with_mass ? 3 : 2); ++part)
      {
        exchanged.zero_out_ghost_values();
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            exchanged.local_element(dim * i + d) =
              part < 2 ? write[node_size * i + change_of_node * part + d]
                       : mass[i];
        exchanged.compress(VectorOperation::add);
        exchanged.update_ghost_values();
        for (unsigned int i = 0; i < n_nodes; ++i)
          if (part < 2)
            for (unsigned int d = 0; d < dim; ++d)
              write[node_size * i + change_of_node * part + d] =
                exchanged.local_element(dim * i + d);
          else
            mass[i] = exchanged.local_element(dim * i);
      }
  }

  std::vector<Point<dim>>
  MeshTransfer::node_positions() const
  {
    return space.node_positions();
  }

  void
  MeshTransfer::for_each_node(
    const PointArrays & /* group */,
    const unsigned int                             number_of_group,
    const unsigned int                             p,
    const std::function<void(const unsigned int)> &f) const
  {
    constexpr double least_function = 1e-12; // below, the node does not move it
    const Functions &at             = functions[number_of_group];
    for (unsigned int i = 0; i < n; ++i)
      if (std::abs(at.N[n * p + i]) > least_function)
        f(at.nodes[n * p + i]);
  }

  void
  MeshTransfer::minimise_over_ranks(std::vector<double> &values)
  {
    exchanged.zero_out_ghost_values();
    for (unsigned int i = 0; i < values.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        exchanged.local_element(dim * i + d) = values[i];
    exchanged.compress(VectorOperation::min);
    exchanged.update_ghost_values();
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = exchanged.local_element(dim * i);
  }

  Point<dim>
  MeshTransfer::stored_place() const
  {
    return (*mesh.own_cells().begin())->center();
  }

  std::size_t
  MeshTransfer::memory() const
  {
    std::size_t bytes = read.memory_consumption() + write.memory_consumption() +
                        mass.memory_consumption() +
                        sums_of_cells.capacity() * sizeof(double);
    for (const Functions &at : functions)
      {
        bytes += at.nodes.capacity() * sizeof(unsigned int) +
                 at.N.capacity() * sizeof(double);
        for (const std::vector<double> &slopes : at.slopes)
          bytes += slopes.capacity() * sizeof(double);
      }
    return bytes;
  }
} // namespace geocone::GEOCONE_DIM
