// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/mesh/structured_mesh.h>

#include <deal.II/base/bounding_box.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** The side of a polygon nearest to x. */
    types::boundary_id
    nearest_side(const Polygon &outline, const Point<dim> &x)
    {
      std::size_t nearest  = 0;
      double      distance = std::numeric_limits<double>::max();
      if (dim == 3)
        {
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < 2; ++i)
              if (const double d = std::abs(x[c] - outline[i][c]); d < distance)
                {
                  distance = d;
                  nearest  = sides_of_box().at(side_of_box[c][i]);
                }
          return nearest;
        }
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (const double d = distance_to_segment(
              x, outline[i], outline[(i + 1) % outline.size()]);
            d < distance)
          {
            distance = d;
            nearest  = i;
          }
      return nearest;
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
      return mesh_of_file(scene.geometry,
                          scene.regions,
                          parts_bodies ? &scene.contacts : nullptr,
                          comm);
    const dealii::BoundingBox<dim> domain(parameters.outline);
    CoarseMesh                     mesh;
    if (!parameters.is_unstructured())
      mesh = structured_mesh(parameters);
    else
      {
        MeshLines lines;
        if (dim == 2)
          {
            lines = scene.water.lines(domain.get_boundary_points().first,
                                      domain.get_boundary_points().second);
            // Stages remove complete cells.
            for (const auto &stage : scene.loading.list)
              if (const Polygon &polygon = stage->removed_polygon;
                  !polygon.empty())
                for (std::size_t i = 0; i < polygon.size(); ++i)
                  lines.push_back(
                    {{polygon[i], polygon[(i + 1) % polygon.size()]}});
          }
        mesh =
          sizes != nullptr
            ? mesh_with_sizes(parameters, scene.regions, lines, *sizes, comm)
            : unstructured_mesh(parameters, scene.regions, lines, comm);
      }
    for (auto &cell : mesh.cells)
      cell.material_id = scene.regions.material_at(mesh.centre(cell));
    mesh.sides = parameters.fits_body ? scene.geometry.sides : sides_of_box();
    for (const CoarseMesh::Face &face : mesh.outer_faces())
      mesh.add_boundary(face,
                        nearest_side(parameters.outline, mesh.centre(face)));
    return mesh;
  }

  std::set<types::boundary_id>
  side_ids(const BoundaryCondition                         &condition,
           const std::map<std::string, types::boundary_id> &sides,
           const std::vector<types::boundary_id>           &all)
  {
    std::set<types::boundary_id> ids;
    for (const std::string &name : condition.sides)
      {
        if (name == "all")
          {
            ids.insert(all.begin(), all.end());
            continue;
          }
        const auto side = sides.find(name);
        if (side == sides.end())
          {
            std::string known = "all";
            for (const auto &entry : sides)
              known += ", " + entry.first;
            throw InputError(
              condition.parameter("Sides"),
              name,
              known,
              sides.empty() ? "the mesh names no side: give 'Sides = all' and "
                              "the part in 'Box' or 'Where', or make physical "
                              "curves in the mesh file"
                            : "choose some of them");
          }
        ids.insert(side->second);
      }
    return ids;
  }
} // namespace geocone::GEOCONE_DIM
