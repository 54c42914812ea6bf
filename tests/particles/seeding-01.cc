// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Every layout must fill the body: right volume, right materials, each point on
// exactly one rank, and the same points on every number of ranks. What cannot be
// seeded must be refused by all ranks together.

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/version.h>
#include <geocone/points/seeding.h>

#include <deal.II/base/mpi.h>

#include "../test.h"

#include <cmath>
#include <cstdio>
#include <fstream>

namespace particles_seeding_01
{
  using namespace geocone;
  using dealii::Utilities::MPI::sum;

  const MPI_Comm comm = MPI_COMM_WORLD;

  bool
  speaks()
  {
    return dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  }

  /** Sums over the points of all ranks; or the message that refuses them. */
  void
  seed(const std::string &name, const std::vector<std::string> &overrides)
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file(GEOCONE_SOURCE_DIR "/tests/particles/seeding.prm",
                             overrides);
    Method              method;
    Scene               scene(file);
    BackgroundMesh      mesh(comm);
    Seeding             seeding(file);
    try
      {
        file.parse();
        scene.prepare();
        seeding.prepare(scene);
        mesh.prepare(scene, method);
        const std::vector<Seed> seeds  = seeding.make(scene, mesh);
        const auto              n      = seeding.count(scene, mesh);
        std::size_t             n_same = 0;
        seeding.for_each(scene, mesh, [&](const Seed &s) {
          n_same += n_same < seeds.size() &&
                    s.position == seeds[n_same].position &&
                    s.stress == seeds[n_same].stress;
        });
        const bool same = n_same == seeds.size() && n[0] + n[1] == seeds.size();

        double                 n_points[2] = {}, volume = 0.;
        dealii::Tensor<1, dim> moment, velocity;
        Mandel                 stress = Mandel::Zero();
        bool                   inside = true;
        for (const Seed &s : seeds)
          {
            n_points[s.material] += 1.;
            volume += s.volume;
            moment += s.volume * dealii::Tensor<1, dim>(s.position);
            velocity += s.velocity;
            stress += s.stress;
            inside &= scene.geometry.contains(s.position);
          }
        const double clay = sum(n_points[0], comm),
                     sand = sum(n_points[1], comm);
        volume            = sum(volume, comm);
        moment            = sum(moment, comm);
        velocity          = sum(velocity, comm);
        for (int i = 0; i < n_mandel; ++i)
          stress[i] = sum(stress[i], comm);
        inside = sum(inside && same ? 0 : 1, comm) == 0;
        if (speaks())
          {
            std::printf("%s: k = %u, %g + %g points, volume %.8f, centre %.8f "
                        "%.8f\n",
                        name.c_str(),
                        seeding.points_per_direction(),
                        clay,
                        sand,
                        volume,
                        moment[0] / volume,
                        moment[1] / volume);
            std::printf(
              "  velocities %.8f %.8f, stresses %.8f %.8f %.8f, inside "
              "the body, thrice the same: %s\n",
              velocity[0],
              velocity[1],
              stress[0],
              stress[1],
              stress[2],
              inside ? "yes" : "no");
            if (scene.geometry.shape != Geometry::Shape::file)
              std::printf("  area of the body %.8f\n", scene.geometry.area());
            // The box of seeding.prm has 16 x 12 cells of 0.1 m.
            BackgroundMesh::Expected cells;
            cells.n_cells         = 16. * 12.;
            cells.area            = 1.92;
            cells.is_simplicial   = false;
            const double expected = seeding.expected_number(scene, cells);
            if (mesh.grid()[0].size() == 17)
              std::printf("  about as many as expected: %s\n",
                          std::abs(clay + sand - expected) <= 0.1 * expected
                            ? "yes"
                            : "no");
          }
      }
    catch (const InputError &error)
      {
        if (speaks())
          std::printf("%s: %s\n", name.c_str(), error.what());
      }
  }

  /** Writes a file once for all ranks. */
  void
  write(const std::string &name, const std::string &content)
  {
    if (speaks())
      std::ofstream(name) << content;
    MPI_Barrier(comm);
  }

  void
  seed_csv(const std::string &name, const std::string &content)
  {
    write("points.csv", content);
    seed(name, {"Particles/Layout = file", "Particles/File = points.csv"});
    MPI_Barrier(comm);
  }

  void
  seed_hdf5(const std::string                                &name,
            const std::map<std::string, std::vector<double>> &columns)
  {
    if (speaks())
      {
        Hdf5File out("points.h5", Hdf5File::Access::create);
        for (const auto &[column, values] : columns)
          out.write(column, values);
        out.close();
      }
    MPI_Barrier(comm);
    seed(name, {"Particles/Layout = file", "Particles/File = points.h5"});
    MPI_Barrier(comm);
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    const std::string graded  = "Mesh/Type = graded",
                      gauss   = "Particles/Layout = Gauss",
                      parts   = "Particles/Layout = sub-cells",
                      lattice = "Particles/Layout = lattice",
                      random  = "Particles/Layout = random",
                      three   = "Particles/Points per direction = 3";
    seed("box, default", {});
    seed("box, 3 x 3 Gauss points", {gauss, three});
    seed("box, 3 x 3 sub-cells", {parts, three});
    seed("box, lattice", {lattice, "Particles/Spacing = 0.04"});
    seed("box, random", {random, "Particles/Number = 500"});
    seed("box, other random points",
         {random, "Particles/Number = 500", "Particles/Random seed = 2"});
    // Grid lines on the border of the body.
    const std::vector<std::string> points = {graded,
                                             "Mesh/Box = 0, 0; 1.2, 0.8",
                                             "Mesh/Grading points = 0.3, 0.8",
                                             "Mesh/Smallest size = 0.02"};
    for (const std::string &layout : {gauss, parts})
      {
        std::vector<std::string> all = points;
        all.push_back(layout);
        seed("graded grid, " + layout, all);
      }

    const std::string polygon = "Geometry/Shape = polygon",
                      house =
                        "Geometry/Polygon = 0, 0; 1.2, 0; 1.2, 0.5; 0.6, 0.8; "
                        "0, 0.5";
    seed("polygon, lattice", {polygon, house, lattice});
    seed("polygon, random", {polygon, house, random});
    const std::string discs   = "Geometry/Shape = discs",
                      centres = "Geometry/Centres = 0.3, 0.4; 0.9, 0.4",
                      radius  = "Geometry/Radii = 0.3";
    seed("discs, Gauss", {discs, centres, radius, gauss, three});
    seed("discs, sub-cells", {discs, centres, radius, parts, three});
    seed("discs, lattice",
         {discs, centres, radius, lattice, "Particles/Spacing = 0.02"});
    seed("discs, random", {discs, centres, radius, random});
    seed("discs of two sizes",
         {discs,
          "Geometry/Centres = 0.3, 0.4; 0.9, 0.4",
          "Geometry/Radii = 0.4, 0.2",
          random});

    // Points on the vertices of the mesh belong to one rank only.
    std::string vertices = "x,y,volume\n";
    for (int i = -2; i <= 14; ++i)
      for (int j = -2; j <= 10; ++j)
        vertices +=
          std::to_string(i / 10.) + "," + std::to_string(j / 10.) + ",1\n";
    seed_csv("all vertices", vertices);
    seed_csv("few columns", "x,y,volume\n0.1,0.1,0.5\n1.1,0.2,0.25\n");
    seed_csv("all columns",
             "volume, x, y, material, vx, vy, sxx, syy, sxy\r\n"
             "0.5, 0.1, 0.1, sand, 1, 2, 10, 20, 30\r\n"
             "0.25, 1.1, 0.2, 0, 3, 4, 1e2, 2e2, 3e2\r\n");
    std::map<std::string, std::vector<double>> columns = {
      {"volume", {0.5, 0.25}}, {"x", {0.1, 1.1}}, {"y", {0.1, 0.2}}};
    seed_hdf5("few datasets", columns);
    auto all_columns = columns;
    all_columns.insert({{"material", {1., 0.}},
                        {"vx", {1., 3.}},
                        {"vy", {2., 4.}},
                        {"sxx", {10., 100.}},
                        {"syy", {20., 200.}},
                        {"sxy", {30., 300.}}});
    seed_hdf5("all datasets", all_columns);

    seed_csv("byte-order mark, quotes, blank lines at the end",
             "\xEF\xBB\xBF\"x\",\"y\",volume,material\n"
             "+0.1,0.1,0.5,\"sand\"\n1.1,0.2,0.25,\"0\"\n\n \r\n\n");

    // Four cells that are no parallelograms, with points on their common edges.
    write("cells.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n"
          "1 0 0 0\n2 0.4 0 0\n3 1 0 0\n4 0 0.6 0\n5 0.55 0.45 0\n6 1 0.5 0\n"
          "7 0 1 0\n8 0.5 1 0\n9 1 1 0\n$EndNodes\n$Elements\n4\n"
          "1 3 2 0 1 1 2 5 4\n2 3 2 0 1 2 3 6 5\n3 3 2 0 1 4 5 8 7\n"
          "4 3 2 0 1 5 6 9 8\n$EndElements\n");
    const std::string shape = "Geometry/Shape = file",
                      msh = "Geometry/File = cells.msh", box = "Mesh/Box = ";
    seed("distorted cells, Gauss", {shape, msh, box, gauss});
    seed("distorted cells, sub-cells", {shape, msh, box, parts});
    write("points.csv",
          "x,y,volume\n0.55,0.45,1\n0.475,0.225,1\n0.45,0.15,1\n0.275,0.525,1\n"
          "0.7,0.46666666666666667,1\n0.525,0.725,1\n0,0,1\n1,1,1\n");
    seed("distorted cells, file",
         {shape,
          msh,
          box,
          "Particles/Layout = file",
          "Particles/File = points.csv"});

    seed("layout", {"Particles/Layout = hexagons"});
    seed("k", {"Particles/Points per direction = 0"});
    seed("spacing", {lattice, "Particles/Spacing = 0"});
    seed("number", {random, "Particles/Number = 0"});
    seed("large k", {"Particles/Points per direction = 65536"});
    seed("small spacing", {lattice, "Particles/Spacing = 1e-7"});
    seed("random points in a sliver",
         {random,
          "Particles/Number = 1000000",
          "Geometry/Shape = polygon",
          "Geometry/Polygon = 0, 0; 1, 1; 0, 1e-8"});
    seed("lattice in a file's domain", {shape, msh, box, lattice});
    seed("radii", {discs, centres, "Geometry/Radii = 0.1, 0.2, 0.3"});
    seed("radius", {discs, centres, "Geometry/Radii = 0"});
    seed("overlap", {discs, centres, "Geometry/Radii = 0.31"});
    seed("no points", {lattice, "Particles/Spacing = 3"});
    seed("no points of a material",
         {"Materials/sand/Region polygon = 2, 0; 3, 0; 2, 1"});
    seed("no file", {"Particles/Layout = file", "Particles/File = none.csv"});
    seed_csv("empty file", "");
    seed_csv("unknown column", "x,y,volume,mass\n");
    seed_csv("repeated column", "x,y,volume,x\n");
    seed_csv("missing column", "x,volume\n0,1\n");
    seed_csv("half a velocity", "x,y,volume,vy\n0,0,1,1\n");
    seed_csv("blank line", "x,y,volume\n0,0,1\n\n0,0,1\n");
    seed_csv("no text", std::string("x,y,volume\n0,0,\0,1\n", 19));
    seed_csv("a thousand columns", "x" + std::string(1000, ',') + "\n");
    seed_csv("a line without end", std::string(1 << 20, ','));
    seed_csv("large stress", "x,y,volume,sxx,syy,sxy\n0,0,1,1e300,0,0\n");
    seed_csv("larger number", "x,y,volume\n0,0,1\n1e999,0,1\n");
    seed_csv("tiny volume", "x,y,volume\n0,0,1e-200\n");
    seed("no regular file",
         {"Particles/Layout = file", "Particles/File = /dev/zero"});
    seed_csv("header only", "x,y,volume\n");
    seed_csv("missing value", "x,y,volume\n0,0,1\n0,0\n");
    seed_csv("no number", "x,y,volume\n0,0,1\n0,0,one\n");
    seed_csv("infinite number", "x,y,volume\n0,inf,1\n");
    seed_csv("no volume", "x,y,volume\n0,0,1\n0,0,-1\n");
    seed_csv("unknown material", "x,y,volume,material\n0,0,1,peat\n");
    seed_csv("unknown number of material", "x,y,volume,material\n0,0,1,2\n");
    seed_csv("outside the mesh", "x,y,volume\n0,0,1\n1.5,0.5,1\n");
    write("points.h5", "x,y,volume\n0,0,1\n");
    seed("no HDF5 file",
         {"Particles/Layout = file", "Particles/File = points.h5"});
    columns["volume"] = {0.5, 0.};
    seed_hdf5("no volume in HDF5", columns);
    columns["volume"] = {0.5};
    seed_hdf5("short dataset", columns);
    columns.erase("volume");
    seed_hdf5("missing dataset", columns);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace particles_seeding_01
