// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A mesh is parted anew between the ranks, by weights that grow to the right, after its lines
// have moved if it is a grid: each rank must get as much of the weights, but for a column of
// cells, vertices must stay where they were, each cell must have one owner that all ranks
// know, and all cells must be found; nodes must be as many as before, each of one rank, and
// linear fields exact.

#include <geocone/mesh/cell_search.h>

#include "../test.h"
#include "setup.h"

#include <cmath>

namespace discretisation_repartition_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;
  using dealii::Tensor;

  void
  check(const std::string &name, const std::vector<std::string> &overrides)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare();
    BackgroundMesh &mesh  = setup.mesh;
    Space          &space = setup.space;
    if (speaks())
      std::printf("%s:\n", name.c_str());

    if (auto lines = mesh.grid(); !lines[0].empty())
      {
        for (double &x : lines[0])
          x = x * x / lines[0].back();
        mesh.move_grid(lines);
        space.follow_grid();
      }
    const auto n_nodes  = space.n_nodes();
    const auto vertices = mesh.triangulation().get_vertices();
    const auto weight   = [](const BackgroundMesh::Cell &cell) {
      return 1 + static_cast<unsigned int>(100. * cell->center()[0]);
    };
    mesh.repartition(weight);
    space.follow_ranks();

    double       weights = 0.;
    unsigned int n_cells = 0;
    for (const auto &cell : mesh.own_cells())
      {
        weights += weight(cell);
        ++n_cells;
      }
    const double all = mpi::sum(weights, comm), most = mpi::max(weights, comm);
    print("equal weights", most < 1.3 * all / mpi::n_mpi_processes(comm));
    print("not equal numbers of cells",
          mpi::n_mpi_processes(comm) == 1 ||
            mpi::max(n_cells, comm) > mpi::min(n_cells, comm) + 2);
    print("vertices where they were",
          vertices == mesh.triangulation().get_vertices());
    print("each cell on one rank",
          mpi::sum(n_cells, comm) == mesh.triangulation().n_active_cells());

    const CellSearch search(mesh);
    bool             found = true;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      {
        const auto place = search.find(cell->center());
        found            = found && place && place->cell == cell;
      }
    print("all cells found", found);
    bool owned = true;
    for (const auto &cell : mesh.own_cells())
      owned = owned && search.owner(cell) ==
                         dealii::Utilities::MPI::this_mpi_process(comm);
    print("owners known", owned);

    print("as many nodes",
          space.n_nodes() == n_nodes &&
            mpi::sum(space.n_owned_nodes(), comm) == n_nodes);
    const unsigned int                           n = space.nodes_per_cell();
    std::vector<double>                          N(n);
    std::vector<Tensor<1, dim>>                  gradient(n);
    std::vector<dealii::types::global_dof_index> nodes;
    double                                       error = 0.;
    for (const auto &cell : mesh.own_cells())
      {
        Point<dim> unit;
        unit[0] = 0.3;
        unit[1] = 0.45;
        space.cell_nodes(cell, nodes);
        space.evaluate(cell, unit, N.data(), gradient.data());
        Point<dim> x;
        for (unsigned int i = 0; i < n; ++i)
          x += N[i] * space.node_positions()[space.local_node(nodes[i])];
        error = std::max(
          error,
          x.distance(mesh.mapping().transform_unit_to_real_cell(cell, unit)));
      }
    print("linear fields exact", error < 1e-13);
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize init(argc, argv, 1);
    check("Q1", {"Discretisation/Element = Q1", "Mesh/Cell size = 0.125"});
    check("B-spline 3",
          {"Discretisation/Element = B-spline 3", "Mesh/Cell size = 0.125"});
    check("P2",
          {"Discretisation/Element = P2",
           "Mesh/Cells = triangles",
           "Mesh/Cell size = 0.125"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_repartition_01
