// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/constraints.h>
#include <geocone/mechanics/mesh_transfer.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <map>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    using Field = PointArrays::Field;
  } // namespace

  MeshTransfer::MeshTransfer(const Scene          &scene,
                             const BackgroundMesh &mesh,
                             const Space          &space)
    : mesh(mesh)
    , space(space)
    , comm(mesh.triangulation().get_communicator())
    , n(space.nodes_per_cell())
    , cache(mesh.triangulation(), mesh.mapping())
    , exchanged(space.partitioner())
  {
    const auto &tria = mesh.triangulation();
    cells.resize(tria.n_active_cells());
    neighbours.resize(tria.n_active_cells());
    cell_nodes.assign(n * tria.n_active_cells(), numbers::invalid_unsigned_int);
    smallest_cell              = std::numeric_limits<double>::max();
    const auto cells_of_vertex = GridTools::vertex_to_cell_map(tria);
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : tria.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const unsigned int c = cell->active_cell_index();
          cells[c]             = cell;
          smallest_cell =
            std::min(smallest_cell, cell->minimum_vertex_distance());
          std::set<Cell> around;
          for (const unsigned int v : cell->vertex_indices())
            for (const auto &other : cells_of_vertex[cell->vertex_index(v)])
              if (other != cell && !other->is_artificial())
                around.insert(other);
          neighbours[c].assign(around.begin(), around.end());
          if (cell->is_locally_owned())
            {
              space.cell_nodes(cell, nodes);
              for (unsigned int i = 0; i < n; ++i)
                cell_nodes[c * n + i] = space.local_node(nodes[i]);
            }
        }
    smallest_cell = Utilities::MPI::min(smallest_cell, comm);

    const std::size_t n_nodes = space.n_local_nodes();
    read.resize(4 * n_nodes);
    write.resize(4 * n_nodes);
    mass.resize(n_nodes);
    mine = {{{0, space.n_owned_nodes()}}};

    const Constraints constraints(scene, mesh, space);
    for (const auto &p : constraints.prescribed_components())
      prescribed.push_back({p.node,
                            p.component,
                            p.condition,
                            space.node_positions()[p.node],
                            p.node < space.n_owned_nodes()});
    for (unsigned int c = 0; c < scene.dirichlet.list.size(); ++c)
      centres.push_back(constraints.centre(c));
  }

  bool
  MeshTransfer::is_in(const Point<dim> &x, const Cell &cell, Place &place) const
  {
    const auto unit = mesh.unit_point(cell, x);
    if (!unit)
      return false;
    place.unit = *unit;
    place.cell = cell;
    return true;
  }

  bool
  MeshTransfer::find(const Point<dim> &x, const Cell &hint, Place &place) const
  {
    if (hint.state() == IteratorState::valid)
      {
        if (is_in(x, hint, place))
          return true;
        for (const Cell &cell : neighbours[hint->active_cell_index()])
          if (is_in(x, cell, place))
            return true;
      }
    namespace bgi = boost::geometry::index;
    // Boxes a little larger, for points on the border of the mesh.
    Point<dim> lower = x, upper = x;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] -= BackgroundMesh::tolerance * smallest_cell;
        upper[d] += BackgroundMesh::tolerance * smallest_cell;
      }
    const BoundingBox<dim> around({lower, upper});
    for (const auto &[box, cell] :
         cache.get_cell_bounding_boxes_rtree() |
           bgi::adaptors::queried(bgi::intersects(around)))
      if (!cell->is_artificial() && is_in(x, cell, place))
        return true;
    return false;
  }

  void
  MeshTransfer::sort(std::vector<PointArrays> &groups)
  {
    lost.clear();
    functions.resize(groups.size());
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        PointArrays &group = groups[g];
        group.pad();
        group.cell.resize(group.n_points(), numbers::invalid_unsigned_int);

        // Points in other ranks' cells go there, the others know their place.
        std::vector<Place>                          places;
        std::map<unsigned int, std::vector<double>> leaving;
        std::vector<unsigned int>                   staying;
        std::vector<unsigned int>                   lost_here;
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            const unsigned int c = group.cell[p];
            Place              place;
            const bool         found = find(
              group.position(p), c < cells.size() ? cells[c] : Cell(), place);
            if (found && !place.cell->is_locally_owned())
              {
                std::vector<double> &message =
                  leaving[place.cell->subdomain_id()];
                for (unsigned int field = 0; field < group.n_fields(); ++field)
                  message.push_back(group[field][p]);
                message.push_back(group.id[p]);
                continue;
              }
            if (!found)
              {
                lost_here.push_back(staying.size());
                place.cell = *mesh.own_cells().begin();
                place.unit = Point<dim>(0.5, 0.5);
              }
            group.cell[p] = place.cell->active_cell_index();
            staying.push_back(p);
            places.push_back(place);
          }
        if (staying.size() < group.n_points())
          group.reorder(staying);
        if (Utilities::MPI::logical_or(!leaving.empty(), comm))
          {
            const unsigned int size = group.n_fields() + 1;
            for (const auto &[sender, message] :
                 Utilities::MPI::some_to_some(comm, leaving))
              for (std::size_t i = 0; i < message.size(); i += size)
                {
                  const Point<dim> x(message[i + Field::x],
                                     message[i + Field::y]);
                  Place            place;
                  bool             found = find(x, Cell(), place);
                  if (found && !place.cell->is_locally_owned())
                    // On a border that both ranks take for the other's.
                    found = find_own(x, place);
                  if (!found)
                    {
                      lost_here.push_back(places.size());
                      place.cell = *mesh.own_cells().begin();
                      place.unit = Point<dim>(0.5, 0.5);
                    }
                  group.append(
                    &message[i],
                    static_cast<unsigned int>(message[i + size - 1]));
                  group.cell.push_back(place.cell->active_cell_index());
                  places.push_back(place);
                }
          }
        group.pad();
        for (const unsigned int p : lost_here)
          lost.push_back({{g, p}});
        evaluate(group, places, functions[g]);
      }
    write.fill(0.);
    mass.fill(0.);
  }

  bool
  MeshTransfer::owns(const Point<dim> &x) const
  {
    Place place;
    return find(x, Cell(), place) &&
           (place.cell->is_locally_owned() || find_own(x, place));
  }

  bool
  MeshTransfer::find_own(const Point<dim> &x, Place &place) const
  {
    for (const auto &cell : mesh.own_cells())
      if (cell->point_inside(x) && is_in(x, cell, place))
        return true;
    // Within the rounding of the search that has sent it here.
    double nearest = std::numeric_limits<double>::max();
    for (const auto &cell : mesh.own_cells())
      {
        const double distance = cell->center().distance_square(x);
        if (distance < nearest)
          {
            nearest    = distance;
            place.cell = cell;
          }
      }
    return is_in(x, place.cell, place);
  }

  void
  MeshTransfer::evaluate(const PointArrays        &group,
                         const std::vector<Place> &places,
                         Functions                &at) const
  {
    const unsigned int padded = group.n_padded();
    at.nodes.resize(n * padded);
    at.N.resize(n * padded);
    at.dN_dx.resize(n * padded);
    at.dN_dy.resize(n * padded);
    std::vector<Tensor<1, dim>> gradient(n);
    for (unsigned int p = 0; p < padded; ++p)
      {
        // Padding is at the place of the last point.
        const Place &place =
          places[std::min<std::size_t>(p, places.size() - 1)];
        space.evaluate(place.cell, place.unit, &at.N[p * n], gradient.data());
        const Tensor<2, dim> inverse =
          mesh.inverse_jacobian(place.cell, place.unit);
        const unsigned int c = place.cell->active_cell_index();
        for (unsigned int i = 0; i < n; ++i)
          {
            const Tensor<1, dim> slope = gradient[i] * inverse;
            at.dN_dx[p * n + i]        = slope[0];
            at.dN_dy[p * n + i]        = slope[1];
            at.nodes[p * n + i]        = cell_nodes[c * n + i];
          }
      }
  }

  PointFunctions
  MeshTransfer::functions_at(const TransferBlock &points,
                             const unsigned int   k) const
  {
    const Functions  &at    = functions[points.group];
    const std::size_t first = n * static_cast<std::size_t>(points.first + k);
    return {
      n, &at.nodes[first], &at.N[first], &at.dN_dx[first], &at.dN_dy[first]};
  }

  void
  MeshTransfer::gather(const TransferBlock &points, BlockScratch &scratch)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      functions_at(points, k).gather<4, true>(read.data(),
                                              scratch.gathered + 12 * k);
  }

  void
  MeshTransfer::gather_values(const TransferBlock &points,
                              BlockScratch        &scratch)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      functions_at(points, k).gather<4, false>(read.data(),
                                               scratch.gathered + 12 * k);
  }

  void
  MeshTransfer::gather_affine(const TransferBlock &points, BlockScratch &)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const Tensor<2, dim> C = functions_at(points, k).gather_affine<4>(
          read.data(),
          Point<dim>(points.x[k], points.y[k]),
          space.node_positions(),
          smallest_cell);
        points.c_xx[k] = C[0][0];
        points.c_xy[k] = C[0][1];
        points.c_yx[k] = C[1][0];
        points.c_yy[k] = C[1][1];
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
        at.scatter<4, with_gradients>(scratch.given + 12 * k, write.data());
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
      functions_at(points, k).scatter_affine<4>(
        points.mass[k],
        Tensor<2, dim>(
          {{points.c_xx[k], points.c_xy[k]}, {points.c_yx[k], points.c_yy[k]}}),
        Point<dim>(points.x[k], points.y[k]),
        space.node_positions(),
        write.data());
  }

  void
  MeshTransfer::exchange(const bool with_mass)
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    const unsigned int n_nodes = space.n_local_nodes();
    // Momentum, force, and the mass (as both components of a vector).
    for (unsigned int part = 0; part < (with_mass ? 3 : 2); ++part)
      {
        exchanged.zero_out_ghost_values();
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            exchanged.local_element(dim * i + d) =
              part < 2 ? write[4 * i + 2 * part + d] : mass[i];
        exchanged.compress(VectorOperation::add);
        exchanged.update_ghost_values();
        for (unsigned int i = 0; i < n_nodes; ++i)
          if (part < 2)
            for (unsigned int d = 0; d < dim; ++d)
              write[4 * i + 2 * part + d] =
                exchanged.local_element(dim * i + d);
          else
            mass[i] = exchanged.local_element(dim * i);
      }
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
                        mass.memory_consumption();
    for (const Functions &at : functions)
      bytes += at.nodes.capacity() * sizeof(unsigned int) +
               (at.N.capacity() + at.dN_dx.capacity() + at.dN_dy.capacity()) *
                 sizeof(double);
    return bytes;
  }
} // namespace geocone
