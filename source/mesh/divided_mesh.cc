// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/divided_mesh.h>

#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria_description.h>

#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    using Description = TriangulationDescription::Description<dim, dim>;
    using Neighbours  = std::vector<CoarseMesh::Neighbours>;

    /** Rank of each cell: parts of equal size with few faces between them. */
    std::vector<unsigned int>
    ranks_of_cells(const Neighbours &neighbours, const unsigned int n_ranks)
    {
      const std::size_t         n = neighbours.size();
      std::vector<unsigned int> ranks(n, 0);
      if (n_ranks == 1)
        return ranks;
      SparsityPattern graph(n, n, 2 * dim + 1);
      for (std::size_t c = 0; c < n; ++c)
        {
          graph.add(c, c);
          for (const unsigned int other : neighbours[c])
            if (other != CoarseMesh::no_cell)
              graph.add(c, other);
        }
      graph.compress();
      SparsityTools::partition(graph, n_ranks, ranks);
      return ranks;
    }

    /** Sorted numbers of the cells that a rank stores: its own and those
     *  that share a vertex with them. */
    std::vector<unsigned int>
    stored_cells(const CoarseMesh                &mesh,
                 const std::vector<unsigned int> &ranks,
                 const unsigned int               rank)
    {
      std::vector<bool> is_at_own(mesh.points.size(), false);
      for (std::size_t c = 0; c < ranks.size(); ++c)
        if (ranks[c] == rank)
          for (const unsigned int v : mesh.cells[c].vertices)
            is_at_own[v] = true;
      std::vector<unsigned int> stored;
      for (std::size_t c = 0; c < ranks.size(); ++c)
        if (const auto &vertices = mesh.cells[c].vertices; std::any_of(
              vertices.begin(), vertices.end(), [&](const unsigned int v) {
                return is_at_own[v];
              }))
          stored.push_back(c);
      return stored;
    }

    /** Boundary ids of the outer faces that have one, by sorted vertices. */
    std::map<CoarseMesh::Face, types::boundary_id>
    ids_of_faces(const CoarseMesh &mesh)
    {
      std::map<CoarseMesh::Face, types::boundary_id> ids;
      const auto add = [&](const auto &faces) {
        for (const auto &part : faces)
          {
            CoarseMesh::Face face;
            face.fill(CoarseMesh::no_vertex);
            std::copy(part.vertices.begin(), part.vertices.end(), face.begin());
            ids[CoarseMesh::sorted(face)] = part.boundary_id;
          }
      };
      if constexpr (dim == 2)
        add(mesh.boundary.boundary_lines);
      else
        add(mesh.boundary.boundary_quads);
      return ids;
    }

    /** A whole mesh and what its division needs. */
    struct Whole
    {
      const CoarseMesh                              &mesh;
      Neighbours                                     neighbours;
      std::vector<unsigned int>                      ranks;
      std::map<CoarseMesh::Face, types::boundary_id> ids;
    };

    /** Cells that a rank stores. */
    Description
    part_of(const Whole &whole, const unsigned int rank)
    {
      const CoarseMesh               &mesh = whole.mesh;
      const std::vector<unsigned int> stored =
        stored_cells(mesh, whole.ranks, rank);
      Description part;
      part.settings  = TriangulationDescription::default_setting;
      part.smoothing = Triangulation<dim>::none;
      part.cell_infos.resize(1);
      // Vertices keep their order, and thus edges their direction.
      constexpr unsigned int    none = CoarseMesh::no_vertex;
      std::vector<unsigned int> number(mesh.points.size(), none);
      for (const unsigned int c : stored)
        for (const unsigned int v : mesh.cells[c].vertices)
          number[v] = 0;
      for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] != none)
          {
            number[v] = part.coarse_cell_vertices.size();
            part.coarse_cell_vertices.push_back(mesh.points[v]);
          }
      for (const unsigned int c : stored)
        {
          dealii::CellData<dim> cell = mesh.cells[c];
          const auto            reference =
            ReferenceCell::n_vertices_to_type(dim, cell.vertices.size());
          TriangulationDescription::CellData<dim> info;
          info.id                 = CellId(c, {}).template to_binary<dim>();
          info.subdomain_id       = whole.ranks[c];
          info.level_subdomain_id = numbers::artificial_subdomain_id;
          info.manifold_id        = numbers::flat_manifold_id;
          info.manifold_line_ids.fill(numbers::flat_manifold_id);
          info.manifold_quad_ids.fill(numbers::flat_manifold_id);
          for (const unsigned int f : reference.face_indices())
            if (const unsigned int other = whole.neighbours[c][f];
                other == CoarseMesh::no_cell)
              {
                CoarseMesh::Face face;
                face.fill(none);
                for (unsigned int i = 0;
                     i < reference.face_reference_cell(f).n_vertices();
                     ++i)
                  face[i] =
                    cell.vertices[reference.face_to_cell_vertices(f, i, true)];
                const auto id = whole.ids.find(CoarseMesh::sorted(face));
                info.boundary_ids.emplace_back(
                  f, id == whole.ids.end() ? 0 : id->second);
              }
            else if (!std::binary_search(stored.begin(), stored.end(), other))
              info.boundary_ids.emplace_back(f, end_of_ghost_cells);
          for (unsigned int &v : cell.vertices)
            v = number[v];
          part.coarse_cells.push_back(std::move(cell));
          part.coarse_cell_index_to_coarse_cell_id.push_back(c);
          part.cell_infos[0].push_back(std::move(info));
        }
      return part;
    }

    /** Tag of the messages of parts. */
    constexpr int tag = 7301;

    /** Sends a part. Counted in doubles, since MPI counts with int. */
    void
    send(const Description &part, const unsigned int rank, const MPI_Comm comm)
    {
      std::vector<char>        text = Utilities::pack(part, false);
      const unsigned long long size = text.size();
      text.resize((size + sizeof(double) - 1) / sizeof(double) *
                  sizeof(double));
      MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, rank, tag, comm);
      MPI_Send(
        text.data(), text.size() / sizeof(double), MPI_DOUBLE, rank, tag, comm);
    }

    Description
    receive(const MPI_Comm comm)
    {
      unsigned long long size = 0;
      MPI_Recv(
        &size, 1, MPI_UNSIGNED_LONG_LONG, 0, tag, comm, MPI_STATUS_IGNORE);
      std::vector<double> text((size + sizeof(double) - 1) / sizeof(double));
      MPI_Recv(
        text.data(), text.size(), MPI_DOUBLE, 0, tag, comm, MPI_STATUS_IGNORE);
      const char *first = reinterpret_cast<const char *>(text.data());
      return Utilities::unpack<Description>(
        std::vector<char>(first, first + size), false);
    }

    /** Cells that this rank stores. @param mesh on the first rank */
    Description
    part_of_this_rank(const CoarseMesh &mesh, const MPI_Comm comm)
    {
      if (Utilities::MPI::this_mpi_process(comm) > 0)
        return receive(comm);
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
      Whole whole = {mesh, mesh.neighbours(), {}, ids_of_faces(mesh)};
      whole.ranks = ranks_of_cells(whole.neighbours, n_ranks);
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        send(part_of(whole, rank), rank, comm);
      return part_of(whole, 0);
    }
  } // namespace

  std::unique_ptr<parallel::fullydistributed::Triangulation<dim>>
  divided_mesh(const CoarseMesh &mesh, const MPI_Comm comm)
  {
    auto tria =
      std::make_unique<parallel::fullydistributed::Triangulation<dim>>(comm);
    Description part = part_of_this_rank(mesh, comm);
    part.comm        = comm;
    tria->create_triangulation(part);
    return tria;
  }
} // namespace geocone::GEOCONE_DIM
