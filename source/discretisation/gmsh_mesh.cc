// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/coarse_mesh.h>

#include <deal.II/grid/grid_tools.h>

#include <gmsh.h>

#include <cmath>
#include <filesystem>
#include <set>

// Everything that talks to gmsh.

namespace geocone
{
  using dealii::Point;

  namespace
  {
    /** One gmsh session; gmsh keeps its model in global state. */
    class Session
    {
    public:
      Session()
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
      }
      ~Session()
      {
        gmsh::finalize();
      }
    };

    std::vector<int>
    physical_groups(const int dimension, const int tag)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(dimension, tag, groups);
      return groups;
    }

    double
    signed_area(const std::vector<Point<dim>>   &points,
                const std::vector<unsigned int> &around)
    {
      double area = 0.;
      for (std::size_t i = 0; i < around.size(); ++i)
        {
          const Point<dim> &a = points[around[i]];
          const Point<dim> &b = points[around[(i + 1) % around.size()]];
          area += (a[0] * b[1] - b[0] * a[1]) / 2.;
        }
      return area;
    }

    /** The smallest signed area of a corner: negative where not convex. */
    double
    worst_corner(const std::vector<Point<dim>>   &points,
                 const std::vector<unsigned int> &around)
    {
      double            worst = 1e300;
      const std::size_t n     = around.size();
      for (std::size_t i = 0; i < n; ++i)
        worst = std::min(
          worst,
          signed_area(points,
                      {around[i], around[(i + 1) % n], around[(i + 2) % n]}));
      return worst;
    }

    /**
     * Copies the present gmsh model. @p surfaces: the surfaces to take, all if
     * empty. The material id of a cell is its physical surface, -1 without.
     */
    CoarseMesh
    copy_model(const std::set<int> &surfaces, const std::string &what)
    {
      CoarseMesh               mesh;
      std::vector<std::size_t> node_tags;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(node_tags, coordinates, parametric);
      std::map<std::size_t, unsigned int> node_of_tag;

      // Only nodes of cells become vertices: a file may hold others.
      const auto vertex = [&](const std::size_t i) {
        const auto [entry, is_new] =
          node_of_tag.emplace(node_tags[i], mesh.points.size());
        if (is_new)
          mesh.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
        return entry->second;
      };
      std::map<std::size_t, std::size_t> place;
      for (std::size_t i = 0; i < node_tags.size(); ++i)
        place[node_tags[i]] = i;

      std::vector<std::vector<unsigned int>> around;
      std::vector<std::size_t>               tags;
      gmsh::vectorpair                       entities;
      gmsh::model::getEntities(entities, 2);
      for (const auto &entity : entities)
        {
          if (!surfaces.empty() && surfaces.count(entity.second) == 0)
            continue;
          const std::vector<int> groups = physical_groups(2, entity.second);
          std::vector<int>       types;
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(
            types, elements, nodes, 2, entity.second);
          for (std::size_t t = 0; t < types.size(); ++t)
            {
              // gmsh's element types: 2 and 3 are the linear cells.
              if (types[t] != 2 && types[t] != 3)
                throw InputError(what + " holds cells of gmsh's type " +
                                 std::to_string(types[t]) +
                                 "\n  allowed: triangles and quadrilaterals of "
                                 "first order\n  remedy:  write it with "
                                 "Mesh.ElementOrder = 1");
              const std::size_t n = types[t] + 1;
              for (std::size_t e = 0; e < elements[t].size(); ++e)
                {
                  std::vector<unsigned int> vertices;
                  for (std::size_t i = 0; i < n; ++i)
                    vertices.push_back(vertex(place.at(nodes[t][n * e + i])));
                  around.push_back(vertices);
                  tags.push_back(elements[t][e]);
                  dealii::CellData<dim> cell(n);
                  cell.material_id = groups.empty()
                                       ? dealii::numbers::invalid_material_id
                                       : groups[0];
                  mesh.cells.push_back(cell);
                }
            }
        }
      if (mesh.cells.empty())
        throw InputError(what + " holds no cells in two dimensions\n"
                                "  remedy:  mesh a surface in the (x, y) plane "
                                "and save it (if there are physical groups, "
                                "the surface needs one)");

      // A mesh may be oriented clockwise as a whole; single cells may not.
      double total = 0.;
      for (const auto &vertices : around)
        total += signed_area(mesh.points, vertices);
      for (std::size_t c = 0; c < around.size(); ++c)
        {
          std::vector<unsigned int> &v = around[c];
          if (total < 0.)
            std::reverse(v.begin(), v.end());
          if (!(worst_corner(mesh.points, v) > 0.))
            throw InputError(
              what + ": the cell " + std::to_string(tags[c]) +
              format(
                " at (%g, %g)", mesh.points[v[0]][0], mesh.points[v[0]][1]) +
              " is inverted or not convex\n  allowed: cells with positive area "
              "at every corner\n  remedy:  reorder its nodes, or mesh anew");
          if (v.size() == 4)
            std::swap(v[2], v[3]); // deal.II numbers lexicographically
          mesh.cells[c].vertices = v;
        }

      // Curves in physical groups are sides, by number and by name.
      std::map<std::array<unsigned int, 2>, int> side_of_edge;
      gmsh::model::getEntities(entities, 1);
      for (const auto &entity : entities)
        for (const int group : physical_groups(1, entity.second))
          {
            std::string name;
            gmsh::model::getPhysicalName(1, group, name);
            mesh.sides[std::to_string(group)] = group;
            if (!name.empty())
              mesh.sides[name] = group;
            std::vector<int>                      types;
            std::vector<std::vector<std::size_t>> elements, nodes;
            gmsh::model::mesh::getElements(
              types, elements, nodes, 1, entity.second);
            for (std::size_t t = 0; t < types.size(); ++t)
              for (std::size_t i = 0; i + 1 < nodes[t].size(); i += 2)
                if (node_of_tag.count(nodes[t][i]) > 0 &&
                    node_of_tag.count(nodes[t][i + 1]) > 0)
                  {
                    const unsigned int a = node_of_tag[nodes[t][i]];
                    const unsigned int b = node_of_tag[nodes[t][i + 1]];
                    side_of_edge[{{std::min(a, b), std::max(a, b)}}] = group;
                  }
          }
      for (const auto &edge : mesh.outer_edges())
        if (const auto side = side_of_edge.find(edge);
            side != side_of_edge.end())
          {
            dealii::CellData<1> line(2);
            line.vertices    = {edge[0], edge[1]};
            line.boundary_id = side->second;
            mesh.boundary.boundary_lines.push_back(line);
          }
      return mesh;
    }

    /** A vertex in the middle of another cell's edge leaves a gap there. */
    void
    check_hanging_nodes(const CoarseMesh &mesh, const std::string &what)
    {
      const auto             edges = mesh.outer_edges();
      std::set<unsigned int> vertices;
      for (const auto &edge : edges)
        vertices.insert(edge.begin(), edge.end());
      for (const auto &edge : edges)
        for (const unsigned int v : vertices)
          if (v != edge[0] && v != edge[1])
            {
              const Point<dim> &a = mesh.points[edge[0]];
              const Point<dim> &b = mesh.points[edge[1]];
              if (distance_to_segment(mesh.points[v], a, b) <
                  1e-9 * a.distance(b))
                throw InputError(
                  what +
                  format(": the node at (%g, %g) hangs on the edge from "
                         "(%g, %g) to (%g, %g)",
                         mesh.points[v][0],
                         mesh.points[v][1],
                         a[0],
                         a[1],
                         b[0],
                         b[1]) +
                  "\n  allowed: conforming meshes without double nodes\n"
                  "  remedy:  in gmsh, Coherence before meshing, or "
                  "Mesh.RemoveDuplicateNodes");
            }
    }

    void
    order_quadrilaterals(CoarseMesh &mesh)
    {
      if (!mesh.has_triangles())
        dealii::GridTools::consistently_order_cells(mesh.cells);
    }
  } // namespace

  CoarseMesh
  read_msh(const std::string &file_name, const Regions &regions)
  {
    const std::string what =
      "the mesh '" + std::filesystem::path(file_name).filename().string() + "'";
    const Session session;
    try
      {
        gmsh::open(file_name);
      }
    catch (const std::exception &)
      {
        throw InputError(what + " cannot be read\n  allowed: gmsh .msh files\n"
                                "  remedy:  open it in gmsh to see what is "
                                "wrong");
      }
    CoarseMesh mesh = copy_model({}, what);
    check_hanging_nodes(mesh, what);
    for (auto &cell : mesh.cells)
      cell.material_id = regions.material_at(
        mesh.centre(cell),
        cell.material_id == dealii::numbers::invalid_material_id
          ? -1
          : static_cast<int>(cell.material_id));
    order_quadrilaterals(mesh);
    return mesh;
  }

  CoarseMesh
  unstructured_mesh(const MeshParameters &parameters, const Regions &regions)
  {
    const Session session;
    namespace occ = gmsh::model::occ;
    gmsh::model::add("domain");

    const auto surface = [](const Polygon &polygon) {
      std::vector<int> points, lines;
      for (const Point<dim> &x : polygon)
        points.push_back(occ::addPoint(x[0], x[1], 0.));
      for (std::size_t i = 0; i < points.size(); ++i)
        lines.push_back(
          occ::addLine(points[i], points[(i + 1) % points.size()]));
      return occ::addPlaneSurface({occ::addCurveLoop(lines)});
    };

    // The domain is fragmented by the materials' borders and by the grading
    // points, which so become edges and vertices of the mesh.
    const gmsh::vectorpair domain = {{2, surface(parameters.outline)}};
    gmsh::vectorpair       tools;
    for (const Polygon &polygon : regions.polygons())
      tools.emplace_back(2, surface(polygon));
    for (const Point<dim> &x : parameters.grading_points)
      tools.emplace_back(0, occ::addPoint(x[0], x[1], 0.));
    gmsh::vectorpair              pieces = domain;
    std::vector<gmsh::vectorpair> origin = {domain};
    if (!tools.empty())
      occ::fragment(domain, tools, pieces, origin);
    occ::synchronize();
    std::set<int> surfaces;
    for (const auto &piece : origin[0])
      surfaces.insert(piece.second);

    if (parameters.grading_points.empty())
      {
        gmsh::option::setNumber("Mesh.MeshSizeMin", parameters.cell_size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", parameters.cell_size);
      }
    else
      {
        // One field per point, by formula: the options of gmsh's distance
        // fields have changed names between versions.
        std::vector<double> fields;
        for (const Point<dim> &x : parameters.grading_points)
          {
            const int field = gmsh::model::mesh::field::add("MathEval");
            gmsh::model::mesh::field::setString(
              field,
              "F",
              format("%.17g*Sqrt((x-(%.17g))^2+(y-(%.17g))^2)",
                     parameters.size_ratio,
                     x[0],
                     x[1]));
            fields.push_back(field);
          }
        const int smallest = gmsh::model::mesh::field::add("Min");
        gmsh::model::mesh::field::setNumbers(smallest, "FieldsList", fields);
        gmsh::model::mesh::field::setAsBackgroundMesh(smallest);
        gmsh::option::setNumber("Mesh.MeshSizeMin", parameters.smallest);
        gmsh::option::setNumber("Mesh.MeshSizeMax", parameters.largest);
      }
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.Algorithm", parameters.algorithm);
    if (parameters.cells == "quadrilaterals")
      {
        gmsh::option::setNumber("Mesh.RecombineAll", 1);
        // Recombined triangles, then each cell cut in four (or three): only
        // quadrilaterals remain.
        gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1);
        gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 1);
      }
    try
      {
        gmsh::model::mesh::generate(2);
      }
    catch (const std::exception &exception)
      {
        throw InputError(std::string("gmsh cannot mesh the domain: ") +
                         exception.what() +
                         "\n  remedy:  change 'Mesh/Smallest size', 'Mesh/Size "
                         "ratio' or 'Mesh/Gmsh algorithm'");
      }
    CoarseMesh mesh = copy_model(surfaces, "the mesh that gmsh has made");
    order_quadrilaterals(mesh);
    return mesh;
  }
} // namespace geocone
