// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/coarse_mesh.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  bool
  CoarseMesh::has_simplices() const
  {
    return std::any_of(cells.begin(), cells.end(), [](const auto &cell) {
      return cell.vertices.size() == dim + 1;
    });
  }

  Point<dim>
  CoarseMesh::centre(const dealii::CellData<dim> &cell) const
  {
    Point<dim> sum;
    for (const unsigned int v : cell.vertices)
      sum += points[v];
    return sum / double(cell.vertices.size());
  }

  CoarseMesh::Face
  CoarseMesh::sorted(Face face)
  {
    std::sort(face.begin(), face.end());
    return face;
  }

  namespace
  {
    /** A face by its sorted vertices, which neighbours share, in the order of
     *  its cell, the cell and its number there. */
    struct FaceOfCell
    {
      CoarseMesh::Face sorted, face;
      unsigned int     cell, number;

      bool
      operator<(const FaceOfCell &other) const
      {
        return std::tie(sorted, cell) < std::tie(other.sorted, other.cell);
      }
    };

    /** Faces of all cells; those shared by neighbours are adjacent in the
     *  list. */
    std::vector<FaceOfCell>
    all_faces(const CoarseMesh &mesh)
    {
      std::vector<FaceOfCell> faces;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          const auto &cell      = mesh.cells[c];
          const auto  reference = dealii::ReferenceCell::n_vertices_to_type(
            dim, cell.vertices.size());
          for (const unsigned int f : reference.face_indices())
            {
              CoarseMesh::Face face;
              face.fill(CoarseMesh::no_vertex);
              for (unsigned int i = 0;
                   i < reference.face_reference_cell(f).n_vertices();
                   ++i)
                face[i] =
                  cell.vertices[reference.face_to_cell_vertices(f, i, true)];
              faces.push_back({CoarseMesh::sorted(face),
                               dim == 2 ? CoarseMesh::sorted(face) : face,
                               c,
                               f});
            }
        }
      std::sort(faces.begin(), faces.end());
      return faces;
    }

    /** Pieces of a mesh at each vertex: cells connected by faces that contain
     *  it. */
    class VertexPieces
    {
    public:
      explicit VertexPieces(const std::vector<dealii::CellData<dim>> &cells)
      {
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (const unsigned int v : cells[c].vertices)
            place.emplace(std::make_pair(v, c), place.size());
        leader.resize(place.size());
        std::iota(leader.begin(), leader.end(), 0U);
      }

      /** Number of the piece of a cell at a vertex, less than size(). */
      unsigned int
      of(const unsigned int vertex, const unsigned int cell)
      {
        unsigned int i = place.at({vertex, cell});
        while (leader[i] != i)
          i = leader[i] = leader[leader[i]];
        return i;
      }

      void
      join(const unsigned int vertex,
           const unsigned int a,
           const unsigned int b)
      {
        leader[of(vertex, a)] = of(vertex, b);
      }

      std::size_t
      size() const
      {
        return leader.size();
      }

    private:
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> place;
      std::vector<unsigned int>                                     leader;
    };
  } // namespace

  std::vector<CoarseMesh::Face>
  CoarseMesh::outer_faces() const
  {
    const std::vector<FaceOfCell> faces = all_faces(*this);
    std::vector<Face>             outer;
    for (std::size_t i = 0, j; i < faces.size(); i = j)
      {
        for (j = i; j < faces.size() && faces[j].sorted == faces[i].sorted;)
          ++j;
        if (j == i + 1)
          outer.push_back(faces[i].face);
      }
    return outer;
  }

  std::vector<CoarseMesh::Neighbours>
  CoarseMesh::neighbours() const
  {
    const std::vector<FaceOfCell> faces = all_faces(*this);
    Neighbours                    none;
    none.fill(no_cell);
    std::vector<Neighbours> of_cell(cells.size(), none);
    for (std::size_t i = 0; i + 1 < faces.size(); ++i)
      if (const FaceOfCell &a = faces[i], &b = faces[i + 1];
          a.sorted == b.sorted)
        {
          of_cell[a.cell][a.number] = b.cell;
          of_cell[b.cell][b.number] = a.cell;
        }
    return of_cell;
  }

  std::vector<CoarseMesh::Face>
  CoarseMesh::part(
    const std::function<bool(unsigned int, unsigned int)> &are_apart)
  {
    const std::vector<FaceOfCell>          faces = all_faces(*this);
    VertexPieces                           pieces(cells);
    std::vector<std::array<FaceOfCell, 2>> parted;
    for (std::size_t i = 0; i + 1 < faces.size(); ++i)
      {
        const FaceOfCell &a = faces[i], &b = faces[i + 1];
        if (a.sorted != b.sorted)
          continue;
        if (are_apart(cells[a.cell].material_id, cells[b.cell].material_id))
          parted.push_back({{a, b}});
        else
          for (const unsigned int v : a.face)
            if (v != no_vertex)
              pieces.join(v, a.cell, b.cell);
      }
    if (parted.empty())
      return {};
    // The first piece keeps the vertex.
    std::vector<unsigned int> new_vertex(pieces.size(), no_vertex);
    std::vector<bool>         is_taken(points.size(), false), is_cut = is_taken;
    for (const auto &both : parted)
      for (const unsigned int v : both[0].face)
        if (v != no_vertex)
          is_cut[v] = true;
    const auto vertex_of = [&](const unsigned int v, const unsigned int cell) {
      if (!is_cut[v])
        return v;
      unsigned int &own = new_vertex[pieces.of(v, cell)];
      if (own == no_vertex)
        {
          own = is_taken[v] ? points.size() : v;
          if (is_taken[v])
            points.push_back(Point<dim>(points[v]));
          is_taken[v] = true;
        }
      return own;
    };
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int &v : cells[c].vertices)
        v = vertex_of(v, c);
    // Existing sides stay with their cells.
    std::map<Face, unsigned int> cell_of;
    for (const FaceOfCell &at : faces)
      cell_of[at.sorted] = at.cell;
    const auto renumber = [&](auto &sides) {
      for (auto &side : sides)
        {
          Face face;
          face.fill(no_vertex);
          std::copy(side.vertices.begin(), side.vertices.end(), face.begin());
          const unsigned int cell = cell_of.at(sorted(face));
          for (unsigned int &v : side.vertices)
            v = vertex_of(v, cell);
        }
    };
    if constexpr (dim == 2)
      renumber(boundary.boundary_lines);
    else
      renumber(boundary.boundary_quads);
    for (std::vector<double> &line : grid)
      line.clear();
    std::vector<Face> both_sides;
    for (const auto &both : parted)
      for (const FaceOfCell &at : both)
        {
          Face face = at.face;
          for (unsigned int &v : face)
            if (v != no_vertex)
              v = vertex_of(v, at.cell);
          both_sides.push_back(dim == 2 ? sorted(face) : face);
        }
    return both_sides;
  }

  Point<dim>
  CoarseMesh::centre(const Face &face) const
  {
    Point<dim>   sum;
    unsigned int n = 0;
    for (const unsigned int v : face)
      if (v != no_vertex)
        {
          sum += points[v];
          ++n;
        }
    return sum / double(n);
  }

  void
  CoarseMesh::repeat(const unsigned int times)
  {
    const std::size_t n_points = points.size(), n_cells = cells.size();
    points.reserve(times * n_points);
    cells.reserve(times * n_cells);
    const auto repeat_all = [&](auto &list) {
      const std::size_t n = list.size();
      for (unsigned int copy = 1; copy < times; ++copy)
        for (std::size_t i = 0; i < n; ++i)
          {
            auto next = list[i];
            for (unsigned int &v : next.vertices)
              v += copy * n_points;
            list.push_back(next);
          }
    };
    repeat_all(cells);
    if constexpr (dim == 2)
      repeat_all(boundary.boundary_lines);
    else
      repeat_all(boundary.boundary_quads);
    for (unsigned int copy = 1; copy < times; ++copy)
      for (std::size_t i = 0; i < n_points; ++i)
        points.push_back(Point<dim>(points[i]));
  }

  void
  CoarseMesh::add_boundary(const Face                      &face,
                           const dealii::types::boundary_id side)
  {
    if constexpr (dim == 2)
      {
        dealii::CellData<1> line(2);
        line.vertices    = {face[0], face[1]};
        line.boundary_id = side;
        boundary.boundary_lines.push_back(line);
      }
    else
      {
        dealii::CellData<2> quad(face.back() == no_vertex ? 3 : 4);
        std::copy_n(face.begin(), quad.vertices.size(), quad.vertices.begin());
        quad.boundary_id = side;
        boundary.boundary_quads.push_back(quad);
      }
  }
} // namespace geocone::GEOCONE_DIM
