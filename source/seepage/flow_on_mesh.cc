// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/functions/simplex_field.h>
#include <geocone/mesh/adapted_sizes.h>
#include <geocone/mesh/bisection.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/seepage/flow_on_mesh.h>
#include <geocone/shapes/part_in_box.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int number_of_levels = 4;

    /** Vertices of the mesh at the ends of the boxes of boundaries. */
    std::vector<Point<dim>>
    ends_of_boxes(const Scene &scene)
    {
      std::vector<Point<dim>> ends;
      const Geometry         &geometry = scene.geometry;
      for (const auto &boundary : scene.water.seepage.list)
        if (boundary->box_corners())
          for (unsigned int side = 0; side < geometry.sides.size(); ++side)
            {
              const auto [a, b]  = geometry.side_ends(side);
              const auto   part  = part_in_box(*boundary->wide_box(), a, b);
              const double least = 1e-6 * a.distance(b);
              if (part && (*part)[0].distance((*part)[1]) > least)
                for (const Point<dim> &end : *part)
                  if (end.distance(a) > least && end.distance(b) > least)
                    ends.push_back(end);
            }
      return ends;
    }

    /** Equal sizes in the bounding box of a geometry. */
    CellSizes
    equal_sizes(const Geometry &geometry, const double n_cells)
    {
      CellSizes sizes;
      if (geometry.shape == Geometry::Shape::file)
        return sizes;
      const auto [low, high]      = geometry.bounding_box();
      const Tensor<1, dim> margin = 0.1 * (high - low);
      const Point<dim>     a = low - margin, c = high + margin;
      const double         size =
        std::sqrt(4. / std::sqrt(3.) * geometry.area() / n_cells);
      for (const Point<dim> &corner :
           {Point<dim>(c[0], a[1]), Point<dim>(a[0], c[1])})
        {
          sizes.triangles.push_back({{a, corner, c}});
          sizes.sizes.push_back({{size, size, size}});
        }
      return sizes;
    }

    /** Permeability of each material, after a check of what else the flow needs of it. */
    std::vector<dealii::SymmetricTensor<2, dim>>
    permeability_of_materials(const Scene &scene)
    {
      std::vector<dealii::SymmetricTensor<2, dim>> all;
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        {
          const ConstitutiveLaw &law = scene.materials.law(m);
          all.push_back(law.permeability());
          if (scene.water.flows_in_time() && !law.retention().acts())
            law.drainable_porosity();
        }
      return all;
    }

    /** Retention curve of each material; empty: none has any.
     *  @throws InputError if only some have */
    std::vector<const Retention *>
    curves_of_materials(const Scene &scene)
    {
      std::vector<const Retention *> all;
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        if (scene.materials.law(m).retention().acts())
          all.push_back(&scene.materials.law(m).retention());
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        if (!all.empty() && !scene.materials.law(m).retention().acts())
          throw InputError("Materials/" + scene.materials.name(m) +
                             "/Retention",
                           "none",
                           "a curve, as other materials have one",
                           "give all materials a curve, or none");
      return all;
    }

    unsigned int
    number_of_plane_levels(const Scene &scene, const bool is_transient)
    {
      // The free surface moves through the whole mesh of a transient flow.
      return scene.geometry.shape == Geometry::Shape::file || is_transient
               ? 1
               : number_of_levels;
    }

    /** Triangles with given cell sizes, with edges along the drains. Collective. */
    CoarseMesh
    mesh_with(const Scene &scene, const CellSizes &sizes, const MPI_Comm comm)
    {
      MeshLines drains;
      for (const auto &boundary : scene.water.seepage.list)
        for (std::size_t i = 1; i < boundary->drain.size(); ++i)
          drains.push_back({{boundary->drain[i - 1], boundary->drain[i]}});
      return triangles_of_body(
        scene, ends_of_boxes(scene), drains, sizes, comm);
    }

    /** Mesh of equal triangles, or that of the scene in three dimensions.
     *  Collective. */
    FlowMesh
    first_mesh_of(const Scene          &scene,
                  const bool            is_transient,
                  const MPI_Comm        comm,
                  const MeshParameters *parameters)
    {
      if (dim == 3)
        return FlowMesh(fitted_mesh(*parameters, scene, comm, nullptr, false));
      const unsigned int n_levels = number_of_plane_levels(scene, is_transient);
      return FlowMesh(mesh_with(
        scene,
        equal_sizes(scene.geometry,
                    scene.water.seepage.n_cells / std::pow(2., n_levels - 1)),
        comm));
    }

    /** Finer mesh with small cells where the error is large. Collective.
     *  @tparam Mesh a template, as triangles are created anew and tetrahedra are bisected */
    template <typename Mesh>
    CoarseMesh
    refined(const Scene               &scene,
            const Mesh                &mesh,
            const std::vector<double> &error,
            const std::size_t          n_cells,
            const MPI_Comm             comm)
    {
      if constexpr (dim == 2)
        return mesh_with(scene, adapted_sizes(mesh, error, n_cells), comm);
      else
        return bisected(mesh, error, n_cells);
    }
  } // namespace

  FlowOnMesh::FlowOnMesh(const Scene          &scene,
                         const MPI_Comm        comm,
                         const MeshParameters *parameters)
    : scene(scene)
    , comm(comm)
    , is_transient(scene.water.flows_in_time())
    , permeability(permeability_of_materials(scene))
    , curves(curves_of_materials(scene))
    , first_mesh(first_mesh_of(scene, is_transient, comm, parameters))
    , mesh(first_mesh)
  {
    take(first_mesh);
    check_unsaturated();
    for (const Seepage::Step &step : scene.water.flow_steps())
      boundaries->check(step.levels);
  }

  unsigned int
  FlowOnMesh::n_levels() const
  {
    if (dim == 2)
      return number_of_plane_levels(scene, is_transient);
    if (is_transient)
      return 1;
    // Each mesh has at most twice as many cells as the last one.
    const double ratio =
      double(scene.water.seepage.n_cells) / first_mesh.cells.size();
    return 1 + std::max(std::ceil(std::log2(ratio) - 1e-9), 0.);
  }

  void
  FlowOnMesh::take(const FlowMesh &next)
  {
    mesh = next;
    confined.reset();
    boundaries.emplace(scene, mesh);
    measure.clear();
    drainable.assign(mesh.vertices.size(), 0.);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        measure.push_back(
          Geometry::measure(scene.geometry.symmetry, mesh.centre(c)));
        if (is_transient && !is_unsaturated())
          for (const unsigned int v : mesh.cells[c])
            drainable[v] +=
              scene.materials.law(mesh.material[c]).drainable_porosity() *
              mesh.cell_size(c) / FlowMesh::n_corners * measure[c];
      }
  }

  void
  FlowOnMesh::solve(const Seepage::Step         &step,
                    const std::function<void()> &after_mesh)
  {
    if (const auto next = boundaries->largest_jump(step.levels);
        next.flow > jump.flow)
      jump = next;
    if (step.duration > 0.)
      {
        stop_if_asked(comm);
        if (is_unsaturated())
          advance_unsaturated(step);
        else
          advance(step);
        return after_mesh();
      }
    levels_now = step.levels;
    if (scene.water.seepage.initial_table && !is_solved())
      {
        begin_at_rest(*scene.water.seepage.initial_table);
        return after_mesh();
      }
    for (unsigned int level = 0; level < n_levels(); ++level)
      {
        stop_if_asked(comm);
        if (level == 0)
          solve_on_first_mesh(step);
        else
          refine(step);
        after_mesh();
      }
  }

  void
  FlowOnMesh::solve_on_first_mesh(const Seepage::Step &step)
  {
    if (is_solved())
      take(first_mesh);
    discharge_before.reset();
    rate_of_storage = 0.;
    solve_on_mesh(boundaries->conditions(step.levels, step.time, 0.),
                  boundaries->hydrostatic(step.levels, is_unsaturated()));
    if (scene.water.seepage.degree > 1)
      solve_confined(step.levels);
  }

  void
  FlowOnMesh::refine(const Seepage::Step &step)
  {
    const FlowMesh     next(refined<FlowMesh::Simplices>(
      scene, mesh, jumps(), 2 * mesh.cells.size(), comm));
    const SimplexField last(mesh.vertices, mesh.cells, solution.s);
    discharge_before = discharge();
    take(next);
    std::vector<double> start;
    for (const Point<dim> &x : mesh.vertices)
      start.push_back(last.value(x));
    solve_on_mesh(boundaries->conditions(step.levels, step.time, 0.),
                  std::move(start));
    if (scene.water.seepage.degree > 1)
      solve_confined(step.levels);
  }

  void
  FlowOnMesh::solve_confined(const Seepage::Levels &levels)
  {
    const unsigned int degree       = scene.water.seepage.degree;
    constexpr double   rounding     = 1e-6;
    const auto         refuse_below = [&](const std::vector<double> &values,
                                  const double               least) {
      if (*std::min_element(values.begin(), values.end()) < least)
        throw InputError("Seepage/Degree",
                         degree,
                         "1 where the flow has a free surface",
                         "set it to 1, with more 'Seepage/Cells'");
    };
    refuse_below(solution.s, -rounding);
    confined.emplace(mesh, degree);
    const auto &nodes = confined->nodes();
    const auto &list  = scene.water.seepage.list;
    for (const auto &boundary : list)
      if (dim == 3 && !boundary->drain.empty())
        throw InputError("Seepage/Degree",
                         degree,
                         "1 with drains in three dimensions",
                         "let the water leave at sides");
    boundary_of_node.assign(nodes.size(), -1);
    for (const auto &group : boundaries->groups())
      for (const unsigned int node : confined->nodes_on(group.facets))
        boundary_of_node[node] = group.boundary;
    std::vector<std::optional<double>> prescribed(nodes.size());
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (boundary_of_node[i] >= 0)
        prescribed[i] = std::max(
          levels[boundary_of_node[i]].value_or(nodes[i][1]) - nodes[i][1], 0.);
    confined->solve(permeability, scene.geometry.symmetry, prescribed);
    const dealii::BoundingBox<dim> body(mesh.vertices);
    refuse_below(confined->head, -rounding * body.side_length(1));
    std::copy_n(
      confined->head.begin(), mesh.vertices.size(), solution.head.begin());
    solution.error = confined->error;
  }

  void
  FlowOnMesh::solve_on_mesh(const FlowConditions &conditions,
                            std::vector<double>   start)
  {
    steps_taken   = 0;
    largest_error = 0.;
    step_size     = 0.;
    if (is_unsaturated())
      solution = UnsaturatedFlow(mesh, permeability, measure, curves)
                   .steady(conditions, std::move(start));
    else
      solution =
        solve_flow(mesh, permeability, measure, conditions, std::move(start));
  }

  void
  FlowOnMesh::check_unsaturated() const
  {
    const Seepage &seepage = scene.water.seepage;
    if (seepage.degree > 1 && (is_unsaturated() || is_transient))
      throw InputError("Seepage/Degree",
                       seepage.degree,
                       "1 in transient flow and in unsaturated soil",
                       "take more 'Seepage/Cells'");
    if (seepage.initial_table && !(is_unsaturated() && is_transient))
      throw InputError("Seepage/Initial water table",
                       *seepage.initial_table,
                       "steady where no flow is transient in unsaturated soil",
                       "set 'Loading/STAGE/Flow steps' and "
                       "'Materials/NAME/Retention', or leave it out");
    const bool is_wet =
      std::any_of(seepage.list.begin(), seepage.list.end(), [](const auto &b) {
        return b->level || b->rain(0.) > 0.;
      });
    if (is_unsaturated() && !seepage.initial_table && !is_wet)
      throw InputError("Seepage/Initial water table",
                       "steady",
                       "a height y where no boundary has a level and it does "
                       "not rain at t = 0",
                       "dry soil has no steady flow: give the height of a "
                       "water table, which may lie below the body");
  }

  std::vector<Tensor<1, dim>>
  FlowOnMesh::velocities() const
  {
    std::vector<Tensor<1, dim>> q;
    if (confined)
      {
        LagrangeSimplex::Barycentric centre;
        centre.fill(1. / FlowMesh::n_corners);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          q.push_back(
            confined->velocity(c, centre, permeability[mesh.material[c]]));
        return q;
      }
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      q.push_back(
        is_unsaturated()
          ? unsaturated_velocity(mesh, permeability, curve(c), solution.head, c)
          : darcy_velocity(mesh, permeability, solution, c));
    return q;
  }

  std::vector<Tensor<1, dim>>
  FlowOnMesh::velocities_at_corners() const
  {
    const auto                  of_cell = velocities();
    std::vector<Tensor<1, dim>> q;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
        {
          LagrangeSimplex::Barycentric corner = {};
          corner[i]                           = 1.;
          q.push_back(confined ? confined->velocity(
                                   c, corner, permeability[mesh.material[c]])
                               : of_cell[c]);
        }
    return q;
  }

  std::vector<double>
  FlowOnMesh::jumps() const
  {
    const auto          q = velocities();
    std::vector<double> jump(mesh.facet_vertices.size(), 0.);
    std::vector<double> stiffness(jump.size(), 0.);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const auto g = mesh.gradients(c);
        for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
          {
            const unsigned int f = mesh.facets_by_cell[c][i];
            jump[f] += q[c] * g[i] / g[i].norm();
            stiffness[f] += trace(permeability[mesh.material[c]]);
          }
      }
    // Size of a facet times that of the cell across it.
    const auto weight = [&](const unsigned int f) {
      const double size = mesh.facet_size(f);
      return dim == 2 ? size * size : size * std::sqrt(size);
    };
    std::vector<double> error(mesh.cells.size(), 0.);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (const unsigned int f : mesh.facets_by_cell[c])
        if (boundaries->of_facet[f] < 0)
          error[c] += weight(f) * jump[f] * jump[f] / stiffness[f];
    return error;
  }

  Water::Flow
  FlowOnMesh::result() const
  {
    std::vector<double> pressure = confined ? confined->head : solution.head,
                        size(mesh.vertices.size(), 0.);
    for (double &u : pressure)
      u *= scene.water.weight();
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (const unsigned int v : mesh.cells[c])
        size[v] = std::max(size[v],
                           dim == 2 ? std::sqrt(mesh.cell_size(c))
                                    : std::cbrt(6. * mesh.cell_size(c)));
    // Height above the free surface of unsaturated vertices: half a cell.
    const auto depth = [&](const unsigned int v) {
      return solution.head[v] > 0. || is_unsaturated()
               ? solution.head[v]
               : (solution.saturation[v] - 1.) / 2. * size[v];
    };
    std::vector<std::array<Point<dim>, dim>> surface;
    for (const auto &cell : mesh.cells)
      {
        std::vector<unsigned int> wet, dry;
        for (const unsigned int v : cell)
          (depth(v) > 0. ? wet : dry).push_back(v);
        // Neighbours in the list are on a facet.
        std::vector<Point<dim>> corners;
        for (unsigned int i = 0; i < wet.size(); ++i)
          for (unsigned int j = 0; j < dry.size(); ++j)
            {
              const unsigned int a = wet[i],
                                 b = dry[i % 2 == 0 ? j : dry.size() - 1 - j];
              corners.push_back(mesh.vertices[a] +
                                depth(a) / (depth(a) - depth(b)) *
                                  (mesh.vertices[b] - mesh.vertices[a]));
            }
        for (std::size_t i = 0; i + 1 < corners.size(); i += 2)
          {
            surface.emplace_back();
            for (unsigned int k = 0; k < dim; ++k)
              surface.back()[k] = corners[(i + k) % corners.size()];
          }
      }
    return {confined ? SimplexField(mesh.vertices,
                                    mesh.cells,
                                    confined->degree(),
                                    confined->nodes_of_cells(),
                                    pressure)
                     : SimplexField(mesh.vertices, mesh.cells, pressure),
            surface,
            is_unsaturated()};
  }

  std::vector<double>
  FlowOnMesh::inflows() const
  {
    std::vector<double> all(scene.water.seepage.list.size(), 0.);
    if (confined)
      {
        for (unsigned int i = 0; i < boundary_of_node.size(); ++i)
          if (boundary_of_node[i] >= 0)
            all[boundary_of_node[i]] += confined->inflow[i];
        return all;
      }
    const std::vector<int> &boundary_of = boundaries->of_vertex;
    for (unsigned int v = 0; is_solved() && v < boundary_of.size(); ++v)
      if (boundary_of[v] >= 0)
        all[boundary_of[v]] += solution.inflow[v];
    return all;
  }

  double
  FlowOnMesh::discharge() const
  {
    double into = 0., out = 0.;
    for (const double inflow : inflows())
      (inflow > 0. ? into : out) += std::abs(inflow);
    return std::max(into, out);
  }

  std::optional<double>
  FlowOnMesh::change() const
  {
    if (!discharge_before || !flows())
      return std::nullopt;
    return discharge() / *discharge_before - 1.;
  }

  double
  FlowOnMesh::imbalance() const
  {
    if (steps_taken > 0)
      return largest_error;
    double sum = -rate_of_storage;
    for (const double inflow : inflows())
      sum += inflow;
    return flows() ? sum / discharge() : 0.;
  }

  bool
  FlowOnMesh::flows() const
  {
    const dealii::BoundingBox<dim> body(mesh.vertices);
    double                         largest = 0.;
    for (const auto &k : permeability)
      largest = std::max(largest, trace(k));
    const double width = dim == 2 ? 1. : body.side_length(0);
    return discharge() > 1e-14 * largest * body.side_length(1) * width;
  }

  std::string
  FlowOnMesh::text() const
  {
    const auto change = this->change();
    return format("%.5g ", discharge()) + scene.geometry.unit("m^3/s/m") +
           " through the body" +
           (change ? format(" (%+.2g %% from the mesh before)", 100. * *change)
                   : "") +
           format(", %u iterations", solution.iterations);
  }

  std::vector<std::string>
  FlowOnMesh::warnings() const
  {
    constexpr double               least_growth = 0.01, largest_change = 0.03;
    const dealii::BoundingBox<dim> body(mesh.vertices);
    std::vector<std::string>       all;
    // Of cells of half the size.
    const double growth = std::log(2.) / dealii::numbers::PI * jump.flow *
                          (dim == 2 ? 1. : body.side_length(0));
    if (growth > least_growth * discharge())
      all.push_back(
        format("the heads of 'Seepage/%s' and 'Seepage/%s' differ by %.3g m "
               "where they meet, at (",
               scene.water.seepage.names()[jump.higher].c_str(),
               scene.water.seepage.names()[jump.lower].c_str(),
               jump.size) +
        dealii::Patterns::Tools::to_string(jump.at) +
        format("): the discharge there is infinite, and the computed one grows "
               "by %.2g ",
               growth) +
        scene.geometry.unit("m^3/s/m") +
        " as often as the cells there are halved; leave an impervious part "
        "between them");
    const auto change = this->change();
    if (change && std::abs(*change) > largest_change)
      all.push_back(format("the discharge changed by %+.2g %% on the last mesh "
                           "of the flow, of %zu cells; raise 'Seepage/Cells'",
                           100. * *change,
                           mesh.cells.size()));
    return all;
  }

  void
  let_water_flow(Scene                &scene,
                 const MPI_Comm        comm,
                 Log                  &log,
                 const bool            dry_run,
                 const double          time,
                 const MeshParameters *parameters)
  {
    if (!scene.water.seepage.acts())
      return;
    const auto               steps = scene.water.flow_steps();
    FlowOnMesh               flow(scene, comm, parameters);
    std::vector<Water::Flow> flows;
    if (dry_run) // the first flow on the first mesh stands for all
      {
        flow.solve_on_first_mesh(steps.front());
        flows.assign(steps.size(), flow.result());
      }
    else
      for (const Seepage::Step &step : steps)
        {
          dealii::Timer timer;
          flow.solve(step);
          if (step.duration == 0.)
            log.print(format("seepage: %zu %s, ",
                             flow.current_mesh().cells.size(),
                             dim == 2 ? "triangles" : "tetrahedra") +
                      flow.text() + format("; %.2g s", timer.cpu_time()));
          flows.push_back(flow.result());
        }
    for (const std::string &warning : flow.warnings())
      log.warn(warning);
    scene.water.set_flows(std::move(flows), time);
  }
} // namespace geocone::GEOCONE_DIM
