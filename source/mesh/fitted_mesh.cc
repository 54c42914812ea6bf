// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/quoted_names.h>
#include <geocone/mesh/domain_of_triangles.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/mesh/structured_mesh.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** The side of a domain nearest to x. @param loops its outline and holes */
    types::boundary_id
    nearest_side(const std::vector<Polygon> &loops, const Point<dim> &x)
    {
      std::size_t nearest = 0, first = 0;
      double      distance = std::numeric_limits<double>::max();
      if (dim == 3)
        {
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < 2; ++i)
              if (const double d = std::abs(x[c] - loops[0][i][c]);
                  d < distance)
                {
                  distance = d;
                  nearest  = sides_of_box().at(side_of_box[c][i]);
                }
          return nearest;
        }
      for (const Polygon &loop : loops)
        {
          for (std::size_t i = 0; i < loop.size(); ++i)
            if (const double d =
                  distance_to_segment(x, loop[i], loop[(i + 1) % loop.size()]);
                d < distance)
              {
                distance = d;
                nearest  = first + i;
              }
          first += loop.size();
        }
      return nearest;
    }

    void
    set_materials_and_sides(CoarseMesh                 &mesh,
                            const Regions              &regions,
                            const std::vector<Polygon> &loops)
    {
      for (auto &cell : mesh.cells)
        cell.material_id = regions.material_at(mesh.centre(cell));
      for (const CoarseMesh::Face &face : mesh.outer_faces())
        mesh.add_boundary(face, nearest_side(loops, mesh.centre(face)));
    }

    /** Lines of the water and of what stages remove, which cuts complete cells,
     *  as edges of plane meshes. */
    MeshLines
    lines_of_scene(const Scene &scene, const dealii::BoundingBox<dim> &domain)
    {
      const auto [low, high] = domain.get_boundary_points();
      MeshLines lines        = scene.water.lines(low, high);
      for (const auto &stage : scene.loading.list)
        if (const Polygon &polygon = stage->removed_polygon; !polygon.empty())
          for (std::size_t i = 0; i < polygon.size(); ++i)
            lines.push_back({{polygon[i], polygon[(i + 1) % polygon.size()]}});
      // Plates are tied to nodes.
      for (const auto &line : scene.structures.lines())
        lines.push_back(line);
      return lines;
    }

    /** A mesh of the body of a file with prescribed sizes.
     *  @throws InputError if no other mesh can be made of it */
    CoarseMesh
    other_mesh_of_file(const CoarseMesh     &of_file,
                       const MeshParameters &parameters,
                       const Scene          &scene,
                       const CellSizes      &sizes,
                       const MPI_Comm        comm)
    {
      const Triangles         triangles(of_file);
      const DomainOfTriangles domain = domain_of_file(triangles, scene);
      if (!domain.obstacle().empty())
        throw InputError("Mesh/Type",
                         parameters.type.word(),
                         "unstructured with a mesh from this file",
                         domain.obstacle() + ": give a mesh of one body");
      return domain.mesh(
        sizes,
        lines_of_scene(scene, dealii::BoundingBox<dim>(of_file.points)),
        parameters.algorithm,
        comm);
    }
  } // namespace

  CoarseMesh
  fitted_mesh(const MeshParameters &parameters,
              const Scene          &scene,
              const MPI_Comm        comm,
              const CellSizes      *sizes,
              const bool            parts_bodies)
  {
    if (scene.geometry.shape == Geometry::Shape::file)
      {
        const CoarseMesh of_file =
          mesh_of_file(scene.geometry,
                       scene.regions,
                       parts_bodies ? &scene.contacts : nullptr,
                       comm);
        if (sizes == nullptr)
          return of_file;
        if constexpr (dim == 2)
          return other_mesh_of_file(of_file, parameters, scene, *sizes, comm);
      }
    const dealii::BoundingBox<dim> domain(parameters.outline);
    CoarseMesh                     mesh;
    if (!parameters.is_unstructured())
      mesh = structured_mesh(parameters);
    else
      {
        MeshLines lines;
        if (dim == 2)
          lines = lines_of_scene(scene, domain);
        mesh =
          sizes != nullptr
            ? mesh_with_sizes(
                domain_of(parameters), scene.regions, lines, *sizes, comm)
            : unstructured_mesh(parameters, scene.regions, lines, comm);
      }
    std::vector<Polygon> loops = {parameters.outline};
    loops.insert(loops.end(), parameters.holes.begin(), parameters.holes.end());
    set_materials_and_sides(mesh, scene.regions, loops);
    mesh.sides = parameters.fits_body ? scene.geometry.sides : sides_of_box();
    return mesh;
  }

  CoarseMesh
  triangles_of_body(const Scene                   &scene,
                    const std::vector<Point<dim>> &vertices,
                    const MeshLines               &lines,
                    const CellSizes               &sizes,
                    const MPI_Comm                 comm)
  {
    const Geometry &geometry = scene.geometry;
    if (geometry.shape == Geometry::Shape::file)
      {
        CoarseMesh of_file =
          mesh_of_file(geometry, scene.regions, nullptr, comm);
        if (!of_file.has_simplices())
          throw InputError("Geometry/File",
                           geometry.file,
                           "a mesh of triangles where water flows",
                           "mesh the domain with triangles");
        return of_file;
      }
    MeshDomain domain;
    domain.outline  = geometry.outline;
    domain.holes    = geometry.holes;
    domain.vertices = vertices;
    CoarseMesh mesh = mesh_with_sizes(domain, scene.regions, lines, sizes, comm);
    set_materials_and_sides(mesh, scene.regions, geometry.loops());
    mesh.sides = geometry.sides;
    return mesh;
  }

  std::set<types::boundary_id>
  side_ids(const BoundaryPart                              &condition,
           const std::map<std::string, types::boundary_id> &sides,
           const std::vector<types::boundary_id>           &all)
  {
    std::set<types::boundary_id> ids;
    for (const std::string &name : condition.sides)
      {
        const auto side = sides.find(name);
        if (name == "all")
          {
            if (side != sides.end())
              throw InputError(condition.parameter("Sides"),
                               name,
                               "all sides, but one of them is named all",
                               "choose that one by its number, or rename it in "
                               "the mesh file");
            ids.insert(all.begin(), all.end());
            continue;
          }
        if (side == sides.end())
          {
            std::string known = "all";
            for (const auto &entry : sides)
              known += ", " + quoted_if_needed(entry.first);
            throw InputError(
              condition.parameter("Sides"),
              name,
              known,
              sides.empty() ? "the mesh names no side: give 'Sides = all' and "
                              "the part in 'Box' or 'Where', or make physical "
                              "curves in the mesh file"
                            : "choose some of them");
          }
        if (std::find(all.begin(), all.end(), side->second) == all.end())
          throw InputError(condition.parameter("Sides"),
                           name,
                           "sides on the boundary of the mesh",
                           "no " + std::string(dim == 2 ? "edge" : "face") +
                             " of this side is on the boundary: it lies inside "
                             "the body, or its cells are not in the file; "
                             "choose another one");
        ids.insert(side->second);
      }
    return ids;
  }
} // namespace geocone::GEOCONE_DIM
