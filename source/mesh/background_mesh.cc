// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mesh/background_mesh.h>
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
#include <filesystem>
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
                    "rank stores the whole mesh.");
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

  void
  BackgroundMesh::prepare(const Scene &scene, const Method &method)
  {
    parameters.prepare(scene.geometry, method);
    CoarseMesh mesh = fitted_mesh(
      parameters, scene, comm, sizes ? &*sizes : nullptr, !method.is_mpm());
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
    symmetry = scene.geometry.symmetry;
    scene.geometry.check_radii(mesh.points);
    sides                      = mesh.sides;
    lines                      = mesh.grid;
    simplicial                 = mesh.has_simplices();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (simplicial && mesh.cells.size() > 0 &&
        std::any_of(mesh.cells.begin(), mesh.cells.end(), [](const auto &cell) {
          return cell.vertices.size() != dim + 1;
        }))
      throw InputError("the mesh of 'Geometry/File' has tetrahedra beside "
                       "hexahedra\n"
                       "  allowed: one kind of cells\n"
                       "  remedy:  recombine all volumes in gmsh, or none");
    if (n_ranks > mesh.cells.size())
      throw InputError("there are more ranks (" + std::to_string(n_ranks) +
                       ") than cells (" + std::to_string(mesh.cells.size()) +
                       ")\n  remedy:  call mpirun with fewer ranks");
    const bool has_contacts = split_at_contacts || layers > 1;
    if (storage == Storage::automatic)
      storage =
        simplicial || has_contacts ? Storage::shared : Storage::distributed;
    if (storage == Storage::distributed && has_contacts)
      throw InputError("Mesh/Triangulation",
                       storage.word(),
                       "automatic | shared where there are contacts: each rank "
                       "searches for contacts",
                       "set Mesh/Triangulation = automatic");
    if (storage == Storage::distributed && simplicial)
      throw InputError("Mesh/Triangulation",
                       storage.word(),
                       "automatic | shared for triangles: p4est knows only "
                       "quadrilaterals, on 1 rank or more",
                       "set Mesh/Triangulation = automatic");
    if (storage == Storage::distributed)
      tria = std::make_unique<parallel::distributed::Triangulation<dim>>(comm);
    else
      tria = std::make_unique<parallel::shared::Triangulation<dim>>(
        comm,
        Triangulation<dim>::none,
        !has_contacts,
        parallel::shared::Triangulation<dim>::Settings::partition_metis);
    tria->create_triangulation(mesh.points, mesh.cells, mesh.boundary);

    if (simplicial)
      map = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    else
      map = std::make_unique<MappingQ1<dim>>();

    find_owners();
  }

  void
  BackgroundMesh::find_owners()
  {
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

  BoundingBox<dim>
  BackgroundMesh::bounding_box() const
  {
    return BoundingBox<dim>(tria->get_vertices());
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
    std::vector<unsigned int> is_there(tria->n_active_cells(), 0);
    for (const Cell &cell : cells)
      is_there[cell->active_cell_index()] = 1;
    Utilities::MPI::max(is_there, comm, is_there);

    // Parts connected through faces, by union of the vertices of cells with dim
    // common vertices: cells with fewer can still rotate.
    std::vector<unsigned int> part(tria->n_active_cells());
    std::iota(part.begin(), part.end(), 0U);
    const auto root = [&](unsigned int i) {
      while (part[i] != i)
        i = part[i] = part[part[i]];
      return i;
    };
    std::map<std::array<unsigned int, dim>, unsigned int> first_cell;
    for (const auto &cell : tria->active_cell_iterators())
      {
        const unsigned int c = cell->active_cell_index(),
                           n = cell->n_vertices();
        if (is_there[c] == 0)
          continue;
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
                part[root(c)]    = root(entry->second);
              }
      }
    std::map<unsigned int, unsigned int> number;
    std::vector<unsigned int>            of_vertex(tria->n_vertices(), 0);
    for (const auto &cell : tria->active_cell_iterators())
      if (const unsigned int c = cell->active_cell_index(); is_there[c] > 0)
        {
          const unsigned int p =
            number.emplace(root(c), number.size()).first->second;
          for (unsigned int i = 0; i < cell->n_vertices(); ++i)
            of_vertex[cell->vertex_index(i)] = p;
        }
    return of_vertex;
  }

  std::set<types::boundary_id>
  BackgroundMesh::side_ids(const BoundaryCondition &condition) const
  {
    return geocone::side_ids(condition, sides, tria->get_boundary_ids());
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
