// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/seeding.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_tools_cache.h>

#include <deal.II/numerics/rtree.h>

#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** Columns of a file of points by name, all of the same length. */
    using Table = std::map<std::string, std::vector<double>>;

    const std::vector<std::string> column_names = {
      "x", "y", "volume", "material", "vx", "vy", "sxx", "syy", "sxy"};

    InputError
    refused(const std::string &file, const std::string &what)
    {
      return InputError("Particles/File",
                        file,
                        "a .csv or .h5 file of x, y, volume > 0 and, if given, "
                        "material, vx and vy, sxx and syy and sxy",
                        what);
    }

    std::string
    line_and_column(const std::size_t line, const std::string &column)
    {
      return "line " + std::to_string(line) + ", column '" + column + "': ";
    }

    /** A line cut at its commas. */
    std::vector<std::string>
    cut(const std::string &line)
    {
      std::vector<std::string> parts(1);
      for (const char c : line)
        if (c == ',')
          parts.emplace_back();
        else
          parts.back() += c;
      for (std::string &part : parts)
        part = Utilities::trim(part);
      return parts;
    }

    Table
    read_csv(const std::string &file, const Materials &materials)
    {
      std::map<std::string, double> number_of_material;
      for (unsigned int i = 0; i < materials.size(); ++i)
        number_of_material[materials.name(i)] = i;

      std::ifstream in(file);
      std::string   line;
      std::getline(in, line);
      const std::vector<std::string> header = cut(line);
      Table                          table;
      for (const std::string &name : header)
        if (std::find(column_names.begin(), column_names.end(), name) ==
              column_names.end() ||
            !table.emplace(name, std::vector<double>()).second)
          throw refused(file,
                        line_and_column(1, name) +
                          "not one of these names, or there twice");

      for (std::size_t n = 2; std::getline(in, line); ++n)
        {
          const std::vector<std::string> values = cut(line);
          if (values.size() != header.size())
            throw refused(file,
                          format("line %zu: %zu values instead of %zu",
                                 n,
                                 values.size(),
                                 header.size()));
          for (std::size_t c = 0; c < header.size(); ++c)
            {
              const auto named = number_of_material.find(values[c]);
              double     value = 0.;
              if (header[c] == "material" && named != number_of_material.end())
                value = named->second;
              else
                try
                  {
                    value = Utilities::string_to_double(values[c]);
                  }
                catch (const ExceptionBase &)
                  {
                    throw refused(
                      file,
                      line_and_column(n, header[c]) + "'" + values[c] +
                        (header[c] == "material" ? "' is no material"
                                                 : "' is not a number"));
                  }
              table[header[c]].push_back(value);
            }
        }
      return table;
    }

    /** An object of the HDF5 library, closed with its scope. */
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id(id)
        , close(close)
      {}
      Handle(const Handle &) = delete;
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    Table
    read_hdf5(const std::string &file)
    {
      // By the C interface: all ranks read, and that of deal.II would open the
      // file for writing. What fails is reported here, not by the library.
      hid_t id = -1;
      H5E_BEGIN_TRY
      {
        id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      }
      H5E_END_TRY;
      const Handle in(id, H5Fclose);
      if (in < 0)
        throw refused(file, "it cannot be read as an HDF5 file");
      Table table;
      for (const std::string &name : column_names)
        if (H5Lexists(in, name.c_str(), H5P_DEFAULT) > 0)
          {
            const Handle set(H5Dopen(in, name.c_str(), H5P_DEFAULT), H5Dclose);
            const Handle space(H5Dget_space(set), H5Sclose);
            if (H5Sget_simple_extent_ndims(space) != 1)
              throw refused(file,
                            "the dataset '" + name + "' has not one dimension");
            hsize_t size;
            H5Sget_simple_extent_dims(space, &size, nullptr);
            std::vector<double> &values = table[name];
            values.resize(size);
            if (H5Dread(set,
                        H5T_NATIVE_DOUBLE,
                        H5S_ALL,
                        H5S_ALL,
                        H5P_DEFAULT,
                        values.data()) < 0)
              throw refused(file,
                            "the dataset '" + name + "' does not hold numbers");
          }
      return table;
    }

    /** What is wrong with a value in a column; empty: nothing. */
    std::string
    objection(const std::string &column,
              const double       value,
              const Materials   &materials)
    {
      const std::string text = format("%g ", value);
      if (!std::isfinite(value))
        return text + "is not a finite number";
      if (column == "volume" && value <= 0.)
        return text + "is not > 0";
      if (column == "material" && (value < 0. || value >= materials.size() ||
                                   value != std::floor(value)))
        return text + "is no material: they are counted from 0 to " +
               std::to_string(materials.size() - 1);
      return "";
    }

    /** @throws InputError for missing columns and impossible values */
    void
    check_table(const Table       &table,
                const std::string &file,
                const bool         is_csv,
                const Materials   &materials)
    {
      const auto is_there = [&](const std::string &name) {
        return table.count(name) > 0;
      };
      // The columns of a group come together; those of the first one must come.
      const std::vector<std::vector<std::string>> groups = {
        {"x", "y", "volume"}, {"vx", "vy"}, {"sxx", "syy", "sxy"}};
      for (const auto &group : groups)
        if (group == groups[0] ||
            std::any_of(group.begin(), group.end(), is_there))
          for (const std::string &name : group)
            if (!is_there(name))
              throw refused(file, "the column '" + name + "' is missing");

      const std::size_t n = table.at("x").size();
      for (const auto &[name, values] : table)
        {
          if (values.size() != n)
            throw refused(file,
                          "the columns 'x' and '" + name +
                            "' have different lengths");
          for (std::size_t i = 0; i < n; ++i)
            if (const std::string what = objection(name, values[i], materials);
                !what.empty())
              throw refused(file,
                            (is_csv ? line_and_column(i + 2, name)
                                    : "entry " + std::to_string(i) +
                                        " (from 0) of '" + name + "': ") +
                              what);
        }
    }

    /** Whether x lies in a cell or on its border. */
    bool
    is_in(const Mapping<dim>                      &mapping,
          const Triangulation<dim>::cell_iterator &cell,
          const Point<dim>                        &x)
    {
      try
        {
          return GeometryInfo<dim>::is_inside_unit_cell(
            mapping.transform_real_to_unit_cell(cell, x), 1e-10);
        }
      catch (const Mapping<dim>::ExcTransformationFailed &)
        {
          return false; // too far outside
        }
    }

    InputError
    outside_mesh(const Point<dim> &x)
    {
      return InputError(format("the seed at (%g, %g) lies outside the "
                               "background mesh",
                               x[0],
                               x[1]) +
                        "\n  allowed: points in the mesh\n"
                        "  remedy:  enlarge 'Mesh/Box'");
    }

    /** Of seeds that all ranks have, those in the cells of this rank. */
    std::vector<Seed>
    own_ones(const std::vector<Seed> &all, const BackgroundMesh &mesh)
    {
      const auto        &tria    = mesh.triangulation();
      const MPI_Comm     comm    = tria.get_communicator();
      const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);

      const GridTools::Cache<dim> cache(tria, mesh.mapping());
      const auto &cells = cache.get_locally_owned_cell_bounding_boxes_rtree();
      std::vector<unsigned int> owner(all.size(), n_ranks);
      namespace bgi = boost::geometry::index;
      for (std::size_t i = 0; i < all.size(); ++i)
        for (const auto &[box, cell] :
             cells | bgi::adaptors::queried(bgi::intersects(all[i].position)))
          if (is_in(mesh.mapping(), cell, all[i].position))
            owner[i] = rank;
      Utilities::MPI::min(owner, comm, owner);

      std::vector<Seed> own;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (owner[i] == n_ranks)
          throw outside_mesh(all[i].position);
        else if (owner[i] == rank)
          own.push_back(all[i]);
      return own;
    }

    /** @throws InputError if a material has no points (collective) */
    void
    check_numbers(const std::vector<Seed> &seeds,
                  const Materials         &materials,
                  const MPI_Comm           comm)
    {
      std::vector<unsigned int> n(materials.size(), 0);
      for (const Seed &seed : seeds)
        ++n[seed.material];
      Utilities::MPI::sum(n, comm, n);
      const std::string remedy =
        "\n  allowed: one point or more\n"
        "  remedy:  take smaller cells, a smaller 'Particles/Spacing' or a "
        "larger 'Particles/Number'";
      if (std::accumulate(n.begin(), n.end(), 0U) == 0)
        throw InputError("the body has no particle" + remedy);
      // The first material has what the others leave, which may be nothing.
      for (unsigned int i = 1; i < n.size(); ++i)
        if (n[i] == 0)
          throw InputError("no particle lies in the region of the material '" +
                           materials.name(i) + "'" + remedy);
    }
  } // namespace

  Seeding::Seeding(const ParameterFile &parameter_file)
    : ParameterAcceptor("/Particles")
    , folder_of_parameters(parameter_file.folder())
  {
    add_parameter("Layout",
                  layout,
                  "Gauss (points of each cell) | sub-cells (their centres) | "
                  "lattice (squares, independent of the mesh) | random | "
                  "file.");
    add_parameter("Points per direction",
                  k,
                  "Gauss and sub-cells: k for k x k points in each cell.");
    add_parameter("Spacing", spacing, "lattice: distance of points (m).");
    add_parameter("Number", number, "random: number of points in the body.");
    add_parameter(
      "Random seed", random_seed, "random: another number gives other points.");
    add_parameter("File",
                  file,
                  "file: a .csv file whose first line names its columns, or an "
                  ".h5 file with a dataset for each: x, y (m), volume (m^2); "
                  "optionally material (name, or number from 0), vx, vy (m/s), "
                  "sxx, syy, sxy (Pa). Relative to the folder of the parameter "
                  "file, or else to that of the call.");
  }

  void
  Seeding::prepare(const Scene &scene)
  {
    if (layout == "Gauss" || layout == "sub-cells")
      {
        if (k == 0)
          throw InputError(
            "Particles/Points per direction", k, ">= 1", "2 or 3 are usual");
      }
    else if (layout == "lattice" || layout == "random")
      {
        if (scene.geometry.shape == Geometry::Shape::file)
          throw InputError("Particles/Layout",
                           layout,
                           "Gauss | sub-cells | file, where the domain comes "
                           "from a .msh file",
                           "choose one of them");
        if (layout == "lattice" && !(spacing > 0.))
          throw InputError(
            "Particles/Spacing", spacing, "> 0", "half a cell size is usual");
        if (layout == "random" && number == 0)
          throw InputError("Particles/Number",
                           number,
                           ">= 1",
                           "four or more per cell are usual");
      }
    else if (layout == "file")
      file = existing_file(file,
                           folder_of_parameters,
                           "Particles/File",
                           "an existing .csv or .h5 file of points");
    else
      throw InputError("Particles/Layout",
                       layout,
                       "Gauss | sub-cells | lattice | random | file",
                       "choose one of them");
    if (scene.regions.have_numbers())
      throw InputError(
        "Particles/Layout",
        layout,
        "particles whose materials are found by region polygons, "
        "not by region numbers",
        "give a 'Region polygon' to each material");
  }

  unsigned int
  Seeding::points_per_direction() const
  {
    return layout == "Gauss" || layout == "sub-cells" ? k : 0;
  }

  std::vector<Seed>
  Seeding::make(const Scene &scene, const BackgroundMesh &mesh) const
  {
    std::set<std::string> given;
    std::vector<Seed>     seeds = points_per_direction() > 0
                                    ? follow_cells(scene.geometry, mesh)
                                    : own_ones(make_all(scene, given), mesh);
    describe(seeds, scene, given);
    check_numbers(
      seeds, scene.materials, mesh.triangulation().get_communicator());
    return seeds;
  }

  std::vector<Seed>
  Seeding::make(const Scene         &scene,
                const CartesianGrid &grid,
                const MPI_Comm       comm) const
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int n       = grid.axes[0].n_intervals;
    const std::array<unsigned int, 2> columns = {
      {static_cast<unsigned int>(1ULL * n * rank / n_ranks),
       static_cast<unsigned int>(1ULL * n * (rank + 1) / n_ranks)}};
    std::set<std::string> given;
    std::vector<Seed>     seeds;
    if (points_per_direction() > 0)
      seeds = follow_cells(scene.geometry, grid, columns);
    else
      for (Seed &seed : make_all(scene, given))
        {
          if (!grid.contains(seed.position))
            throw outside_mesh(seed.position);
          const unsigned int column = grid.axes[0].interval(seed.position[0]);
          if (column >= columns[0] && column < columns[1])
            seeds.push_back(seed);
        }
    describe(seeds, scene, given);
    check_numbers(seeds, scene.materials, comm);
    return seeds;
  }

  std::vector<Seed>
  Seeding::make_all(const Scene &scene, std::set<std::string> &given) const
  {
    return layout == "lattice"  ? make_lattice(scene.geometry)
           : layout == "random" ? make_random(scene.geometry)
                                : read_file(scene.materials, given);
  }

  void
  Seeding::describe(std::vector<Seed>           &seeds,
                    const Scene                 &scene,
                    const std::set<std::string> &given) const
  {
    for (Seed &seed : seeds)
      {
        if (given.count("material") == 0)
          seed.material = scene.regions.material_at(seed.position, -1);
        if (given.count("vx") == 0)
          seed.velocity = scene.initial_velocity.at(seed.position);
        if (given.count("sxx") == 0)
          seed.stress = scene.initial_stress.at(
            seed.position, scene.materials, scene.regions);
        seed.stress_zz = scene.initial_stress.zz_at(seed.position, seed.stress);
      }
  }

  std::vector<Seed>
  Seeding::follow_cells(const Geometry                    &geometry,
                        const CartesianGrid               &grid,
                        const std::array<unsigned int, 2> &columns) const
  {
    const Quadrature<1> line =
      layout == "Gauss" ? Quadrature<1>(QGauss<1>(k))
                        : Quadrature<1>(QIterated<1>(QMidpoint<1>(), k));
    std::vector<Seed> seeds;
    const auto        place = [&](const unsigned int d,
                           const unsigned int interval,
                           const unsigned int q) {
      return grid.axes[d].begin +
             (interval + line.point(q)[0]) * grid.axes[d].size;
    };
    for (unsigned int i = columns[0]; i < columns[1]; ++i)
      for (unsigned int j = 0; j < grid.axes[1].n_intervals; ++j)
        for (unsigned int b = 0; b < k; ++b)
          for (unsigned int a = 0; a < k; ++a)
            {
              const Point<dim> x(place(0, i, a), place(1, j, b));
              if (!geometry.contains(x))
                continue;
              seeds.emplace_back();
              seeds.back().position = x;
              seeds.back().volume   = line.weight(a) * line.weight(b) *
                                    grid.axes[0].size * grid.axes[1].size;
            }
    return seeds;
  }

  std::vector<Seed>
  Seeding::follow_cells(const Geometry       &geometry,
                        const BackgroundMesh &mesh) const
  {
    const Quadrature<dim> quadrature = layout == "Gauss"
                                         ? Quadrature<dim>(QGauss<dim>(k))
                                         : QIterated<dim>(QMidpoint<1>(), k);
    const FE_Nothing<dim> nothing;
    FEValues<dim>         values(mesh.mapping(),
                         nothing,
                         quadrature,
                         update_JxW_values | update_quadrature_points);
    std::vector<Seed>     seeds;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(Triangulation<dim>::cell_iterator(cell));
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            if (geometry.contains(values.quadrature_point(q)))
              {
                seeds.emplace_back();
                seeds.back().position = values.quadrature_point(q);
                seeds.back().volume   = values.JxW(q);
              }
        }
    return seeds;
  }

  std::vector<Seed>
  Seeding::make_lattice(const Geometry &geometry) const
  {
    const auto        box = geometry.bounding_box();
    std::vector<Seed> seeds;
    Seed              seed;
    seed.volume = spacing * spacing;
    // By index: a sum of spacings would gather rounding errors.
    const auto coordinate = [&](const unsigned int c, const unsigned int i) {
      return box.first[c] + (i + 0.5) * spacing;
    };
    for (unsigned int j = 0; coordinate(1, j) < box.second[1]; ++j)
      for (unsigned int i = 0; coordinate(0, i) < box.second[0]; ++i)
        {
          seed.position = {coordinate(0, i), coordinate(1, j)};
          if (geometry.contains(seed.position))
            seeds.push_back(seed);
        }
    return seeds;
  }

  std::vector<Seed>
  Seeding::make_random(const Geometry &geometry) const
  {
    const auto [lower, upper] = geometry.bounding_box();
    // The distributions of the standard library may differ between machines.
    std::mt19937 engine(random_seed);
    const auto   uniform = [&]() { return (engine() + 0.5) / 4294967296.; };
    std::vector<Seed> seeds;
    Seed              seed;
    seed.volume = geometry.area() / number;
    while (seeds.size() < number)
      {
        for (unsigned int c = 0; c < dim; ++c)
          seed.position[c] = lower[c] + uniform() * (upper[c] - lower[c]);
        if (geometry.contains(seed.position))
          seeds.push_back(seed);
      }
    return seeds;
  }

  std::vector<Seed>
  Seeding::read_file(const Materials       &materials,
                     std::set<std::string> &given) const
  {
    const bool  is_csv = std::filesystem::path(file).extension() != ".h5";
    const Table table  = is_csv ? read_csv(file, materials) : read_hdf5(file);
    check_table(table, file, is_csv, materials);
    for (const auto &column : table)
      given.insert(column.first);

    const auto value = [&](const std::string &name, const std::size_t i) {
      const auto column = table.find(name);
      return column == table.end() ? 0. : column->second[i];
    };
    std::vector<Seed> seeds(table.at("x").size());
    for (std::size_t i = 0; i < seeds.size(); ++i)
      {
        seeds[i].position    = Point<dim>(value("x", i), value("y", i));
        seeds[i].volume      = value("volume", i);
        seeds[i].material    = static_cast<unsigned int>(value("material", i));
        seeds[i].velocity[0] = value("vx", i);
        seeds[i].velocity[1] = value("vy", i);
        seeds[i].stress =
          Mandel(value("sxx", i), value("syy", i), sqrt2 * value("sxy", i));
      }
    return seeds;
  }
} // namespace geocone
