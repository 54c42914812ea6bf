// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Every place of a mesh must be found, in a cell that has it, whichever rank asks
// and however far the cell is in which it was before; a place on the border of
// cells in the same cell by all ranks; a place outside of the mesh, or one that is
// not a number, in none.

#include "../test.h"
#include "setup.h"

#include <geocone/mesh/cell_search.h>

#include <cmath>
#include <limits>
#include <random>

namespace discretisation_cell_search_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;

  void
  check(const std::string &name, const std::vector<std::string> &overrides)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare();
    const BackgroundMesh &mesh = setup.mesh;
    const CellSearch      search(mesh);
    if (speaks())
      std::printf("%s\n", name.c_str());

    const unsigned int n_cells = mesh.triangulation().n_active_cells();
    const unsigned int rank    = mpi::this_mpi_process(MPI_COMM_WORLD);
    const auto         is_at   = [&](const CellSearch::Location &place,
                           const Point<dim>           &x) {
      return mesh.mapping()
               .transform_unit_to_real_cell(place.cell, place.unit)
               .distance(x) < 1e-12;
    };

    // All places of the box lie in the mesh of squares and in that of triangles.
    std::mt19937 engine(1);
    const auto   uniform = [&]() { return (engine() + 0.5) / 4294967296.; };
    bool         found = true, with_hint = true, owned = true;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const Point<dim> x(uniform(), uniform());
        const auto       place = search.find(x);
        found &= place && is_at(*place, x);
        const auto again = search.find(x, search.cell(engine() % n_cells));
        with_hint &= again && again->cell == place->cell;
        owned &= place && (search.owner(place->cell) == rank) ==
                            place->cell->is_locally_owned();
      }
    print("found", found);
    print("the same from any other cell", with_hint);
    print("owners are known", owned);

    // Vertices and middles of edges: by all ranks the same.
    bool                      on_border = true;
    std::vector<unsigned int> cells;
    for (unsigned int c = 0; c < n_cells; ++c)
      for (const unsigned int f : search.cell(c)->face_indices())
        for (const Point<dim> &x : {search.cell(c)->face(f)->vertex(0),
                                    search.cell(c)->face(f)->center()})
          {
            const auto place = search.find(x);
            on_border &= place && is_at(*place, x);
            cells.push_back(place ? place->cell->active_cell_index() : n_cells);
            // From a cell that has it: there.
            const auto here = search.find(x, search.cell(c));
            on_border &= here && here->cell == search.cell(c);
          }
    print("found on borders", on_border);
    std::vector<unsigned int> most(cells), least(cells);
    mpi::max(cells, MPI_COMM_WORLD, most);
    mpi::min(cells, MPI_COMM_WORLD, least);
    print("by all ranks in the same cell", most == least);

    const double nan    = std::numeric_limits<double>::quiet_NaN();
    bool         absent = true;
    for (const Point<dim> &x : {Point<dim>(-1e-3, 0.5),
                                Point<dim>(0.5, 1.3),
                                Point<dim>(1e300, 0.),
                                Point<dim>(nan, 0.5),
                                Point<dim>(0.5, -nan)})
      absent &= !search.find(x) && !search.find(x, search.cell(0));
    print("not found outside", absent);
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    check("squares", {});
    check(
      "distorted quadrilaterals",
      {"Geometry/Shape = file", "Geometry/File = distorted.msh", "Mesh/Box ="});
    check("triangles",
          {"Mesh/Type = unstructured",
           "Mesh/Cells = triangles",
           "Mesh/Cell size = 0.2"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_cell_search_01
