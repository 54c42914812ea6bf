// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A mesh of 40 x 40 squares or twice as many triangles of which each rank stores its own cells
// and their neighbours only must be the mesh that each rank stores whole: the same cells by
// their CellId, lengths of all sides, box and connected parts of a body of two strips, of which
// one winds through all ranks. A rank stores the ring of cells around its own beside these.

#include "../test.h"
#include "setup.h"

#include <map>

namespace discretisation_divided_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;

  /** Centre and part of the body of a cell; 0 where it has none. */
  using Cells = std::map<dealii::CellId, std::pair<Point<dim>, unsigned int>>;

  struct Result
  {
    Cells                                        own;
    std::map<dealii::types::boundary_id, double> lengths;
    std::vector<dealii::types::boundary_id>      of_all_sides;
    dealii::BoundingBox<dim>                     box;
    double                                       n_stored, n_own, n_parts;
  };

  Result
  examine(const std::vector<std::string> &overrides, const bool may_divide)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare(may_divide);
    const BackgroundMesh &mesh = setup.mesh;
    Result                result;
    // Two strips: a spiral from outside to the centre, and what it leaves.
    const auto is_in_body = [](const Point<dim> &x) {
      return x[0] < 0.25 || x[1] > 1. || (x[0] > 1. && x[1] > 0.25) ||
             (x[1] < 0.5 && x[1] > 0.25 && x[0] > 0.5) ||
             (x[0] > 0.5 && x[0] < 0.75 && x[1] < 0.75 && x[1] > 0.6);
    };
    std::vector<BackgroundMesh::Cell> body;
    for (const auto &cell : mesh.own_cells())
      {
        result.own[cell->id()] = {cell->center(), 0};
        if (is_in_body(cell->center()))
          body.push_back(cell);
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            result.lengths[cell->face(f)->boundary_id()] +=
              cell->face(f)->measure();
      }
    const std::vector<unsigned int> parts = mesh.connected_parts(body);
    for (std::size_t i = 0; i < body.size(); ++i)
      result.own[body[i]->id()].second = parts[i] + 1;
    unsigned int n_parts = 0;
    for (const unsigned int part : parts)
      n_parts = std::max(n_parts, part + 1);
    for (const auto id : {0, 1, 2, 3})
      result.lengths[id] = mpi::sum(result.lengths[id], comm);
    for (const auto id : mesh.side_ids(*setup.scene.dirichlet.list.back()))
      result.of_all_sides.push_back(id);
    result.box      = mesh.bounding_box();
    result.n_stored = mesh.triangulation().n_active_cells();
    result.n_own    = result.own.size();
    result.n_parts  = mpi::max(n_parts, comm);
    return result;
  }

  void
  check(const std::string &name, std::vector<std::string> overrides)
  {
    overrides.push_back("Mesh/Cell size = 0.03125");
    const Result divided = examine(overrides, true);
    overrides.push_back("Mesh/Triangulation = shared");
    const Result whole = examine(overrides, false);

    Cells all_divided, all_whole;
    for (const auto &own : mpi::all_gather(comm, divided.own))
      all_divided.insert(own.begin(), own.end());
    for (const auto &own : mpi::all_gather(comm, whole.own))
      all_whole.insert(own.begin(), own.end());
    if (speaks())
      std::printf("%s: %zu cells, %g connected parts\n",
                  name.c_str(),
                  all_divided.size(),
                  divided.n_parts);
    bool same_cells = all_divided.size() == all_whole.size(), same_parts = true;
    std::map<unsigned int, unsigned int> other_number;
    for (const auto &[id, cell] : all_divided)
      {
        const auto found = all_whole.find(id);
        same_cells &= found != all_whole.end() &&
                      found->second.first.distance(cell.first) < 1e-14;
        if (same_cells)
          same_parts &= other_number.emplace(cell.second, found->second.second)
                          .first->second == found->second.second;
      }
    print("the same cells", same_cells);
    print("the same connected parts", same_parts);
    bool same_sides = divided.of_all_sides == whole.of_all_sides;
    for (const auto &[id, length] : whole.lengths)
      same_sides &= std::abs(divided.lengths.at(id) - length) < 1e-13;
    print("the same sides", same_sides);
    print("the same box", divided.box == whole.box);
    const double n_ranks = mpi::n_mpi_processes(comm);
    print("cells divided equally",
          divided.n_own < 1.05 * all_divided.size() / n_ranks);
    const double ring = n_ranks == 1. ? 0. : 0.25 * divided.n_own;
    print("no more stored than these and a ring",
          divided.n_stored <= divided.n_own + ring);
    print("whole mesh stored without division",
          whole.n_stored == all_whole.size());
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    check("squares", {"Discretisation/Element = Q1"});
    check("triangles",
          {"Discretisation/Element = P1", "Mesh/Cells = triangles"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_divided_01
