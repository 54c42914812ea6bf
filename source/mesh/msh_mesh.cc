// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/quoted_names.h>
#include <geocone/mesh/msh_mesh.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    double
    signed_area(const std::vector<Point<dim>>   &points,
                const std::vector<unsigned int> &around)
    {
      // Relative to the first point: far from the origin, the area would be
      // lost in the rounding of products of coordinates.
      double area = 0.;
      for (std::size_t i = 1; i + 1 < around.size(); ++i)
        {
          const dealii::Tensor<1, dim> a =
            points[around[i]] - points[around[0]];
          const dealii::Tensor<1, dim> b =
            points[around[i + 1]] - points[around[0]];
          area += (a[0] * b[1] - b[0] * a[1]) / 2.;
        }
      return area;
    }

    /** Smallest signed area of a corner: negative if not convex. */
    double
    worst_corner(const std::vector<Point<dim>>   &points,
                 const std::vector<unsigned int> &around)
    {
      double            worst = std::numeric_limits<double>::max();
      const std::size_t n     = around.size();
      for (std::size_t i = 0; i < n; ++i)
        worst = std::min(
          worst,
          signed_area(points,
                      {around[i], around[(i + 1) % n], around[(i + 2) % n]}));
      return worst;
    }

    std::string
    place(const Point<dim> &x)
    {
      return "(" + text_of_place(x) + ")";
    }

    /** Six times the signed volume of the tetrahedron of four vertices. */
    double
    sixfold_volume(const std::vector<Point<dim>> &points,
                   const std::array<unsigned, 4> &v)
    {
      dealii::Tensor<1, 3> edge[3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          edge[i][c] = points[v[i + 1]][c] - points[v[0]][c];
      return dealii::cross_product_3d(edge[0], edge[1]) * edge[2];
    }

    /** Smallest volume at the corners of a tetrahedron or a hexahedron, in
     *  gmsh's order: negative if it is inverted or not convex there. */
    double
    worst_corner_of_solid(const std::vector<Point<dim>>   &points,
                          const std::vector<unsigned int> &v)
    {
      if (v.size() == 4)
        return sixfold_volume(points, {{v[0], v[1], v[2], v[3]}});
      // Neighbours of each corner, counterclockwise as seen from inside.
      static constexpr unsigned int corners[8][4] = {{0, 1, 3, 4},
                                                     {1, 2, 0, 5},
                                                     {2, 3, 1, 6},
                                                     {3, 0, 2, 7},
                                                     {4, 7, 5, 0},
                                                     {5, 4, 6, 1},
                                                     {6, 5, 7, 2},
                                                     {7, 6, 4, 3}};
      double                        worst = std::numeric_limits<double>::max();
      for (const auto &c : corners)
        worst = std::min(
          worst,
          sixfold_volume(points, {{v[c[0]], v[c[1]], v[c[2]], v[c[3]]}}));
      return worst;
    }

    /** Reverses the orientation. */
    void
    turn_round(std::vector<unsigned int> &v)
    {
      if (dim == 2)
        std::reverse(v.begin(), v.end());
      else if (v.size() == 4)
        std::swap(v[0], v[1]);
      else
        for (unsigned int i = 0; i < 4; ++i)
          std::swap(v[i], v[i + 4]);
    }

    /** Vertices of bodies in contact, which need not be shared. */
    class ApartVertices
    {
    public:
      ApartVertices(const CoarseMesh &mesh, const Contacts *contacts)
        : contacts(contacts)
        , materials(contacts == nullptr ? 0 : mesh.points.size())
      {
        if (contacts == nullptr)
          return;
        for (const auto &cell : mesh.cells)
          for (const unsigned int v : cell.vertices)
            materials[v].insert(cell.material_id);
      }

      bool
      operator()(const unsigned int v, const unsigned int w) const
      {
        if (contacts == nullptr)
          return false;
        for (const unsigned int a : materials[v])
          for (const unsigned int b : materials[w])
            if (contacts->are_apart(a, b))
              return true;
        return false;
      }

    private:
      const Contacts                     *contacts;
      std::vector<std::set<unsigned int>> materials; ///< at a vertex
    };

    /** Rejects coincident vertices in three dimensions, which leave a gap
     *  between cells. */
    void
    check_double_nodes(const CoarseMesh    &mesh,
                       const std::string   &what,
                       const ApartVertices &are_apart)
    {
      std::vector<unsigned int> order(mesh.points.size());
      std::iota(order.begin(), order.end(), 0U);
      const double tolerance = resolved_length(mesh.points);
      std::sort(order.begin(),
                order.end(),
                [&](const unsigned int a, const unsigned int b) {
                  return mesh.points[a][0] < mesh.points[b][0];
                });
      for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1;
             j < order.size() &&
             mesh.points[order[j]][0] - mesh.points[order[i]][0] < tolerance;
             ++j)
          if (mesh.points[order[i]].distance(mesh.points[order[j]]) <
                tolerance &&
              !are_apart(order[i], order[j]))
            throw InputError(
              what + ": there are two nodes at " +
              place(mesh.points[order[i]]) +
              "\n  allowed: conforming meshes without double nodes\n"
              "  remedy:  in gmsh, Coherence before meshing, or "
              "Mesh.RemoveDuplicateNodes");
    }

    /** Each edge must occur at most once in each direction. */
    void
    check_overlap(const std::vector<Point<dim>>                &points,
                  const std::vector<std::vector<unsigned int>> &around,
                  const std::string                            &what)
    {
      std::vector<std::array<unsigned int, 2>> edges;
      for (const auto &v : around)
        for (std::size_t i = 0; i < v.size(); ++i)
          edges.push_back({{v[i], v[(i + 1) % v.size()]}});
      std::sort(edges.begin(), edges.end());
      const auto twice = std::adjacent_find(edges.begin(), edges.end());
      if (twice != edges.end())
        throw InputError(what + ": two cells overlap at the edge from " +
                         place(points[(*twice)[0]]) + " to " +
                         place(points[(*twice)[1]]) +
                         "\n  allowed: cells side by side\n  remedy:  look for "
                         "cells that are there twice or folded, or mesh anew");
    }

    /** Compares the shortest edge with the largest coordinate. */
    void
    check_resolution(const std::vector<Point<dim>>                &points,
                     const std::vector<std::vector<unsigned int>> &around,
                     const std::string                            &what)
    {
      for (const Point<dim> &x : points)
        for (unsigned int c = 0; c < dim; ++c)
          if (std::abs(x[c]) > largest_coordinate)
            throw InputError(what + ": there is a node at " + place(x) +
                             format("\n  allowed: coordinates up to %g m\n",
                                    largest_coordinate) +
                             "  remedy:  scale the mesh to m");
      const double smallest = resolved_length(points);
      for (const auto &v : around)
        for (std::size_t i = 0; i < v.size(); ++i)
          {
            const Point<dim> &a = points[v[i]];
            const Point<dim> &b = points[v[(i + 1) % v.size()]];
            if (!(a.distance(b) >= smallest))
              throw InputError(
                what + ": the edge from " + place(a) + " to " + place(b) +
                format(" has a length of %g m\n  allowed: edges of %g m or "
                       "more, for the coordinates of this mesh\n",
                       a.distance(b),
                       smallest) +
                "  remedy:  mesh anew with larger cells, or move the body "
                "nearer to the origin");
          }
    }

    /** Rejects tetrahedra whose faces do not fit, e.g. with two diagonals of a
     *  square: the faces would be outer ones, and the sides of a crack. */
    void
    check_faces_of_tetrahedra(const CoarseMesh    &mesh,
                              const std::string   &what,
                              const ApartVertices &are_apart)
    {
      using Box = dealii::BoundingBox<dim>;
      std::set<CoarseMesh::Face> outer;
      for (const CoarseMesh::Face &face : mesh.outer_faces())
        outer.insert(CoarseMesh::sorted(face));
      const auto vertices_of = [&](const unsigned int c) {
        std::array<unsigned int, 4> v;
        std::copy_n(mesh.cells[c].vertices.begin(), 4, v.begin());
        return v;
      };
      std::vector<std::pair<Box, unsigned int>> boxes;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          std::vector<Point<dim>> corners;
          for (const unsigned int v : vertices_of(c))
            corners.push_back(mesh.points[v]);
          boxes.emplace_back(Box(corners), c);
        }
      const auto tree = dealii::pack_rtree(boxes);
      std::vector<std::pair<Box, unsigned int>> near;
      std::vector<Point<dim>>                   points = mesh.points;
      points.emplace_back(); // beyond a face
      const unsigned int beyond   = mesh.points.size();
      const auto         contains = [&](const unsigned int c) {
        const double volume = sixfold_volume(points, vertices_of(c));
        for (unsigned int i = 0; i < 4; ++i)
          {
            auto v = vertices_of(c);
            v[i]   = beyond;
            // The point may lie between two cells.
            if (sixfold_volume(points, v) / volume < -1e-9)
              return false;
          }
        return true;
      };
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int i = 0; i < 4; ++i)
          {
            const auto       v    = vertices_of(c);
            CoarseMesh::Face face = {{v[(i + 1) % 4], v[(i + 2) % 4]}};
            face[2]               = v[(i + 3) % 4];
            face[3]               = CoarseMesh::no_vertex;
            if (outer.count(CoarseMesh::sorted(face)) == 0)
              continue;
            const Point<dim> centre = mesh.centre(face);
            points[beyond] = centre + 1e-6 * (centre - mesh.points[v[i]]);
            near.clear();
            tree.query(boost::geometry::index::intersects(points[beyond]),
                       std::back_inserter(near));
            for (const auto &[box, other] : near)
              if (other != c && contains(other) &&
                  !are_apart(v[i], vertices_of(other)[0]))
                throw InputError(
                  what + ": the face of a tetrahedron at " + place(centre) +
                  " does not fit the cell beside it\n"
                  "  allowed: conforming meshes, whose cells share whole "
                  "faces\n  remedy:  in gmsh, Coherence before meshing; a side "
                  "that is meshed by both its bodies has one mesh");
          }
    }

    /** A vertex inside another cell's edge leaves a gap there, unless the cells
     *  belong to bodies in contact. */
    void
    check_hanging_nodes(const CoarseMesh  &mesh,
                        const std::string &what,
                        const Contacts    *contacts)
    {
      const ApartVertices are_apart(mesh, contacts);
      if (dim == 3)
        {
          check_double_nodes(mesh, what, are_apart);
          if (mesh.has_simplices())
            check_faces_of_tetrahedra(mesh, what, are_apart);
          return;
        }
      const auto                edges = mesh.outer_faces();
      std::vector<unsigned int> vertices;
      for (const auto &edge : edges)
        vertices.insert(vertices.end(), edge.begin(), edge.end());
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()),
                     vertices.end());
      std::vector<std::pair<Point<dim>, unsigned int>> places;
      for (const unsigned int v : vertices)
        places.emplace_back(mesh.points[v], v);
      const auto tree = dealii::pack_rtree(places);
      std::vector<std::pair<Point<dim>, unsigned int>> near;
      for (const auto &edge : edges)
        {
          const Point<dim> &a         = mesh.points[edge[0]];
          const Point<dim> &b         = mesh.points[edge[1]];
          const double      tolerance = 1e-9 * a.distance(b);
          Point<dim>        lower, upper;
          for (unsigned int c = 0; c < dim; ++c)
            {
              lower[c] = std::min(a[c], b[c]) - tolerance;
              upper[c] = std::max(a[c], b[c]) + tolerance;
            }
          near.clear();
          tree.query(boost::geometry::index::intersects(
                       dealii::BoundingBox<dim>({lower, upper})),
                     std::back_inserter(near));
          for (const auto &[x, v] : near)
            if (v != edge[0] && v != edge[1] &&
                distance_to_segment(x, a, b) < tolerance &&
                !are_apart(v, edge[0]))
              throw InputError(
                what + ": the node at " + place(x) +
                " hangs on the edge from " + place(a) + " to " + place(b) +
                "\n  allowed: conforming meshes without double nodes\n"
                "  remedy:  in gmsh, Coherence before meshing, or "
                "Mesh.RemoveDuplicateNodes");
        }
    }

    /** Physical curves by number and by name, both unique. */
    void
    set_sides(const MshData &data, const std::string &what, CoarseMesh &mesh)
    {
      for (const int group : data.face_groups)
        mesh.sides[std::to_string(group)] = group;
      for (const int group : data.face_groups)
        if (const auto name = data.face_names.find(group);
            name != data.face_names.end())
          {
            const auto [side, is_new] =
              mesh.sides.emplace(name_in_list(name->second), group);
            if (!is_new && side->second != dealii::types::boundary_id(group))
              throw InputError(what + ": '" + name->second +
                               "' is the name of the physical " + face_word +
                               " " + std::to_string(group) +
                               ", and the name or number of another one\n"
                               "  allowed: names that are unique\n"
                               "  remedy:  rename one of them in gmsh");
          }
    }

    std::string
    name_of_curve(const MshData &data, const int group)
    {
      const auto name = data.face_names.find(group);
      return name == data.face_names.end() ? std::to_string(group)
                                           : "'" + name->second + "'";
    }

    /** Requires cells, and not more than deal.II's indices allow. */
    void
    check_amount(const MshData &data, const std::string &what)
    {
      if (data.cells.empty())
        throw InputError(
          what +
          (dim == 2
             ? " holds no cells in two dimensions\n"
               "  allowed: triangles or quadrilaterals\n"
               "  remedy:  mesh a surface in the (x, y) plane and save it "
               "(if there are physical groups, the surface needs one)"
             : " holds no cells in three dimensions\n"
               "  allowed: tetrahedra or hexahedra\n"
               "  remedy:  mesh a volume and save it (if there are "
               "physical groups, the volume needs one), or set "
               "Geometry/Dimension = 2"));
      if (data.nodes.size() >= std::numeric_limits<int>::max() ||
          data.cells.size() >= std::numeric_limits<int>::max())
        throw InputError(what + " has more than 2^31 nodes or cells\n"
                                "  remedy:  mesh with fewer cells");
    }

    using Elements = std::vector<const MshData::Element *>;

    /** Cells by surface, with the triangles of a surface first. */
    Elements
    in_order_of_gmsh(const std::vector<MshData::Element> &cells)
    {
      Elements order;
      for (const MshData::Element &cell : cells)
        order.push_back(&cell);
      std::stable_sort(
        order.begin(), order.end(), [](const auto *first, const auto *second) {
          return std::make_pair(first->entity, first->type) <
                 std::make_pair(second->entity, second->type);
        });
      return order;
    }

    /** Vertex numbers of nodes; nodes without cells have none. */
    class VertexNumbers
    {
    public:
      /** @throws InputError if tags are not unique */
      VertexNumbers(const std::vector<MshData::Node> &nodes,
                    const std::string                &what)
        : nodes(nodes)
        , what(what)
        , vertex(nodes.size(), CoarseMesh::no_vertex)
      {
        for (unsigned int i = 0; i < nodes.size(); ++i)
          node_of_tag.emplace_back(nodes[i].tag, i);
        std::sort(node_of_tag.begin(), node_of_tag.end());
        for (std::size_t i = 0; i + 1 < node_of_tag.size(); ++i)
          if (node_of_tag[i].first == node_of_tag[i + 1].first)
            throw InputError(
              what + ": there are two nodes with the tag " +
              std::to_string(node_of_tag[i].first) +
              "\n  allowed: tags that are unique\n  remedy:  " + msh_remedy);
        for (const MshData::Node &node : nodes)
          for (const double x : node.x)
            largest = std::max(largest, std::abs(x));
      }

      /** Vertices of a cell; new nodes obtain new vertices.
       *  @throws InputError if a node is missing or not in the plane */
      std::vector<unsigned int>
      of_cell(const MshData::Element &cell, std::vector<Point<dim>> &points)
      {
        std::vector<unsigned int> vertices;
        for (unsigned int i = 0; i < n_nodes_of_type(cell.type); ++i)
          {
            const unsigned int n = node(cell, i);
            if (vertex[n] == CoarseMesh::no_vertex)
              {
                vertex[n] = points.size();
                points.push_back(position_of(nodes[n]));
              }
            vertices.push_back(vertex[n]);
          }
        return vertices;
      }

      /** Vertices of a face, or none if one of its nodes belongs to no cell.
       *  @throws InputError if a node is missing */
      std::optional<CoarseMesh::Face>
      of_face(const MshData::Element &element) const
      {
        CoarseMesh::Face face;
        face.fill(CoarseMesh::no_vertex);
        bool is_known = true;
        for (unsigned int i = 0; i < n_nodes_of_type(element.type); ++i)
          {
            face[i]  = vertex[node(element, i)];
            is_known = is_known && face[i] != CoarseMesh::no_vertex;
          }
        return is_known ? std::make_optional(face) : std::nullopt;
      }

    private:
      unsigned int
      node(const MshData::Element &element, const unsigned int i) const
      {
        const std::uint64_t tag = element.nodes[i];
        const auto          at  = std::lower_bound(
          node_of_tag.begin(), node_of_tag.end(), std::make_pair(tag, 0U));
        if (at == node_of_tag.end() || at->first != tag)
          throw InputError(
            what + ": the node " + std::to_string(tag) + " of the element " +
            std::to_string(element.tag) +
            " is missing\n  allowed: nodes of the section $Nodes\n"
            "  remedy:  " +
            msh_remedy);
        return at->second;
      }

      Point<dim>
      position_of(const MshData::Node &node) const
      {
        const auto &x = node.x;
        if (dim == 2 && !(std::abs(x[2]) <= 1e-9 * largest))
          throw InputError(
            what + ": the node " + std::to_string(node.tag) +
            format(" is at (%g, %g, %g)", x[0], x[1], x[2]) +
            "\n  allowed: nodes in the plane z = 0\n  remedy:  turn or "
            "move the mesh into the (x, y) plane (in gmsh: Rotate, "
            "Translate)");
        Point<dim> point;
        for (unsigned int c = 0; c < dim; ++c)
          point[c] = x[c];
        return point;
      }

      const std::vector<MshData::Node>                   &nodes;
      const std::string                                  &what;
      std::vector<unsigned int>                           vertex; ///< of a node
      std::vector<std::pair<std::uint64_t, unsigned int>> node_of_tag;
      double largest = 0.; ///< coordinate
    };

    /** Turns clockwise cells round, e.g. those of a surface that looks down:
     *  cells that fold over others overlap then. Solids are turned round
     *  together. */
    void
    orient(const std::vector<Point<dim>>          &points,
           const Elements                         &cells,
           const std::string                      &what,
           std::vector<std::vector<unsigned int>> &around)
    {
      double total = 0.;
      if (dim == 3)
        for (const auto &v : around)
          total += worst_corner_of_solid(points, v);
      for (std::size_t c = 0; c < around.size(); ++c)
        {
          std::vector<unsigned int> &v = around[c];
          if ((dim == 2 ? signed_area(points, v) : total) < 0.)
            turn_round(v);
          if (!((dim == 2 ? worst_corner(points, v)
                          : worst_corner_of_solid(points, v)) > 0.))
            throw InputError(
              what + ": the cell " + std::to_string(cells[c]->tag) + " at " +
              place(points[v[0]]) +
              " is inverted or not convex\n  allowed: cells with positive area "
              "at every corner\n  remedy:  reorder its nodes, or mesh anew");
        }
    }

    /** Divides the quadrilaterals of a mesh that has triangles, too, by their shorter
     *  diagonals: elements are of one kind. */
    void
    divide_quadrilaterals(const std::vector<Point<dim>>          &points,
                          Elements                               &cells,
                          std::vector<std::vector<unsigned int>> &around)
    {
      const auto is_triangle = [](const auto &v) { return v.size() == 3; };
      if (dim == 3 || std::none_of(around.begin(), around.end(), is_triangle) ||
          std::all_of(around.begin(), around.end(), is_triangle))
        return;
      Elements                               divided;
      std::vector<std::vector<unsigned int>> corners;
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          const auto &v = around[c];
          if (is_triangle(v))
            corners.push_back(v);
          else
            {
              const unsigned int first =
                points[v[1]].distance(points[v[3]]) <
                (1. - 1e-9) * points[v[0]].distance(points[v[2]]);
              for (const unsigned int i : {first, first + 2})
                corners.push_back({v[i], v[(i + 1) % 4], v[(i + 2) % 4]});
              divided.push_back(cells[c]);
            }
          divided.push_back(cells[c]);
        }
      cells  = std::move(divided);
      around = std::move(corners);
    }

    /** Adds cells with their vertices in deal.II's order, lexicographic except
     *  for simplices, and the last material whose region contains them. */
    void
    add_cells(const Elements                               &cells,
              const std::vector<std::vector<unsigned int>> &around,
              const MshData                                &data,
              const Regions                                &regions,
              CoarseMesh                                   &mesh)
    {
      std::map<int, std::string> groups = data.cell_names;
      for (const MshData::Element *const element : cells)
        for (const int group : data.group_lists[element->groups])
          groups.emplace(group, "");
      regions.check_groups(groups);
      for (std::size_t c = 0; c < around.size(); ++c)
        {
          dealii::CellData<dim> cell(around[c].size());
          cell.vertices = around[c];
          if (cell.vertices.size() != dim + 1)
            for (unsigned int i = 2; i < cell.vertices.size(); i += 4)
              std::swap(cell.vertices[i], cell.vertices[i + 1]);
          const Point<dim> centre = mesh.centre(cell);
          unsigned int     filled = regions.material_at(centre);
          for (const int group : data.group_lists[cells[c]->groups])
            filled = std::max(
              filled,
              regions.material_at(centre, group, groups.find(group)->second));
          cell.material_id = filled;
          mesh.cells.push_back(cell);
        }
    }

    /** Faces by their sorted vertices, with one of their physical groups. */
    using FaceGroups = std::vector<std::pair<CoarseMesh::Face, int>>;

    FaceGroups
    groups_of_faces(const MshData &data, const VertexNumbers &vertices)
    {
      FaceGroups groups;
      for (const MshData::Element &element : data.faces)
        if (const auto face = vertices.of_face(element))
          for (const int group : data.group_lists[element.groups])
            groups.emplace_back(CoarseMesh::sorted(*face), group);
      std::sort(groups.begin(), groups.end());
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
      return groups;
    }

    /** Assigns the numbers of physical groups to outer faces, one to each. */
    void
    set_boundary(const FaceGroups  &groups,
                 const MshData     &data,
                 const std::string &what,
                 CoarseMesh        &mesh)
    {
      for (const CoarseMesh::Face &outer : mesh.outer_faces())
        {
          const CoarseMesh::Face face = CoarseMesh::sorted(outer);
          const auto             side = std::lower_bound(
            groups.begin(), groups.end(), std::make_pair(face, 0));
          if (side == groups.end() || side->first != face)
            continue;
          if (side + 1 != groups.end() && (side + 1)->first == face)
            throw InputError(
              what + ": the " + (dim == 2 ? "edge from " : "face with ") +
              place(mesh.points[outer[0]]) + (dim == 2 ? " to " : " and ") +
              place(mesh.points[outer[1]]) + " is on the physical " +
              face_word + "s " + name_of_curve(data, side->second) + " and " +
              name_of_curve(data, (side + 1)->second) +
              "\n  allowed: one physical " + face_word +
              (dim == 2 ? " for each edge" : " for each face") +
              "\n  remedy:  make groups that share no " + face_word +
              "; a condition takes several sides");
          mesh.add_boundary(outer, side->second);
        }
    }
  } // namespace

  CoarseMesh
  coarse_mesh(const MshData     &data,
              const std::string &what,
              const Regions     &regions,
              const Contacts    *contacts)
  {
    check_amount(data, what);
    Elements                               cells = in_order_of_gmsh(data.cells);
    VertexNumbers                          vertices(data.nodes, what);
    CoarseMesh                             mesh;
    std::vector<std::vector<unsigned int>> around;
    for (const MshData::Element *cell : cells)
      around.push_back(vertices.of_cell(*cell, mesh.points));
    check_resolution(mesh.points, around, what);
    orient(mesh.points, cells, what, around);
    if (dim == 2)
      check_overlap(mesh.points, around, what);
    divide_quadrilaterals(mesh.points, cells, around);
    add_cells(cells, around, data, regions, mesh);

    const FaceGroups groups = groups_of_faces(data, vertices);
    set_sides(data, what, mesh);
    set_boundary(groups, data, what, mesh);
    check_hanging_nodes(mesh, what, contacts);
    if (!mesh.has_simplices())
      dealii::GridTools::consistently_order_cells(mesh.cells);
    return mesh;
  }
} // namespace geocone::GEOCONE_DIM
