// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/lexicographic.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/mesh/cell_search.h>
#include <geocone/points/seeding.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_seeding[] = {
      {"Particles/*", "Discretisation/Method", {"MPM", "explicit MPM"}},
      {"Particles/Points per direction",
       "Particles/Layout",
       {"Gauss", "sub-cells"}},
      {"Particles/Spacing", "Particles/Layout", {"lattice"}},
      {"Particles/Number", "Particles/Layout", {"random"}},
      {"Particles/Random seed", "Particles/Layout", {"random"}},
      {"Particles/File", "Particles/Layout", {"file"}}};
  } // namespace

  namespace
  {
    /** Seeds located in the mesh together. */
    constexpr std::size_t block_size = 1 << 15;

    /** Points are counted by unsigned integers. */
    constexpr double most_points = 4e9;

    /** More than any integration needs; the positions of a cell are stored. */
    constexpr unsigned int most_per_direction = 100;

    /** Distance (m) within which a point lies on a side of the body. */
    double
    rounding_of(const Geometry &geometry)
    {
      return geometry.shape == Geometry::Shape::file ? 0. : geometry.rounding();
    }

    /** Returns the part of a point's volume that is in the body: 1/2 for a point on a side,
     *  which rounding would put in or out. @param tolerance see rounding_of() */
    double
    share_of(const Geometry   &geometry,
             const Point<dim> &x,
             const double      tolerance)
    {
      // Opposite places beside a side are never on the same side of it.
      constexpr unsigned int n_places = 1 << dim;
      unsigned int           n_inside = 0;
      for (unsigned int place = 0; place < n_places; ++place)
        {
          Point<dim> near = x;
          for (unsigned int d = 0; d < dim; ++d)
            near[d] += (place >> d & 1 ? 1. : -1.) * tolerance / (1. + 0.6 * d);
          n_inside += geometry.contains(near);
        }
      return double(n_inside) / n_places;
    }

    InputError
    outside_mesh(const Point<dim> &x)
    {
      return InputError("the seed at (" + text_of_place(x) +
                        ") lies outside the background mesh"
                        "\n  allowed: points in the mesh\n"
                        "  remedy:  enlarge 'Mesh/Box'");
    }

    /** @throws InputError if a material has no points, or if there are too many
     *  @param n by material, of all ranks */
    void
    check_numbers(const std::vector<std::size_t> &n, const Scene &scene)
    {
      const std::string remedy =
        "\n  allowed: one point or more\n"
        "  remedy:  take smaller cells, a smaller 'Particles/Spacing' or a "
        "larger 'Particles/Number'";
      const std::size_t total =
        std::accumulate(n.begin(), n.end(), std::size_t(0));
      if (total == 0)
        throw InputError("the body has no particle" + remedy);
      // The first material has the remaining region, which can be empty.
      for (unsigned int i = 0; i < n.size(); ++i)
        if (n[i] == 0 && !scene.regions.may_be_empty(i))
          throw InputError("no particle lies in the region of the material '" +
                           scene.materials.name(i) + "'" + remedy);
      if (total > most_points)
        throw InputError(format("the body has %zu particles\n"
                                "  allowed: at most %g\n"
                                "  remedy:  take larger cells, or fewer "
                                "particles in each",
                                total,
                                most_points));
    }

    /** Positions in an interval (0, 1) for cell-based layouts. */
    Quadrature<1>
    places_in_interval(const bool are_gauss_points, const unsigned int k)
    {
      return are_gauss_points ? Quadrature<1>(QGauss<1>(k))
                              : Quadrature<1>(QIterated<1>(QMidpoint<1>(), k));
    }

    /** Largest number of Gauss points per direction in a simplex, by deal.II's
     *  rules. */
    constexpr unsigned int most_in_simplex = 5;

    /**
     * Positions in the unit simplex: rules of degree 2 k - 1 (1, 3, 7, 15 and
     * 19 points of triangles; 3 of degree 2), or the centres of k^2 equal
     * triangles.
     */
    Quadrature<dim>
    places_in_simplex(const bool are_gauss_points, const unsigned int k)
    {
      if (are_gauss_points && k <= 2)
        return QGaussSimplex<dim>(k);
      if (are_gauss_points || dim == 3)
        return QWitherdenVincentSimplex<dim>(k);
      std::vector<Point<dim>> centres;
      const auto              add = [&](const double x, const double y) {
        centres.emplace_back();
        centres.back()[0] = x / k;
        centres.back()[1] = y / k;
      };
      for (unsigned int j = 0; j < k; ++j)
        for (unsigned int i = 0; i + j < k; ++i)
          {
            add(i + 1. / 3., j + 1. / 3.);
            if (i + j + 1 < k)
              add(i + 2. / 3., j + 2. / 3.);
          }
      return Quadrature<dim>(
        centres, std::vector<double>(centres.size(), 0.5 / centres.size()));
    }
  } // namespace

  Seeding::Seeding(const ParameterFile &parameter_file)
    : ParameterAcceptor("/Particles")
    , folder_of_parameters(parameter_file.folder())
  {
    layout.declare(
      *this,
      "Layout",
      ". Gauss: Gauss points of each cell. Sub-cells: centres of sub-cells "
      "(not for tetrahedra). Lattice: squares or cubes, independent of the "
      "mesh. Points on a side of the body have half their volume. Random: "
      "uniformly distributed. File: from 'File'.");
    add_parameter(
      "Points per direction",
      k,
      dim == 2 ? "Gauss and sub-cells: k for k x k points in each cell; in "
                 "triangles k x k sub-cells, or 1, 3, 7, 15 or 19 Gauss points."
               : "Gauss and sub-cells: k for k x k x k points in each cell; in "
                 "tetrahedra Gauss points of degree 2 k - 1.");
    add_parameter("Spacing", spacing, "Lattice: spacing of the points [m].");
    add_parameter("Number", number, "Random: number of points in the body.");
    add_parameter(
      "Random seed", random_seed, "Random: seed of the random numbers.");
    add_parameter(
      "File",
      file,
      std::string("File: .csv file with the names of columns in the first "
                  "line, or .h5 file with a dataset for each: ") +
        (dim == 2
           ? "x, y (m), volume (m^2); optionally material (name, or number "
             "from 0), vx, vy (m/s), sxx, syy, sxy (Pa)"
           : "x, y, z (m), volume (m^3); optionally material (name, or number "
             "from 0), vx, vy, vz (m/s), sxx, syy, sxy, szz, syz, szx (Pa)") +
        ". Paths are relative to the folder of the parameter file, or else to "
        "the working folder.");
  }

  void
  Seeding::prepare(const Scene &scene)
  {
    if (layout == Layout::gauss || layout == Layout::sub_cells)
      {
        if (k == 0 || k > most_per_direction)
          throw InputError("Particles/Points per direction",
                           k,
                           "1 to " + std::to_string(most_per_direction),
                           "2 or 3 are usual");
      }
    else if (layout == Layout::lattice || layout == Layout::random)
      {
        if (scene.geometry.shape == Geometry::Shape::file)
          throw InputError("Particles/Layout",
                           layout.word(),
                           "Gauss | sub-cells | file, where the domain comes "
                           "from a .msh file",
                           "choose one of them");
        if (layout == Layout::lattice && !(spacing > 0.))
          throw InputError(
            "Particles/Spacing", spacing, "> 0", "half a cell size is usual");
        if (layout == Layout::random)
          scene.geometry.refuse_where("random points, whose volumes it would "
                                      "have to know",
                                      "set Particles/Layout = lattice");
        if (layout == Layout::random && number == 0)
          throw InputError("Particles/Number",
                           number,
                           ">= 1",
                           "four or more per cell are usual");
        check_effort(scene.geometry);
      }
    else
      file = existing_file(file,
                           folder_of_parameters,
                           "Particles/File",
                           "an existing .csv or .h5 file of points");
    if (scene.regions.have_groups())
      throw InputError(
        "Particles/Layout",
        layout.word(),
        "particles whose materials are found by region polygons, "
        "not by region numbers",
        "give a 'Region polygon' to each material");
  }

  unsigned int
  Seeding::points_per_direction() const
  {
    return layout == Layout::gauss || layout == Layout::sub_cells ? k : 0;
  }

  void
  Seeding::check_effort(const Geometry &geometry) const
  {
    const auto [lower, upper] = geometry.bounding_box();
    double tries = layout == Layout::lattice ? std::pow(spacing, -int(dim))
                                             : number / geometry.area();
    for (unsigned int d = 0; d < dim; ++d)
      tries *= upper[d] - lower[d];
    const std::string allowed = format(
      "at most %g points in the box around the body, which are tried one by "
      "one",
      10. * most_points);
    if (tries > 10. * most_points && layout == Layout::lattice)
      throw InputError(
        "Particles/Spacing", spacing, allowed, "half a cell size is usual");
    if (tries > 10. * most_points)
      throw InputError("Particles/Number",
                       number,
                       allowed,
                       "take fewer, or 'Particles/Layout' = Gauss for a body "
                       "that fills little of the box");
  }

  double
  Seeding::expected_number(const Scene                    &scene,
                           const BackgroundMesh::Expected &mesh) const
  {
    if (layout == Layout::file)
      return ParticleFile::expected_number(file);
    if (layout == Layout::random)
      return number;
    // The cells of a file are the body, independent of its area.
    const bool   is_file = scene.geometry.shape == Geometry::Shape::file;
    const double area    = is_file ? mesh.area : scene.geometry.area();
    if (layout == Layout::lattice)
      return area * std::pow(spacing, -int(dim));
    const double per_cell =
      !mesh.is_simplicial || layout == Layout::sub_cells
        ? std::pow(k, dim)
        : places_in_simplex(true, std::min(k, most_in_simplex)).size();
    return per_cell * mesh.n_cells * std::min(1., area / mesh.area);
  }

  std::string
  Seeding::size_parameter() const
  {
    return layout == Layout::lattice  ? "Particles/Spacing"
           : layout == Layout::random ? "Particles/Number"
           : layout == Layout::file   ? "Particles/File"
           : k > 4                    ? "Particles/Points per direction"
                                      : "";
  }

  void
  Seeding::for_each(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Take           &take) const
  {
    visit(scene, mesh, Detail::all, take);
  }

  void
  Seeding::for_each(const Scene                       &scene,
                    const CartesianGrid               &grid,
                    const std::array<unsigned int, 2> &columns,
                    const Take                        &take) const
  {
    visit(scene, grid, columns, Detail::all, take);
  }

  std::vector<std::size_t>
  Seeding::count(const Scene &scene, const BackgroundMesh &mesh) const
  {
    std::vector<std::size_t> n(scene.materials.size(), 0), all(n);
    visit(scene, mesh, Detail::material, [&](const Seed &seed) {
      ++n[seed.material];
    });
    Utilities::MPI::sum(n, mesh.triangulation().get_communicator(), all);
    check_numbers(all, scene);
    return n;
  }

  std::vector<Seed>
  Seeding::make(const Scene &scene, const BackgroundMesh &mesh) const
  {
    std::vector<Seed>        seeds;
    std::vector<std::size_t> n(scene.materials.size(), 0);
    visit(scene, mesh, Detail::all, [&](const Seed &seed) {
      ++n[seed.material];
      seeds.push_back(seed);
    });
    Utilities::MPI::sum(n, mesh.triangulation().get_communicator(), n);
    check_numbers(n, scene);
    return seeds;
  }

  std::vector<std::vector<std::size_t>>
  Seeding::count(const Scene         &scene,
                 const CartesianGrid &grid,
                 const MPI_Comm       comm) const
  {
    const unsigned int rank        = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks     = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int n_columns   = grid.axes[0].n_intervals;
    const unsigned int n_materials = scene.materials.size();
    const auto         border      = [&](const unsigned int r) {
      return static_cast<unsigned int>(1ULL * n_columns * r / n_ranks);
    };
    std::vector<std::size_t> n(std::size_t(n_columns) * n_materials, 0);
    visit(
      scene,
      grid,
      {{border(rank), border(rank + 1)}},
      Detail::material,
      [&](const Seed &seed) {
        ++n[std::size_t(grid.axes[0].interval(seed.position[0])) * n_materials +
            seed.material];
      });
    Utilities::MPI::sum(n, comm, n);
    std::vector<std::vector<std::size_t>> by_column;
    std::vector<std::size_t>              of_material(n_materials, 0);
    for (unsigned int column = 0; column < n_columns; ++column)
      {
        const auto first = n.begin() + std::size_t(column) * n_materials;
        by_column.emplace_back(first, first + n_materials);
        for (unsigned int m = 0; m < n_materials; ++m)
          of_material[m] += by_column.back()[m];
      }
    check_numbers(of_material, scene);
    return by_column;
  }

  void
  Seeding::visit(const Scene                       &scene,
                 const CartesianGrid               &grid,
                 const std::array<unsigned int, 2> &columns,
                 const Detail                       detail,
                 const Take                        &take) const
  {
    double volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= grid.axes[d].size;
    const double size = side_length(volume);
    if (points_per_direction() == 0)
      {
        visit_all(scene, [&](Block &block, const Given &given) {
          for (Seed &seed : block)
            {
              if (!grid.contains(seed.position))
                throw outside_mesh(seed.position);
              const unsigned int column =
                grid.axes[0].interval(seed.position[0]);
              if (column < columns[0] || column >= columns[1])
                continue;
              seed.cell = size;
              describe(seed, scene, given, detail);
              take(seed);
            }
        });
        return;
      }
    const double tolerance = rounding_of(scene.geometry);
    // Columns of cells, then cells in a column, then points in a cell.
    const Quadrature<dim> places(
      places_in_interval(layout == Layout::gauss, k));
    GridIndex n_cells;
    for (unsigned int d = 0; d < dim; ++d)
      n_cells[d] = grid.axes[d].n_intervals;
    n_cells[0] = 1;
    for (unsigned int i = columns[0]; i < columns[1]; ++i)
      for (std::size_t in_column = 0; in_column < grid_volume(n_cells);
           ++in_column)
        {
          GridIndex cell = index_in_grid(in_column, n_cells);
          cell[0]        = i;
          for (unsigned int q = 0; q < places.size(); ++q)
            {
              Seed seed;
              for (unsigned int d = 0; d < dim; ++d)
                seed.position[d] =
                  grid.axes[d].begin +
                  (cell[d] + places.point(q)[d]) * grid.axes[d].size;
              const double share =
                share_of(scene.geometry, seed.position, tolerance);
              if (share == 0.)
                continue;
              seed.volume = share * places.weight(q) * volume;
              seed.cell   = size;
              describe(seed, scene, Given(), detail);
              take(seed);
            }
        }
  }

  void
  Seeding::visit(const Scene          &scene,
                 const BackgroundMesh &mesh,
                 const Detail          detail,
                 const Take           &take) const
  {
    if (points_per_direction() == 0)
      {
        const CellSearch   cells(mesh);
        const unsigned int rank = Utilities::MPI::this_mpi_process(
          mesh.triangulation().get_communicator());
        visit_all(scene, [&](Block &block, const Given &given) {
          for (Seed &seed : block)
            {
              auto place = cells.find(seed.position);
              if (!place)
                throw outside_mesh(seed.position);
              if (mesh.n_layers() > 1)
                {
                  describe(seed, scene, given, Detail::material);
                  place->cell = mesh.cell_in_layer(
                    place->cell, scene.contacts.body_of(seed.material));
                }
              if (cells.owner(place->cell) != rank)
                continue;
              seed.cell = BackgroundMesh::size_of(place->cell);
              describe(seed, scene, given, detail);
              take(seed);
            }
        });
        return;
      }
    const bool simplicial = mesh.is_simplicial();
    if (simplicial && layout == Layout::sub_cells && dim == 3)
      throw InputError("Particles/Layout",
                       layout.word(),
                       "Gauss | lattice | random | file on tetrahedra",
                       "choose one of them");
    if (simplicial && layout == Layout::gauss && k > most_in_simplex)
      throw InputError("Particles/Points per direction",
                       k,
                       "1 to " + std::to_string(most_in_simplex) +
                         " for Gauss points of " +
                         (dim == 2 ? "triangles" : "tetrahedra"),
                       dim == 2 ? "set Particles/Layout = sub-cells"
                                : "set Particles/Layout = lattice");
    const Quadrature<dim> quadrature =
      simplicial
        ? places_in_simplex(layout == Layout::gauss, k)
        : Quadrature<dim>(places_in_interval(layout == Layout::gauss, k));
    const FE_Nothing<dim> nothing(simplicial
                                    ? ReferenceCells::get_simplex<dim>()
                                    : ReferenceCells::get_hypercube<dim>());
    FEValues<dim>         values(mesh.mapping(),
                         nothing,
                         quadrature,
                         update_JxW_values | update_quadrature_points);
    const double          tolerance = rounding_of(scene.geometry);
    for (const BackgroundMesh::Cell &cell : mesh.own_cells())
      {
        values.reinit(Triangulation<dim>::cell_iterator(cell));
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          if (const double share =
                share_of(scene.geometry, values.quadrature_point(q), tolerance);
              share > 0.)
            {
              Seed seed;
              seed.position = values.quadrature_point(q);
              seed.volume   = share * values.JxW(q);
              seed.cell     = BackgroundMesh::size_of(cell);
              if (mesh.n_layers() > 1)
                {
                  describe(seed, scene, Given(), Detail::material);
                  if (scene.contacts.body_of(seed.material) !=
                      mesh.layer_of(cell))
                    continue;
                }
              describe(seed, scene, Given(), detail);
              take(seed);
            }
      }
  }

  void
  Seeding::describe(Seed        &seed,
                    const Scene &scene,
                    const Given &given,
                    const Detail detail) const
  {
    if (!given[ParticleFile::material])
      seed.material = scene.regions.material_at(seed.position);
    if (detail == Detail::material)
      return;
    if (!given[ParticleFile::volume])
      seed.volume *= Geometry::measure(scene.geometry.symmetry, seed.position);
    if (!given[ParticleFile::vx])
      seed.velocity = scene.initial_velocity.at(seed.position);
    if (!given[ParticleFile::sxx])
      seed.stress = scene.initial_stress.at(
        seed.position, seed.material, scene.materials, scene.regions);
    seed.stress_zz =
      scene.initial_stress.zz_at(seed.position, seed.material, seed.stress);
  }

  void
  Seeding::visit_all(const Scene &scene, const TakeBlock &take) const
  {
    Given given = {};
    if (layout == Layout::file)
      {
        ParticleFile in(file, scene.materials);
        for (unsigned int c = 0; c < ParticleFile::n_columns; ++c)
          given[c] = in.has(static_cast<ParticleFile::Column>(c));
        for (Block block = in.read(block_size); !block.empty();
             block       = in.read(block_size))
          take(block, given);
        return;
      }

    const Geometry &geometry  = scene.geometry;
    const auto [lower, upper] = geometry.bounding_box();
    Block      block;
    Seed       seed;
    const auto add = [&]() {
      block.push_back(seed);
      if (block.size() < block_size)
        return;
      take(block, given);
      block.clear();
    };
    if (layout == Layout::lattice)
      {
        const double square    = spacing * spacing * (dim == 3 ? spacing : 1.);
        const double tolerance = rounding_of(geometry);
        // By index: summing spacings would accumulate rounding errors.
        const auto coordinate = [&](const double begin, const std::size_t i) {
          return begin + (i + 0.5) * spacing;
        };
        GridIndex n;
        for (unsigned int d = 0; d < dim; ++d)
          for (n[d] = 0; coordinate(lower[d], n[d]) < upper[d];)
            ++n[d];
        for (std::size_t i = 0; i < grid_volume(n); ++i)
          {
            const GridIndex index = index_in_grid(i, n);
            for (unsigned int d = 0; d < dim; ++d)
              seed.position[d] = coordinate(lower[d], index[d]);
            seed.volume = square * share_of(geometry, seed.position, tolerance);
            if (seed.volume > 0.)
              add();
          }
      }
    else
      {
        // The distributions of the standard library differ between
        // implementations.
        std::mt19937 engine(random_seed);
        const auto   uniform = [&]() { return (engine() + 0.5) / 4294967296.; };
        seed.volume          = geometry.area() / number;
        for (std::size_t n = 0; n < number;)
          {
            for (unsigned int c = 0; c < dim; ++c)
              seed.position[c] = lower[c] + uniform() * (upper[c] - lower[c]);
            if (!geometry.contains(seed.position))
              continue;
            add();
            ++n;
          }
      }
    if (!block.empty())
      take(block, given);
  }
} // namespace geocone::GEOCONE_DIM
