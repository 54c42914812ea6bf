// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/mesh/divided_mesh.h>
#include <geocone/mesh/structured_mesh.h>
#include <geocone/shapes/edge_normal.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Splits the mesh between bodies in contact; the new faces are sides with
     *  the name of the contact. */
    void
    part_bodies(const Contacts &contacts, CoarseMesh &mesh)
    {
      for (const auto &pair : contacts.list)
        {
          const auto faces =
            mesh.part([&](const unsigned int a, const unsigned int b) {
              return pair->separates(a, b);
            });
          if (faces.empty())
            continue;
          types::boundary_id next = 0;
          for (const auto &side : mesh.sides)
            next = std::max(next, types::boundary_id(side.second + 1));
          if (!mesh.sides.emplace(pair->name, next).second)
            throw InputError("Contacts/Names",
                             pair->name,
                             "names that are not those of sides of the body",
                             "rename the contact");
          for (const CoarseMesh::Face &face : faces)
            mesh.add_boundary(face, next);
        }
    }
  } // namespace

  BackgroundMesh::BackgroundMesh(const MPI_Comm comm)
    : ParameterAcceptor("/Mesh")
    , comm(comm)
  {
    storage.declare(*this,
                    "Triangulation",
                    ". Distributed: p4est, quadrilaterals only. Shared: each "
                    "rank stores the whole mesh. Fully distributed: each rank "
                    "stores its own cells and their neighbours only (FEM).");
  }

  std::array<std::vector<double>, dim>
  BackgroundMesh::uniform_lines(const Scene &scene, const Method &method)
  {
    parameters.prepare(scene.geometry, method);
    if (scene.geometry.shape == Geometry::Shape::file ||
        parameters.type != MeshParameters::Type::uniform ||
        parameters.cells != MeshParameters::Cells::quadrilaterals)
      return {};
    return grid_lines(parameters);
  }

  BackgroundMesh::Expected
  BackgroundMesh::expect(const Scene &scene, const Method &method)
  {
    parameters.prepare(scene.geometry, method);
    Expected expected;
    if (scene.geometry.shape == Geometry::Shape::file)
      {
        // About 80 bytes for a cell and its share of the nodes, as text.
        std::error_code error;
        const double    size =
          std::filesystem::file_size(scene.geometry.file, error);
        const double n = tria ? tria->n_global_active_cells()
                         : parameters.type == MeshParameters::Type::from_bounds
                           ? parameters.number
                         : error ? 1.
                                 : std::max(1., size / 80.);
        Expected     expected;
        expected.n_cells = n;
        expected.intervals.fill(1.);
        expected.intervals[0]  = n;
        expected.area          = 1.;
        expected.is_simplicial = tria ? simplicial : !method.is_mpm();
        expected.is_grid       = false;
        expected.parameter     = "Geometry/File";
        return expected;
      }
    const bool is_box = !parameters.is_unstructured();
    expected.is_simplicial =
      parameters.cells == MeshParameters::Cells::triangles;
    expected.is_grid = is_box && !expected.is_simplicial;
    if (is_box)
      {
        expected.intervals = grid_size(parameters);
        expected.n_cells   = 1.;
        for (const double intervals : expected.intervals)
          expected.n_cells *= intervals;
        if (expected.is_simplicial)
          expected.n_cells *=
            parameters.diagonals == MeshParameters::Diagonals::crossed ? 4.
                                                                       : 2.;
      }
    else
      {
        expected.n_cells = parameters.type == MeshParameters::Type::from_bounds
                             ? parameters.number
                             : unstructured_size(parameters);
        expected.intervals.fill(1.);
        expected.intervals[0] = expected.n_cells;
      }
    if (dim == 3)
      expected.area = BoundingBox<dim>(parameters.outline).volume();
    else
      {
        expected.area = std::abs(signed_area(parameters.outline));
        for (const Polygon &hole : parameters.holes)
          expected.area -= std::abs(signed_area(hole));
      }
    expected.parameter =
      parameters.type == MeshParameters::Type::from_bounds
        ? "Mesh/Number of cells"
      : parameters.type == MeshParameters::Type::graded ||
          (parameters.type == MeshParameters::Type::unstructured &&
           !parameters.grading_points.empty())
        ? "Mesh/Smallest size"
        : "Mesh/Cell size";
    return expected;
  }

  void
  BackgroundMesh::take_sizes(const SizesOf &sizes_of,
                             const Scene   &scene,
                             const Method  &method)
  {
    parameters.prepare(scene.geometry, method);
    if (parameters.type == MeshParameters::Type::from_bounds)
      sizes = sizes_of(parameters);
  }

  CoarseMesh
  BackgroundMesh::whole_mesh(const Scene   &scene,
                             const Method  &method,
                             const MPI_Comm communicator)
  {
    CoarseMesh mesh = fitted_mesh(parameters,
                                  scene,
                                  communicator,
                                  sizes ? &*sizes : nullptr,
                                  !method.is_mpm());
    if (method.is_mpm())
      {
        scene.contacts.check_all_pairs();
        layers = scene.contacts.n_bodies();
        mesh.repeat(layers);
      }
    else if (!scene.contacts.list.empty())
      {
        split_at_contacts = true;
        part_bodies(scene.contacts, mesh);
      }
    scene.geometry.check_radii(mesh.points);
    if (mesh.has_simplices() &&
        std::any_of(mesh.cells.begin(), mesh.cells.end(), [](const auto &cell) {
          return cell.vertices.size() != dim + 1;
        }))
      throw InputError("the mesh of 'Geometry/File' has tetrahedra beside "
                       "hexahedra\n"
                       "  allowed: one kind of cells\n"
                       "  remedy:  recombine all volumes in gmsh, or none");
    return mesh;
  }

  void
  BackgroundMesh::prepare(const Scene  &scene,
                          const Method &method,
                          const bool    may_divide)
  {
    parameters.prepare(scene.geometry, method);
    symmetry = scene.geometry.symmetry;
    // Contacts and structures are sought in the whole mesh.
    const bool has_contacts = !scene.contacts.list.empty(),
               divides =
                 may_divide && !has_contacts && scene.structures.list.empty();
    if (storage == Storage::automatic && divides)
      storage = Storage::fully_distributed;
    CoarseMesh mesh;
    if (storage != Storage::fully_distributed)
      mesh = whole_mesh(scene, method, comm);
    else
      on_first_rank(comm, "the mesh cannot be made", [&] {
        mesh = whole_mesh(scene, method, MPI_COMM_SELF);
      });
    sides               = mesh.sides;
    lines               = mesh.grid;
    simplicial          = mesh.has_simplices();
    box                 = BoundingBox<dim>(mesh.points);
    std::size_t n_cells = mesh.cells.size();
    if (storage == Storage::fully_distributed)
      share_description(n_cells);
    else if (storage == Storage::automatic)
      storage =
        simplicial || has_contacts ? Storage::shared : Storage::distributed;
    check_storage(has_contacts, divides);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks > n_cells)
      throw InputError("there are more ranks (" + std::to_string(n_ranks) +
                       ") than cells (" + std::to_string(n_cells) +
                       ")\n  remedy:  call mpirun with fewer ranks");
    if (storage == Storage::fully_distributed)
      tria = divided_mesh(mesh, comm);
    else
      {
        if (storage == Storage::distributed)
          tria =
            std::make_unique<parallel::distributed::Triangulation<dim>>(comm);
        else
          tria = std::make_unique<parallel::shared::Triangulation<dim>>(
            comm,
            Triangulation<dim>::none,
            !has_contacts,
            parallel::shared::Triangulation<dim>::Settings::partition_metis);
        tria->create_triangulation(mesh.points, mesh.cells, mesh.boundary);
      }

    if (simplicial)
      map = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    else
      map = std::make_unique<MappingQ1<dim>>();

    find_boundary_ids();
    find_owners();
  }

  void
  BackgroundMesh::share_description(std::size_t &n_cells)
  {
    using Utilities::MPI::broadcast;
    const std::vector<std::pair<std::string, types::boundary_id>> named(
      sides.begin(), sides.end());
    const auto all = broadcast(comm, named);
    sides          = {all.begin(), all.end()};
    for (std::vector<double> &line : lines)
      line = broadcast(comm, line);
    const auto [lower, upper] = box.get_boundary_points();
    const std::vector<Point<dim>> corners =
      broadcast(comm, std::vector<Point<dim>>{lower, upper});
    box        = BoundingBox<dim>({corners[0], corners[1]});
    simplicial = broadcast(comm, int(simplicial)) != 0;
    n_cells    = broadcast(comm, n_cells);
  }

  void
  BackgroundMesh::check_storage(const bool has_contacts,
                                const bool divides) const
  {
    const auto refuse = [&](const std::string &allowed) {
      throw InputError("Mesh/Triangulation",
                       storage.word(),
                       allowed,
                       "set Mesh/Triangulation = automatic");
    };
    if (storage == Storage::distributed && has_contacts)
      refuse("automatic | shared where there are contacts: each rank searches "
             "for contacts");
    if (storage == Storage::distributed && simplicial)
      refuse("automatic | shared | fully distributed for triangles: p4est "
             "knows only quadrilaterals, on 1 rank or more");
    if (storage == Storage::fully_distributed && !divides)
      refuse(std::string("automatic | shared") +
             (simplicial ? "" : " | distributed") +
             " with particles, contacts, structures and B-splines, which need "
             "the whole mesh");
  }

  void
  BackgroundMesh::find_boundary_ids()
  {
    std::set<types::boundary_id> own;
    for (const auto &cell : own_cells())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          own.insert(cell->face(f)->boundary_id());
    boundary_ids = Utilities::MPI::compute_set_union(
      std::vector<types::boundary_id>(own.begin(), own.end()), comm);
  }

  void
  BackgroundMesh::find_owners()
  {
    owners.clear();
    if (storage == Storage::fully_distributed)
      {
        for (const auto &cell : tria->active_cell_iterators())
          owners.push_back(cell->subdomain_id());
        return;
      }
    // Cells are never refined, so that each rank stores all of them in the same
    // order.
    owners.assign(tria->n_active_cells(), 0);
    for (const auto &cell : own_cells())
      owners[cell->active_cell_index()] =
        Utilities::MPI::this_mpi_process(comm);
    Utilities::MPI::max(owners, comm, owners);
  }

  void
  BackgroundMesh::repartition(
    const std::function<unsigned int(const Cell &)> &weight)
  {
    using Status          = Triangulation<dim>::CellStatus;
    const auto connection = tria->signals.weight.connect(
      [&](const Triangulation<dim>::cell_iterator &cell, const Status) {
        return weight(Cell(tria.get(), cell->level(), cell->index()));
      });
    // Repartitions without refinement.
    tria->execute_coarsening_and_refinement();
    connection.disconnect();
    find_owners();
  }

  std::array<unsigned int, dim>
  BackgroundMesh::place_in_grid(const Cell &cell) const
  {
    std::array<unsigned int, dim> place;
    const Point<dim>              centre = cell->center();
    for (unsigned int c = 0; c < dim; ++c)
      place[c] = std::upper_bound(lines[c].begin(), lines[c].end(), centre[c]) -
                 lines[c].begin() - 1;
    return place;
  }

  void
  BackgroundMesh::move_grid(const std::array<std::vector<double>, dim> &to)
  {
    GridTools::transform(
      [&](const Point<dim> &x) {
        Point<dim> moved;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // The nearest line belongs to the vertex.
            const std::vector<double> &from = lines[d];
            std::size_t                i =
              std::lower_bound(from.begin(), from.end(), x[d]) - from.begin();
            if (i == from.size() ||
                (i > 0 && x[d] - from[i - 1] < from[i] - x[d]))
              --i;
            moved[d] = to[d][i];
          }
        return moved;
      },
      *tria);
    lines = to;
    box   = BoundingBox<dim>(tria->get_vertices());
  }

  std::vector<bool>
  BackgroundMesh::marked_cells(const std::vector<Cell> &cells) const
  {
    LinearAlgebra::distributed::Vector<double> flag(
      tria->global_active_cell_index_partitioner().lock());
    for (const Cell &cell : cells)
      flag[cell->global_active_cell_index()] = 1.;
    flag.update_ghost_values();
    std::vector<bool> result(tria->n_active_cells(), false);
    for (const Cell &cell : tria->active_cell_iterators())
      if (!cell->is_artificial())
        result[cell->active_cell_index()] =
          flag[cell->global_active_cell_index()] > 0.;
    return result;
  }

  Tensor<2, dim>
  BackgroundMesh::inverse_jacobian(const Cell       &cell,
                                   const Point<dim> &unit) const
  {
    Tensor<1, dim> along[dim];
    if (simplicial)
      for (unsigned int d = 0; d < dim; ++d)
        along[d] = cell->vertex(1 + d) - cell->vertex(0);
    else
      {
        // Multilinear: edges along each direction, by their position in the
        // others.
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int v = 0; v < (1U << dim); ++v)
            if ((v >> d) % 2 == 0)
              {
                double part = 1.;
                for (unsigned int c = 0; c < dim; ++c)
                  if (c != d)
                    part *= (v >> c) % 2 == 0 ? 1. - unit[c] : unit[c];
                along[d] +=
                  part * (cell->vertex(v | (1U << d)) - cell->vertex(v));
              }
      }
    Tensor<2, dim> jacobian;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        jacobian[c][d] = along[d][c];
    return invert(jacobian);
  }

  std::vector<unsigned int>
  BackgroundMesh::connected_parts(const std::vector<Cell> &cells) const
  {
    // Cells of this rank and its neighbours: connected by the vertices of cells
    // with dim common vertices, since cells with fewer can still rotate.
    const std::vector<bool>   is_there = marked_cells(cells);
    std::vector<unsigned int> leader(tria->n_active_cells());
    std::iota(leader.begin(), leader.end(), 0U);
    const auto root = [&](unsigned int i) {
      while (leader[i] != i)
        i = leader[i] = leader[leader[i]];
      return i;
    };
    std::map<std::array<unsigned int, dim>, unsigned int> first_cell;
    std::vector<Cell>                                     all;
    for (const Cell &cell : tria->active_cell_iterators())
      {
        const unsigned int c = cell->active_cell_index(),
                           n = cell->n_vertices();
        if (!is_there[c])
          continue;
        all.push_back(cell);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i + 1; j < n; ++j)
            for (unsigned int k = dim == 2 ? 0 : j + 1; k < (dim == 2 ? 1 : n);
                 ++k)
              {
                std::array<unsigned int, dim> shared;
                shared[0] = cell->vertex_index(i);
                shared[1] = cell->vertex_index(j);
                if (dim == 3)
                  shared.back() = cell->vertex_index(k);
                std::sort(shared.begin(), shared.end());
                const auto entry = first_cell.emplace(shared, c).first;
                leader[root(c)]  = root(entry->second);
              }
      }
    // Over the ranks: a part has the smallest global number of its cells, which
    // goes from neighbour to neighbour until no rank finds a smaller one.
    LinearAlgebra::distributed::Vector<double> number(
      tria->global_active_cell_index_partitioner().lock());
    for (const Cell &cell : cells)
      number[cell->global_active_cell_index()] =
        cell->global_active_cell_index();
    std::vector<double> smallest(leader.size(),
                                 std::numeric_limits<double>::max());
    for (bool changes = true; Utilities::MPI::logical_or(changes, comm);)
      {
        changes = false;
        number.update_ghost_values();
        for (const Cell &cell : all)
          {
            double &of_part = smallest[root(cell->active_cell_index())];
            of_part =
              std::min(of_part, number[cell->global_active_cell_index()]);
          }
        number.zero_out_ghost_values();
        for (const Cell &cell : cells)
          {
            const double of_part = smallest[root(cell->active_cell_index())];
            changes =
              changes || number[cell->global_active_cell_index()] > of_part;
            number[cell->global_active_cell_index()] = of_part;
          }
      }
    std::vector<unsigned int> part;
    for (const Cell &cell : cells)
      part.push_back(std::lround(number[cell->global_active_cell_index()]));
    const std::set<unsigned int>    own(part.begin(), part.end());
    const std::vector<unsigned int> numbers = Utilities::MPI::compute_set_union(
      std::vector<unsigned int>(own.begin(), own.end()), comm);
    for (unsigned int &p : part)
      p = std::lower_bound(numbers.begin(), numbers.end(), p) - numbers.begin();
    return part;
  }

  std::set<types::boundary_id>
  BackgroundMesh::side_ids(const BoundaryCondition &condition) const
  {
    return geocone::side_ids(condition, sides, boundary_ids);
  }

  types::boundary_id
  BackgroundMesh::side_id(const std::string &name,
                          const std::string &parameter,
                          const std::string &remedy) const
  {
    const auto found = sides.find(name);
    if (found != sides.end())
      return found->second;
    std::string known;
    for (const auto &side : sides)
      known += (known.empty() ? "" : ", ") + side.first;
    throw InputError(parameter, name, known + " (sides of the body)", remedy);
  }

  std::vector<std::vector<Point<dim>>>
  BackgroundMesh::faces_of(const BoundaryCondition &condition) const
  {
    const std::set<types::boundary_id>   ids = side_ids(condition);
    std::vector<std::vector<Point<dim>>> faces;
    for (const auto &cell : own_cells())
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f);
            face->at_boundary() && ids.count(face->boundary_id()) > 0)
          {
            std::vector<Point<dim>> vertices;
            for (const unsigned int v : face->vertex_indices())
              vertices.push_back(face->vertex(v));
            if (vertices.size() == 4) // numbered by rows
              std::swap(vertices[2], vertices[3]);
            const Point<dim> &a = vertices[0];
            Tensor<1, dim>    n;
            if constexpr (dim == 2)
              n = edge_normal(a, vertices[1]);
            else
              n = cross_product_3d(vertices[1] - a, vertices.back() - a);
            if (n * (cell->center() - a) > 0.)
              std::reverse(vertices.begin(), vertices.end());
            faces.push_back(vertices);
          }
    std::vector<std::vector<Point<dim>>> all;
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, faces))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }

  std::optional<Point<dim>>
  BackgroundMesh::unit_point(const Cell &cell, const Point<dim> &x) const
  {
    Point<dim> unit;
    if (simplicial)
      {
        // Affine; inside if no barycentric coordinate is negative.
        unit += inverse_jacobian(cell, unit) * (x - cell->vertex(0));
        double smallest = 1., sum = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            smallest = std::min(smallest, unit[d]);
            sum += unit[d];
          }
        if (!(std::min(smallest, 1. - sum) >= -tolerance))
          return std::nullopt;
        sum = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            unit[d] = std::max(0., unit[d]);
            sum += unit[d];
          }
        return Point<dim>(unit / std::max(1., sum));
      }
    try
      {
        unit = map->transform_real_to_unit_cell(
          Triangulation<dim>::cell_iterator(cell), x);
      }
    catch (const Mapping<dim>::ExcTransformationFailed &)
      {
        return std::nullopt; // too far outside
      }
    if (!GeometryInfo<dim>::is_inside_unit_cell(unit, tolerance))
      return std::nullopt;
    return GeometryInfo<dim>::project_to_unit_cell(unit);
  }
} // namespace geocone::GEOCONE_DIM
