// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/msh_mesh.h>

#include <deal.II/base/mpi.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>

// Interface to gmsh. The library executes scripts passed to it, whatever their
// names: it receives numbers of ours only, and a file only if the parameter
// file declares it as a script to be run.

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    /** A gmsh session; gmsh keeps its model in global state. */
    class Session
    {
    public:
      Session()
      {
        // Ignores option files in the user's folders, and prevents gmsh's
        // toolkit from writing there.
        if (const char *home = std::getenv("HOME"))
          user_home = home;
        setenv("HOME", "/dev/null", 1);
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
      }
      ~Session()
      {
        try
          {
            gmsh::finalize();
          }
        catch (...)
          {
            // Nothing is left to be freed.
          }
        if (user_home)
          setenv("HOME", user_home->c_str(), 1);
        else
          unsetenv("HOME");
      }

    private:
      std::optional<std::string> user_home;
    };

    /**
     * Calls gmsh, whose errors are texts, numbers or exceptions.
     * @throws InputError instead
     */
    template <typename Function>
    auto
    with_gmsh(const std::string &fault,
              const std::string &remedy,
              const Function    &function)
    {
      std::string text;
      try
        {
          const Session session;
          return function();
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::exception &error)
        {
          text = error.what();
        }
      catch (const std::string &error)
        {
          text = error;
        }
      catch (const char *error)
        {
          text = error;
        }
      catch (const int error)
        {
          text = "error " + std::to_string(error);
        }
      catch (...)
        {
          text = "an error without a text";
        }
      throw InputError(fault + ": " + text + "\n  remedy:  " + remedy);
    }

    /**
     * Distributes the result of the first rank, or its InputError, to all
     * ranks. Collective.
     */
    template <typename Function>
    MshData
    from_first_rank(const MPI_Comm comm, const Function &function)
    {
      MshData data;
      on_first_rank(
        comm, "the mesh cannot be made", [&] { data = function(); });
      if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
        data = dealii::Utilities::MPI::broadcast(comm, data);
      return data;
    }

    std::vector<int>
    physical_groups(const int dimension, const int tag)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(dimension, tag, groups);
      return groups;
    }

    /**
     * Copies the present gmsh model. @p chosen: surfaces or volumes to copy,
     * all if empty.
     */
    MshData
    copy_model(const std::set<int> &chosen, const std::string &what)
    {
      MshData                  data;
      std::vector<std::size_t> node_tags;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(node_tags, coordinates, parametric);
      for (std::size_t i = 0; i < node_tags.size(); ++i)
        data.nodes.push_back({node_tags[i],
                              {{coordinates[3 * i],
                                coordinates[3 * i + 1],
                                coordinates[3 * i + 2]}}});

      for (const int dimension : {int(dim) - 1, int(dim)})
        {
          gmsh::vectorpair entities;
          gmsh::model::getEntities(entities, dimension);
          for (const auto &entity : entities)
            {
              if (dimension == int(dim) && !chosen.empty() &&
                  chosen.count(entity.second) == 0)
                continue;
              const std::vector<int> groups =
                physical_groups(dimension, entity.second);
              std::vector<int>                      types;
              std::vector<std::vector<std::size_t>> elements, nodes;
              gmsh::model::mesh::getElements(
                types, elements, nodes, dimension, entity.second);
              for (std::size_t t = 0; t < types.size(); ++t)
                {
                  check_element_type(types[t], what, "");
                  const unsigned int n = n_nodes_of_type(types[t]);
                  for (std::size_t e = 0; e < elements[t].size(); ++e)
                    {
                      MshData::Element element = {elements[t][e],
                                                  types[t],
                                                  entity.second,
                                                  data.index_of_groups(groups),
                                                  {}};
                      for (unsigned int i = 0; i < n; ++i)
                        element.nodes[i] = nodes[t][n * e + i];
                      (dimension == int(dim) ? data.cells : data.faces)
                        .push_back(element);
                    }
                }
              const bool is_face = dimension < int(dim);
              for (const int group : groups)
                {
                  std::string name;
                  gmsh::model::getPhysicalName(dimension, group, name);
                  if (is_face)
                    data.face_groups.insert(group);
                  if (!name.empty())
                    (is_face ? data.face_names : data.cell_names)[group] = name;
                }
            }
        }
      return data;
    }

    /** Runs a geo script, meshes its geometry, and copies the mesh. */
    MshData
    run_script(const std::string &file_name, const std::string &what)
    {
      return with_gmsh(what + " cannot be made by gmsh",
                       "open the script in gmsh to see what is wrong",
                       [&]() {
                         gmsh::open(file_name);
                         std::vector<int>                      types;
                         std::vector<std::vector<std::size_t>> elements, nodes;
                         gmsh::model::mesh::getElements(
                           types, elements, nodes, dim);
                         if (types.empty())
                           gmsh::model::mesh::generate(dim);
                         // Like gmsh when saving: if there are physical
                         // surfaces or volumes, these only.
                         std::set<int>    physical;
                         gmsh::vectorpair entities;
                         gmsh::model::getEntities(entities, dim);
                         for (const auto &entity : entities)
                           if (!physical_groups(dim, entity.second).empty())
                             physical.insert(entity.second);
                         return copy_model(physical, what);
                       });
    }

    /** Data of a .msh file, or of a script if scripts are allowed. */
    MshData
    data_of_file(const Geometry &geometry, const std::string &what)
    {
      const std::filesystem::path path(geometry.file);
      const std::string           text      = content_of_file(path, what);
      const bool                  is_script = geometry.is_script();
      if (begins_as_msh(text))
        return parse_msh(text, what);
      if (!is_script)
        throw InputError("Geometry/File",
                         path.filename().string(),
                         "a gmsh .msh file, which begins with $MeshFormat",
                         "this is something else: mesh the domain in gmsh and "
                         "save it as .msh, version 4.1 or 2.2");
      if (!geometry.may_run_script)
        throw InputError("Geometry/File",
                         path.filename().string(),
                         "a gmsh .msh file; a geo script is a program, which "
                         "can run commands and write files",
                         std::string("mesh it (gmsh -") + char('0' + dim) +
                           " NAME.geo) and give the .msh file; "
                           "or, if you trust the script, give the option "
                           "--run-gmsh-script");
      return run_script(geometry.file, what);
    }
  } // namespace

  CoarseMesh
  mesh_of_file(const Geometry &geometry,
               const Regions  &regions,
               const Contacts *contacts,
               const MPI_Comm  comm)
  {
    const std::string what =
      "the mesh '" + std::filesystem::path(geometry.file).filename().string() +
      "' of 'Geometry/File'";
    return coarse_mesh(
      from_first_rank(comm, [&]() { return data_of_file(geometry, what); }),
      what,
      regions,
      contacts);
  }

  namespace
  {
    namespace occ = gmsh::model::occ;

    void
    limit_sizes(const double smallest, const double largest)
    {
      gmsh::option::setNumber("Mesh.MeshSizeMin", smallest);
      gmsh::option::setNumber("Mesh.MeshSizeMax", largest);
    }

    /** Adds a gmsh field by a formula. */
    int
    add_formula(const std::string &formula)
    {
      const int field = gmsh::model::mesh::field::add("MathEval");
      gmsh::model::mesh::field::setString(field, "F", formula);
      return field;
    }

    /** Limits a field of sizes around fans, whose outer edges are not divided: between
     *  straight lines that decrease and grow with the distance from them.
     *  @return the limited field */
    int
    limit_around_fans(int field, const std::vector<Fan> &fans)
    {
      constexpr double growth = 0.3, smallest = 0.8;
      const auto       combine = [&](const char *type, const int by) {
        const int both = gmsh::model::mesh::field::add(type);
        gmsh::model::mesh::field::setNumbers(
          both, "FieldsList", {double(field), double(by)});
        field = both;
      };
      for (const Fan &fan : fans)
        {
          const double      chord = fan.chord();
          const std::string distance =
            format("(Sqrt((x-(%.17g))^2+(y-(%.17g))^2)-%.17g)",
                   fan.apex[0],
                   fan.apex[1],
                   fan.radius);
          combine("Min",
                  add_formula(format("%.17g+%g*", chord, growth) + distance));
          combine("Max",
                  add_formula(format("%.17g-%g*", smallest * chord, growth) +
                              distance));
        }
      return field;
    }

    /** Sets sizes as gmsh's background field, by a view of data. */
    void
    set_sizes(const CellSizes &sizes)
    {
      // x of the corners, then y, z and the values.
      std::vector<double> data;
      data.reserve(12 * sizes.triangles.size());
      double smallest = std::numeric_limits<double>::max(), largest = 0.;
      for (std::size_t i = 0; i < sizes.triangles.size(); ++i)
        {
          for (unsigned int d = 0; d < dim; ++d)
            for (const Point<dim> &x : sizes.triangles[i])
              data.push_back(x[d]);
          data.insert(data.end(), 3, 0.);
          for (const double size : sizes.sizes[i])
            {
              data.push_back(size);
              smallest = std::min(smallest, size);
              largest  = std::max(largest, size);
            }
        }
      const int view = gmsh::view::add("sizes");
      gmsh::view::addListData(view, "ST", sizes.triangles.size(), data);
      const int field = gmsh::model::mesh::field::add("PostView");
      gmsh::model::mesh::field::setNumber(field, "ViewIndex", 0);
      gmsh::model::mesh::field::setAsBackgroundMesh(
        limit_around_fans(field, sizes.fans));
      for (const Fan &fan : sizes.fans)
        smallest = std::min(smallest, fan.chord() / 2.);
      limit_sizes(smallest, largest);
    }

    /** Sets the cell size, or the sizes around the grading points
     *  (MeshParameters). */
    void
    set_sizes(const MeshParameters &parameters)
    {
      if (parameters.grading_points.empty())
        {
          // Cells are not larger than the domain.
          double extent = 0.;
          for (const Point<dim> &x : parameters.outline)
            extent = std::max(extent, x.distance(parameters.outline[0]));
          const double size = std::min(parameters.cell_size, extent);
          return limit_sizes(size, size);
        }
      // One field per point, by a formula: the options of gmsh's distance
      // fields have different names in different versions.
      std::vector<double> fields;
      for (const Point<dim> &x : parameters.grading_points)
        {
          const int field = add_formula(
            format("%.17g*Sqrt((x-(%.17g))^2+(y-(%.17g))^2+(z-(%.17g))^2)",
                   parameters.size_ratio,
                   x[0],
                   x[1],
                   dim == 3 ? x[dim - 1] : 0.));
          fields.push_back(field);
        }
      const int smallest = gmsh::model::mesh::field::add("Min");
      gmsh::model::mesh::field::setNumbers(smallest, "FieldsList", fields);
      gmsh::model::mesh::field::setAsBackgroundMesh(smallest);
      limit_sizes(parameters.smallest, parameters.largest);
    }

    /** Adds the loop of lines along a polygon. @return its tag */
    int
    add_loop(const Polygon &polygon)
    {
      std::vector<int> points, lines;
      for (const Point<dim> &x : polygon)
        points.push_back(occ::addPoint(x[0], x[1], 0.));
      for (std::size_t i = 0; i < points.size(); ++i)
        lines.push_back(
          occ::addLine(points[i], points[(i + 1) % points.size()]));
      return occ::addCurveLoop(lines);
    }

    /** Adds a plane surface, or in three dimensions a box. @return its tag */
    int
    add_body(const Polygon &polygon, const std::vector<Polygon> &holes = {})
    {
      if constexpr (dim == 3)
        {
          const Point<dim>            &a    = polygon[0];
          const dealii::Tensor<1, dim> size = polygon[1] - a;
          return occ::addBox(a[0], a[1], a[2], size[0], size[1], size[2]);
        }
      if (holes.empty())
        return occ::addPlaneSurface({add_loop(polygon)});
      // Loops of different orientations give the holes instead of the body.
      std::vector<Polygon> all = {polygon};
      all.insert(all.end(), holes.begin(), holes.end());
      std::vector<int> loops;
      for (Polygon &loop : all)
        {
          if (signed_area(loop) < 0.)
            std::reverse(loop.begin(), loop.end());
          loops.push_back(add_loop(loop));
        }
      return occ::addPlaneSurface(loops);
    }

    /** Adds the lines of fans, each one edge. */
    void
    add_fans(const std::vector<Fan> &fans, gmsh::vectorpair &tools)
    {
      for (const Fan &fan : fans)
        {
          const unsigned int n = fan.rays.size();
          std::vector<int>   inner(n,
                                 occ::addPoint(fan.apex[0], fan.apex[1], 0.));
          for (const double radius : fan.radii())
            {
              std::vector<int> outer(n);
              for (unsigned int i = 0; i < n; ++i)
                {
                  const Point<dim> x = fan.at(i, radius);
                  outer[i]           = occ::addPoint(x[0], x[1], 0.);
                  if (i > 0)
                    tools.emplace_back(1, occ::addLine(outer[i - 1], outer[i]));
                  if (i > 0 && i + 1 < n)
                    tools.emplace_back(1, occ::addLine(inner[i], outer[i]));
                }
              inner = outer;
            }
        }
    }

    /** Lets the pieces of fans be triangles, or two of them each. */
    void
    mesh_fans(const std::vector<Fan> &fans)
    {
      const auto is_in_fan = [&](const int tag) {
        gmsh::vectorpair ends;
        gmsh::model::getBoundary({{1, tag}}, ends, false, false);
        return std::any_of(fans.begin(), fans.end(), [&](const Fan &fan) {
          return std::all_of(ends.begin(), ends.end(), [&](const auto &end) {
            std::vector<double> x;
            gmsh::model::getValue(0, end.second, {}, x);
            return std::hypot(x[0] - fan.apex[0], x[1] - fan.apex[1]) <
                   1.001 * fan.radius;
          });
        });
      };
      gmsh::vectorpair curves, surfaces;
      std::set<int>    inside;
      gmsh::model::getEntities(curves, 1);
      for (const auto &curve : curves)
        if (is_in_fan(curve.second))
          {
            inside.insert(curve.second);
            gmsh::model::mesh::setTransfiniteCurve(curve.second, 2);
          }
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &surface : surfaces)
        {
          gmsh::vectorpair sides;
          gmsh::model::getBoundary({surface}, sides, false, false);
          if (sides.size() <= 4 &&
              std::all_of(sides.begin(), sides.end(), [&](const auto &side) {
                return inside.count(side.second) > 0;
              }))
            gmsh::model::mesh::setTransfiniteSurface(surface.second);
        }
    }

    /** Adds the domain, fragmented by the boundaries of the body and the
     *  materials, by lines (their parts inside), by fans and by the grading
     *  points, which become edges and vertices of the mesh. @return the tags of
     *  its pieces */
    std::set<int>
    add_domain(const MeshDomain       &of,
               const Regions          &regions,
               const MeshLines        &lines,
               const std::vector<Fan> &fans)
    {
      const gmsh::vectorpair domain = {
        {int(dim), add_body(of.outline, of.holes)}};
      gmsh::vectorpair       tools;
      for (const Polygon &polygon : of.inner)
        tools.emplace_back(dim, add_body(polygon));
      for (const Polygon &polygon : regions.polygons())
        tools.emplace_back(dim, add_body(polygon));
      for (const auto &line : lines)
        {
          const int tag =
            occ::addLine(occ::addPoint(line[0][0], line[0][1], 0.),
                         occ::addPoint(line[1][0], line[1][1], 0.));
          gmsh::vectorpair              inside;
          std::vector<gmsh::vectorpair> from;
          occ::intersect({{1, tag}}, domain, inside, from, -1, true, false);
          for (const auto &part : inside)
            if (part.first == 1)
              tools.push_back(part);
        }
      for (const Point<dim> &x : of.vertices)
        tools.emplace_back(
          0, occ::addPoint(x[0], x[1], dim == 3 ? x[dim - 1] : 0.));
      add_fans(fans, tools);
      gmsh::vectorpair              pieces = domain;
      std::vector<gmsh::vectorpair> origin = {domain};
      if (!tools.empty())
        occ::fragment(domain, tools, pieces, origin);
      occ::synchronize();
      std::set<int> tags;
      for (const auto &piece : origin[0])
        tags.insert(piece.second);
      return tags;
    }

    /** Meshes the domain by gmsh, from numbers only. @param set_sizes of the cells */
    template <typename Function>
    MshData
    mesh_domain(const MeshDomain       &domain,
                const Regions          &regions,
                const MeshLines        &lines,
                const std::vector<Fan> &fans,
                const Function         &set_sizes,
                const std::string      &what)
    {
      gmsh::model::add("domain");
      const std::set<int> pieces = add_domain(domain, regions, lines, fans);
      set_sizes();
      if (!fans.empty())
        mesh_fans(fans);
      gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
      gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
      gmsh::option::setNumber("Mesh.Algorithm", domain.algorithm);
      if (domain.quadrilaterals)
        {
          gmsh::option::setNumber("Mesh.RecombineAll", 1);
          // Recombined triangles, then each cell split into four (or three):
          // only quadrilaterals remain.
          gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1);
          gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 1);
        }
      gmsh::model::mesh::generate(dim);
      return copy_model(pieces, what);
    }

    template <typename Function>
    CoarseMesh
    mesh_by_gmsh(const MeshDomain       &domain,
                 const Regions          &regions,
                 const MeshLines        &lines,
                 const std::vector<Fan> &fans,
                 const Function         &set_sizes,
                 const MPI_Comm          comm)
    {
      const std::string what = "the mesh that gmsh has made";
      const auto        mesh = [&]() {
        return with_gmsh("gmsh cannot mesh the domain",
                         "change 'Mesh/Smallest size', 'Mesh/Size ratio' or "
                                "'Mesh/Gmsh algorithm'",
                         [&]() {
                           return mesh_domain(
                             domain, regions, lines, fans, set_sizes, what);
                         });
      };
      return coarse_mesh(from_first_rank(comm, mesh), what, regions);
    }
  } // namespace

  MeshDomain
  domain_of(const MeshParameters &parameters)
  {
    return {parameters.outline,
            parameters.holes,
            parameters.inner,
            parameters.grading_points,
            parameters.algorithm,
            parameters.cells == MeshParameters::Cells::quadrilaterals};
  }

  CoarseMesh
  unstructured_mesh(const MeshParameters &parameters,
                    const Regions        &regions,
                    const MeshLines      &lines,
                    const MPI_Comm        comm)
  {
    return mesh_by_gmsh(
      domain_of(parameters),
      regions,
      lines,
      {},
      [&]() { set_sizes(parameters); },
      comm);
  }

  CoarseMesh
  mesh_with_sizes(const MeshDomain &domain,
                  const Regions    &regions,
                  const MeshLines  &lines,
                  const CellSizes  &sizes,
                  const MPI_Comm    comm)
  {
    return mesh_by_gmsh(
      domain, regions, lines, sizes.fans, [&]() { set_sizes(sizes); }, comm);
  }
} // namespace geocone::GEOCONE_DIM
