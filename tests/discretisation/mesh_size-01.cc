// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The numbers of cells that are estimated before a mesh is made: those of uniform
// and graded meshes must be those of the mesh, but for one where sizes are
// rounded; those of unstructured meshes must be within a factor of two of what
// gmsh makes.

#include <geocone/base/version.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/structured_mesh.h>
#include <geocone/scene/scene.h>

#include <deal.II/base/mpi.h>

#include "../test.h"

#include <cmath>
#include <cstdio>

namespace discretisation_mesh_size_01
{
  using namespace geocone;

  /** Scene and parameters of the mesh of a parameter file with overrides. */
  struct Setup
  {
    explicit Setup(const std::vector<std::string> &overrides)
      : file((dealii::ParameterAcceptor::clear(),
              GEOCONE_SOURCE_DIR "/tests/discretisation/box.prm"),
             overrides)
      , scene(file)
    {
      file.parse();
      scene.prepare();
      mesh.prepare(scene.geometry, method);
    }

    ParameterFile  file;
    Method         method;
    Scene          scene;
    MeshParameters mesh;
  };

  void
  check_grid(const std::string &name, const std::vector<std::string> &overrides)
  {
    const Setup setup(overrides);
    const auto  expected = grid_size(setup.mesh);
    const auto  lines    = grid_lines(setup.mesh);
    // In each direction one grading point inside: two pieces.
    bool holds = true;
    for (unsigned int c = 0; c < dim; ++c)
      holds &= std::abs(expected[c] - (lines[c].size() - 1.)) <=
               (setup.mesh.type == MeshParameters::Type::graded ? 2. : 0.);
    std::printf("%s: %s\n", name.c_str(), holds ? "yes" : "NO");
  }

  void
  check_unstructured(const std::string       &name,
                     std::vector<std::string> overrides)
  {
    overrides.push_back("Discretisation/Method = FEM");
    overrides.push_back("Mesh/Box =");
    overrides.push_back("Mesh/Type = unstructured");
    const Setup  setup(overrides);
    const double expected = unstructured_size(setup.mesh);
    const auto   n =
      unstructured_mesh(setup.mesh, setup.scene.regions, {}, MPI_COMM_WORLD)
        .cells.size();
    const bool holds = expected > n / 2. && expected < 2. * n;
    std::printf("%s: %s\n", name.c_str(), holds ? "yes" : "NO");
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);

    check_grid("uniform", {"Mesh/Cell size = 0.013"});
    check_grid("uniform, one cell", {"Mesh/Cell size = 100"});
    for (const std::string growth :
         {"1.000000000000001", "1.01", "1.3", "1000"})
      for (const std::string smallest : {"0.001", "0.003", "0.4"})
        check_grid("graded from " + smallest + " by " + growth,
                   {"Mesh/Type = graded",
                    "Mesh/Grading points = 0.3, 1.1",
                    "Mesh/Smallest size = " + smallest,
                    "Mesh/Largest size = 0.4",
                    "Mesh/Growth factor = " + growth});

    check_unstructured("triangles of one size", {"Mesh/Cell size = 0.04"});
    check_unstructured("triangles, graded",
                       {"Mesh/Grading points = 0.1, 0",
                        "Mesh/Smallest size = 0.001",
                        "Mesh/Largest size = 0.3",
                        "Mesh/Size ratio = 0.18"});
    check_unstructured("quadrilaterals in a polygon, graded from two points",
                       {"Geometry/Shape = polygon",
                        "Geometry/Polygon = 0, 0; 3, 0; 3, 1; 2, 1; 1, 3; 0, 3",
                        "Mesh/Cells = quadrilaterals",
                        "Mesh/Grading points = 2, 1; 1, 3",
                        "Mesh/Smallest size = 0.01",
                        "Mesh/Largest size = 0.5",
                        "Mesh/Size ratio = 0.2"});
    // The numbers of the formula that gmsh gets have exponents here.
    check_unstructured("triangles in a small box, graded",
                       {"Geometry/Box = 0, 0; 1e-4, 1e-4",
                        "Mesh/Grading points = 1e-5, 2e-5",
                        "Mesh/Smallest size = 2e-7",
                        "Mesh/Largest size = 3e-5",
                        "Mesh/Size ratio = 0.3"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_mesh_size_01
