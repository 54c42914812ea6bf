// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/model_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;
  using Face = ModelMesh::Face;

  namespace
  {
    /** Limit of a legible picture. */
    constexpr std::size_t most_cells_drawn = 30000;

    /** Subdivisions of a face, some of which may belong to a condition. */
    const std::array<unsigned int, dim - 1> number_of_parts = {{8}};

    template <int size>
    Json
    json(const Tensor<1, size> &x)
    {
      Json all = Json::array();
      for (unsigned int c = 0; c < size; ++c)
        all.push_back(x[c]);
      return all;
    }

    template <typename Places>
    Json
    json_of_places(const Places &places)
    {
      Json all = Json::array();
      for (const auto &x : places)
        all.push_back(json(x));
      return all;
    }

    /** Parts of a face on which a condition acts. */
    std::vector<SidePart>
    held_parts(const SidePart &face, const BoundaryCondition &condition)
    {
      std::vector<SidePart> held;
      if (dim == 3)
        {
          if (condition.holds_at(face.middle()))
            held.push_back(face);
          return held;
        }
      bool continues = false;
      for (const SidePart &part : parts_of(face, number_of_parts))
        {
          const bool holds = condition.holds_at(part.middle());
          if (holds && continues)
            held.back().corners[1] = part.corners[1];
          else if (holds)
            held.push_back(part);
          continues = holds;
        }
      return held;
    }

    /** A sampling time of prescribed values. */
    struct Sample
    {
      double      t;
      std::string stage;
    };

    /** Sampling times: the ends of the stages and of tenths of them. */
    std::vector<Sample>
    times_of(const LoadingProgramme &loading)
    {
      std::vector<Sample> times = {{0., loading.list.front()->name}};
      for (const auto &stage : loading.list)
        {
          const double begin = times.back().t;
          for (unsigned int i = 1; i <= 10; ++i)
            times.push_back({begin + i / 10. * stage->duration, stage->name});
        }
      return times;
    }

    /** Largest vector of a condition at a position over those times. Free components
     *  are 0. */
    Tensor<1, dim>
    largest_value(const BoundaryCondition   &condition,
                  const SidePart            &face,
                  const std::vector<Sample> &times)
    {
      const Point<dim>     x    = face.middle();
      const Tensor<1, dim> area = area_of(face);
      Tensor<1, dim>       largest;
      for (const auto &[t, stage] : times)
        {
          if (!condition.stages.include(stage))
            continue;
          const Tensor<1, dim> value =
            condition.vector_at(x, area / area.norm(), t);
          if (value.norm() > largest.norm())
            largest = value;
        }
      return largest;
    }

    /** Conditions with their faces and the largest value on each. */
    Json
    conditions_of(const BoundaryConditions  &conditions,
                  const ModelMesh           &mesh,
                  const std::vector<Sample> &times)
    {
      Json all = Json::array();
      for (const auto &condition : conditions.list)
        {
          Json faces = Json::array(), values = Json::array();
          for (const SidePart &face : mesh.faces_of(*condition))
            for (const SidePart &part : held_parts(face, *condition))
              {
                faces.push_back(json_of_places(part.corners));
                values.push_back(json(largest_value(*condition, part, times)));
              }
          Json prescribed = Json::array();
          for (const auto &component : condition->components)
            prescribed.push_back(component.has_value());
          all.push_back({{"name", condition->name},
                         {"prescribed", prescribed},
                         {"normal", condition->normal.has_value()},
                         {"stages", condition->stages.names()},
                         {"faces", faces},
                         {"values", values}});
        }
      return all;
    }

    /** Lattice points over the body selected by a function, for shapes given by
     *  formulas: rows along x; in three dimensions, layers of rows along z. */
    template <typename Selected>
    Json
    lattice_of(const Geometry &geometry, const Selected &selected)
    {
      constexpr unsigned int most = dim == 2 ? 240 : 48;
      const auto [low, high]      = geometry.bounding_box();
      const auto size             = high - low;
      double     largest          = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        largest = std::max(largest, size[d]);
      std::array<unsigned int, 3> n{{1, 1, 1}};
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = static_cast<unsigned int>(std::ceil(size[d] / largest * most));
      Json layers = Json::array();
      for (unsigned int k = 0; k < n[2]; ++k)
        {
          Json rows = Json::array();
          for (unsigned int j = 0; j < n[1]; ++j)
            {
              std::string row;
              for (unsigned int i = 0; i < n[0]; ++i)
                {
                  const std::array<unsigned int, 3> index{{i, j, k}};
                  Point<dim>                        x;
                  for (unsigned int d = 0; d < dim; ++d)
                    x[d] = low[d] + (index[d] + .5) * size[d] / n[d];
                  row += selected(x) ? '1' : '0';
                }
              rows.push_back(row);
            }
          layers.push_back(rows);
        }
      Json lattice = {{"low", json(low)}, {"high", json(high)}};
      if (dim == 2)
        lattice["rows"] = layers[0];
      else
        lattice["layers"] = layers;
      return lattice;
    }

    Json
    body_of(const Geometry &geometry)
    {
      Json body = {{"shape", geometry.shape.word()}};
      if (!geometry.outline.empty())
        {
          body["outline"] = json_of_places(geometry.outline);
          Json sides      = Json::object();
          if (dim == 2)
            for (const auto &[name, id] : geometry.sides)
              sides[name] = json_of_places(geometry.side_ends(id));
          body["sides"] = sides;
          Json holes    = Json::object();
          for (std::size_t i = 0; i < geometry.holes.size(); ++i)
            holes[geometry.hole_names[i]] = json_of_places(geometry.holes[i]);
          body["holes"] = holes;
        }
      // Outlines describe neither discs nor the region where a formula is positive.
      if (geometry.shape != Geometry::Shape::file &&
          (geometry.outline.empty() || geometry.is_part_by_formula()))
        body["lattice"] = lattice_of(
          geometry, [&](const Point<dim> &x) { return geometry.contains(x); });
      return body;
    }

    Json
    stages_of(const Scene &scene)
    {
      Json all = Json::array();
      for (const auto &stage : scene.loading.list)
        {
          Json one = {{"name", stage->name}, {"duration_s", stage->duration}};
          if (!stage->removed_polygon.empty())
            one["removed"] = json_of_places(stage->removed_polygon);
          else if (stage->removes() &&
                   scene.geometry.shape != Geometry::Shape::file)
            one["removed_lattice"] =
              lattice_of(scene.geometry, [&](const Point<dim> &x) {
                return scene.geometry.contains(x) && stage->removes(x);
              });
          if (!stage->added_materials.empty())
            one["added"] = stage->added_materials;
          if (!stage->changed_materials.empty())
            one["changed"] = stage->changed_materials;
          if (!stage->water_table.empty())
            one["water_table"] = json_of_places(stage->water_table);
          if (!stage->water_levels.empty())
            one["water_levels"] = stage->water_levels;
          if (stage->strength_factor > 0.)
            one["strength_factor"] = stage->strength_factor;
          if (stage->scales_loads())
            one["scaled_loads"] = stage->scaled_loads;
          all.push_back(one);
        }
      return all;
    }

    Json
    obstacles_of(const Scene      &scene,
                 const Point<dim> &centre,
                 const double      size)
    {
      Json all = Json::array();
      for (const auto &obstacle : scene.obstacles.list)
        {
          Json triangles = Json::array();
          for (const auto &triangle : obstacle->triangles({}, centre, size))
            triangles.push_back(json_of_places(triangle));
          all.push_back({{"name", obstacle->name}, {"triangles", triangles}});
        }
      return all;
    }

    Json
    structures_of(const Structures &structures)
    {
      Json all = Json::array();
      for (const auto &structure : structures.list)
        all.push_back({{"name", structure->name},
                       {"type", structure->kind()},
                       {"points", json_of_places(structure->points)},
                       {"stages", structure->stages.names()}});
      return all;
    }

    /** Whether a condition of particles acts on the sides of the body instead of the
     *  mesh. */
    bool
    is_on_body(const BoundaryCondition &condition)
    {
      return condition.moves_with_body() || condition.is_traction();
    }

    /** Sides of a box on which a condition acts. */
    std::vector<SidePart>
    sides_of(const std::array<Point<dim>, 2> &box,
             const BoundaryCondition         &condition)
    {
      std::vector<SidePart> sides;
      for (unsigned int d = 0; d < dim; ++d)
        for (const bool is_upper : {false, true})
          if (condition.is_on_side(side_of_box[d][is_upper]))
            {
              auto [low, high] = box;
              low[d] = high[d] = box[is_upper][d];
              sides.push_back(side_across(d, is_upper, low, high));
            }
      return sides;
    }
  } // namespace

  ModelMesh
  model_mesh_of(const BackgroundMesh &mesh,
                const Scene          &scene,
                const bool            of_particles)
  {
    ModelMesh   model;
    const auto &triangulation = mesh.triangulation();
    const auto  corners       = mesh.bounding_box().get_boundary_points();
    model.box                 = {{corners.first, corners.second}};
    std::vector<std::pair<unsigned int, Face>> own;
    // Vertices of quadrilaterals are in lexicographic order.
    const auto add = [&](const auto &part, const unsigned int material) {
      Face face = {part->vertex(0), part->vertex(1)};
      if (part->n_vertices() == 4)
        face.push_back(part->vertex(3));
      face.push_back(part->vertex(2));
      own.emplace_back(material, face);
    };
    if (triangulation.n_global_active_cells() <= most_cells_drawn ||
        scene.geometry.shape == Geometry::Shape::file)
      for (const auto &cell : mesh.own_cells())
        {
          if constexpr (dim == 2)
            add(cell, cell->material_id());
          else
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary())
                add(cell->face(f), cell->material_id());
        }
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(
           triangulation.get_communicator(), own))
      for (const auto &[material, face] : of_rank)
        {
          model.cells.push_back(face);
          if (!of_particles)
            model.materials.push_back(material);
        }
    model.faces_of = [&, of_particles](const BoundaryCondition &condition) {
      if (of_particles && is_on_body(condition))
        return segments_of_body(condition, scene.geometry);
      std::vector<SidePart> faces;
      for (const Face &face : mesh.faces_of(condition))
        faces.push_back({face});
      return faces;
    };
    return model;
  }

  ModelMesh
  model_mesh_of(const std::array<std::vector<double>, dim> &lines,
                const Scene                                &scene)
  {
    ModelMesh model;
    for (unsigned int d = 0; d < dim; ++d)
      {
        model.box[0][d] = lines[d].front();
        model.box[1][d] = lines[d].back();
      }
    const auto &x = lines[0], &y = lines[1];
    if (dim == 2 && x.size() * y.size() <= most_cells_drawn)
      for (std::size_t j = 1; j < y.size(); ++j)
        for (std::size_t i = 1; i < x.size(); ++i)
          {
            Point<dim> low, high;
            low[0]  = x[i - 1];
            low[1]  = y[j - 1];
            high[0] = x[i];
            high[1] = y[j];
            model.cells.push_back(outline_of_box(low, high));
          }
    model.faces_of = [box = model.box,
                      &scene](const BoundaryCondition &condition) {
      return is_on_body(condition) ? segments_of_body(condition, scene.geometry)
                                   : sides_of(box, condition);
    };
    return model;
  }

  Json
  model_of(const Scene &scene, const ModelMesh &mesh)
  {
    const std::vector<Sample> times = times_of(scene.loading);
    // For meshes from files the mesh is the body; for particles it is larger.
    auto [low, high] = mesh.box;
    if (scene.geometry.shape != Geometry::Shape::file)
      std::tie(low, high) = scene.geometry.bounding_box();
    Json materials = Json::array();
    for (unsigned int i = 0; i < scene.materials.size(); ++i)
      {
        Json material = {{"name", scene.materials.name(i)}};
        if (const Polygon region = scene.regions.polygon_of(i); !region.empty())
          material["region"] = json_of_places(region);
        materials.push_back(material);
      }
    Json surfaces = Json::array();
    const auto steps = scene.water.flow_steps();
    for (std::size_t i = 0; i < scene.water.flows().size(); ++i)
      {
        Json parts = Json::array();
        for (const auto &part : scene.water.flows()[i].surface)
          parts.push_back(json_of_places(part));
        surfaces.push_back({{"time_s", steps[i].time},
                            {dim == 2 ? "segments" : "triangles", parts}});
      }
    Json cells = Json::array();
    for (const Face &cell : mesh.cells)
      cells.push_back(json_of_places(cell));
    return {
      {"dimension", dim},
      {"low", json(low)},
      {"high", json(high)},
      {"body", body_of(scene.geometry)},
      {"materials", materials},
      {"cells", cells},
      {"material_of_cell", mesh.materials},
      {"supports", conditions_of(scene.dirichlet, mesh, times)},
      {"tractions", conditions_of(scene.tractions, mesh, times)},
      {"absorbing_boundaries", conditions_of(scene.absorbing, mesh, times)},
      {"obstacles",
       obstacles_of(scene, low + (high - low) / 2., (high - low).norm())},
      {"structures", structures_of(scene.structures)},
      {"observed_points", json_of_places(scene.observation.points)},
      {"gravity_m_per_s2", json(scene.gravity.at(times.back().t))},
      {"free_surfaces", surfaces},
      {"stages", stages_of(scene)}};
  }
} // namespace geocone::GEOCONE_DIM
