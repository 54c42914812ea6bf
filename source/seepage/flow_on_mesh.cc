// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/mesh/adapted_sizes.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/seepage/flow_on_mesh.h>

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
      const Polygon          &outline = scene.geometry.outline;
      for (const auto &boundary : scene.water.seepage.list)
        if (const auto corners = boundary->box_corners())
          for (std::size_t i = 0; i < outline.size(); ++i)
            {
              const Point<dim> &a   = outline[i],
                               &b   = outline[(i + 1) % outline.size()];
              const auto [from, to] = interval_in_box(*corners, a, b);
              for (const double at : {from, to})
                if (from < to && at > 1e-6 && at < 1. - 1e-6)
                  ends.push_back(a + at * (b - a));
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
  } // namespace

  FlowOnMesh::FlowOnMesh(const Scene           &scene,
                         const Seepage::Levels &levels,
                         const MPI_Comm         comm)
    : scene(scene)
    , levels(levels)
    , comm(comm)
    , is_transient(scene.water.flows_in_time())
  {
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        permeability.push_back(scene.materials.law(m).permeability());
        if (is_transient)
          scene.materials.law(m).drainable_porosity();
      }
  }

  unsigned int
  FlowOnMesh::n_levels() const
  {
    // The free surface moves through the whole mesh of a transient flow.
    return scene.geometry.shape == Geometry::Shape::file || is_transient
             ? 1
             : number_of_levels;
  }

  void
  FlowOnMesh::refine()
  {
    std::optional<TriangleField> last;
    if (!mesh)
      sizes =
        equal_sizes(scene.geometry,
                    scene.water.seepage.n_cells / std::pow(2., n_levels() - 1));
    else
      {
        sizes = adapted_sizes(*mesh, jumps(), 2. * mesh->cells.size());
        last.emplace(mesh->vertices, mesh->cells, steady.s);
        discharge_before = discharge();
      }
    MeshLines drains;
    for (const auto &boundary : scene.water.seepage.list)
      for (std::size_t i = 1; i < boundary->drain.size(); ++i)
        drains.push_back({{boundary->drain[i - 1], boundary->drain[i]}});
    mesh.emplace(
      triangles_of_body(scene, ends_of_boxes(scene), drains, sizes, comm));
    solve(conditions(), start(mesh->vertices, last));
  }

  void
  FlowOnMesh::solve(const FlowConditions &conditions, std::vector<double> start)
  {
    std::vector<double> measure;
    for (unsigned int c = 0; c < mesh->cells.size(); ++c)
      measure.push_back(
        Geometry::measure(scene.geometry.symmetry, mesh->centre(c)));
    steady =
      solve_flow(*mesh, permeability, measure, conditions, std::move(start));
  }

  void
  FlowOnMesh::advance(const Seepage::Step &step)
  {
    levels                 = step.levels;
    const double   before  = stored();
    FlowConditions next    = conditions();
    next.storage           = drainable();
    next.saturation_before = saturation();
    for (double &volume : next.storage)
      volume /= step.duration;
    discharge_before.reset();
    solve(next, steady.s);
    rate_of_storage = (stored() - before) / step.duration;
  }

  std::vector<double>
  FlowOnMesh::saturation() const
  {
    std::vector<double> chi = steady.s;
    for (double &value : chi)
      value = 1. + std::min(value, 0.);
    return chi;
  }

  std::vector<double>
  FlowOnMesh::drainable() const
  {
    std::vector<double> volume(mesh->vertices.size(), 0.);
    for (unsigned int c = 0; c < mesh->cells.size(); ++c)
      for (const unsigned int v : mesh->cells[c])
        volume[v] +=
          scene.materials.law(mesh->material[c]).drainable_porosity() *
          mesh->area(c) / 3. *
          Geometry::measure(scene.geometry.symmetry, mesh->centre(c));
    return volume;
  }

  double
  FlowOnMesh::stored() const
  {
    const std::vector<double> volume = drainable(), chi = saturation();
    double                    sum = 0.;
    for (unsigned int v = 0; v < volume.size(); ++v)
      sum += volume[v] * chi[v];
    return sum;
  }

  std::vector<unsigned int>
  FlowOnMesh::edges_of(const SeepageBoundary &boundary) const
  {
    std::vector<unsigned int> all;
    if (boundary.drain.empty())
      {
        for (const auto &held : mesh->held_edges(boundary))
          all.push_back(held.edge);
        return all;
      }
    for (unsigned int e = 0; e < mesh->edges.size(); ++e)
      {
        const auto &[a, b] = mesh->edges[e].vertices;
        if (boundary.is_on_drain(mesh->vertices[a]) &&
            boundary.is_on_drain(mesh->vertices[b]))
          all.push_back(e);
      }
    if (all.empty())
      throw InputError(boundary.parameter("Drain"),
                       dealii::Patterns::Tools::to_string(boundary.drain),
                       "a line in the body",
                       "choose points inside of it; in a mesh of a file drains "
                       "follow edges of cells");
    return all;
  }

  void
  FlowOnMesh::check(const Seepage::Levels &levels) const
  {
    for (unsigned int b = 0; b < levels.size(); ++b)
      if (levels[b])
        {
          const SeepageBoundary &boundary = *scene.water.seepage.list[b];
          double                 lowest   = std::numeric_limits<double>::max();
          for (const unsigned int e : edges_of(boundary))
            for (const unsigned int v : mesh->edges[e].vertices)
              lowest = std::min(lowest, mesh->vertices[v][1]);
          if (!(*levels[b] > lowest))
            throw InputError(boundary.parameter("Level"),
                             *levels[b],
                             format("above the lowest point of its sides, y = "
                                    "%g m",
                                    lowest),
                             "a side in the air has no level: none");
        }
  }

  FlowConditions
  FlowOnMesh::conditions()
  {
    using Kind                = FlowConditions::Kind;
    const unsigned int n      = mesh->vertices.size();
    const auto        &listed = scene.water.seepage.list;
    boundary_of.assign(n, -1);
    boundary_of_edge.assign(mesh->edges.size(), -1);
    for (unsigned int b = 0; b < listed.size(); ++b)
      for (const unsigned int e : edges_of(*listed[b]))
        {
          boundary_of_edge[e] = b;
          for (const unsigned int v : mesh->edges[e].vertices)
            boundary_of[v] = b;
        }
    check(levels);
    FlowConditions all;
    all.kind.assign(n, Kind::none);
    all.head.assign(n, 0.);
    all.rain.assign(n, 0.);
    for (unsigned int v = 0; v < n; ++v)
      if (boundary_of[v] >= 0)
        {
          const auto &level = levels[boundary_of[v]];
          all.kind[v]       = Kind::seepage_face;
          if (level)
            all.head[v] = *level - mesh->vertices[v][1];
          if (all.head[v] > 1e-9 * (1. + std::abs(mesh->vertices[v][1])))
            all.kind[v] = Kind::head;
        }
    for (unsigned int e = 0; e < mesh->edges.size(); ++e)
      if (boundary_of_edge[e] >= 0)
        {
          const auto       &ends = mesh->edges[e].vertices;
          const Point<dim> &a    = mesh->vertices[ends[0]],
                           &b    = mesh->vertices[ends[1]];
          const double flow =
            listed[boundary_of_edge[e]]->rain * std::abs(b[0] - a[0]) *
            Geometry::measure(scene.geometry.symmetry, a + 0.5 * (b - a));
          for (const unsigned int v : ends)
            all.rain[v] += flow / 2.;
        }
    return all;
  }

  std::vector<double>
  FlowOnMesh::start(const std::vector<Point<dim>>      &vertices,
                    const std::optional<TriangleField> &last) const
  {
    double highest = std::numeric_limits<double>::lowest();
    for (const auto &level : levels)
      highest = std::max(highest, level.value_or(highest));
    std::vector<double> s;
    for (const Point<dim> &x : vertices)
      s.push_back(last ? last->value(x) : std::max(highest - x[1], -0.5));
    return s;
  }

  std::vector<double>
  FlowOnMesh::jumps() const
  {
    std::vector<double> jump(mesh->edges.size(), 0.);
    std::vector<double> stiffness(jump.size(), 0.);
    const auto          on_edges = [&](const auto &f) {
      for (unsigned int c = 0; c < mesh->cells.size(); ++c)
        for (unsigned int i = 0; i < 3; ++i)
          f(c, i, mesh->edges_of_cell[c][i]);
    };
    on_edges(
      [&](const unsigned int c, const unsigned int i, const unsigned int e) {
        const Tensor<1, dim> g = mesh->gradients(c)[i];
        jump[e] += velocity(c) * g / g.norm();
        stiffness[e] += trace(permeability[mesh->material[c]]);
      });
    std::vector<double> error(mesh->cells.size(), 0.);
    on_edges(
      [&](const unsigned int c, const unsigned int, const unsigned int e) {
        if (boundary_of_edge[e] < 0)
          {
            const auto  &ends = mesh->edges[e].vertices;
            const double length =
              mesh->vertices[ends[0]].distance(mesh->vertices[ends[1]]);
            error[c] += length * length * jump[e] * jump[e] / stiffness[e];
          }
      });
    return error;
  }

  Water::Flow
  FlowOnMesh::result() const
  {
    std::vector<double> pressure = steady.head, size(pressure.size(), 0.);
    for (double &u : pressure)
      u *= scene.water.weight();
    for (unsigned int c = 0; c < mesh->cells.size(); ++c)
      for (const unsigned int v : mesh->cells[c])
        size[v] = std::max(size[v], std::sqrt(mesh->area(c)));
    // Height above the free surface of unsaturated vertices: half a cell.
    const auto depth = [&](const unsigned int v) {
      return steady.head[v] > 0. ? steady.head[v]
                                 : (steady.saturation[v] - 1.) / 2. * size[v];
    };
    std::vector<std::array<Point<dim>, 2>> surface;
    for (const auto &cell : mesh->cells)
      {
        std::vector<Point<dim>> ends;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = cell[i], b = cell[(i + 1) % 3];
            if ((depth(a) > 0.) != (depth(b) > 0.))
              ends.push_back(mesh->vertices[a] +
                             depth(a) / (depth(a) - depth(b)) *
                               (mesh->vertices[b] - mesh->vertices[a]));
          }
        if (ends.size() == 2)
          surface.push_back({{ends[0], ends[1]}});
      }
    return {{mesh->vertices, mesh->cells, pressure}, surface};
  }

  std::vector<double>
  FlowOnMesh::inflows() const
  {
    std::vector<double> all(levels.size(), 0.);
    for (unsigned int v = 0; v < boundary_of.size(); ++v)
      if (boundary_of[v] >= 0)
        all[boundary_of[v]] += steady.inflow[v];
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
    double sum = -rate_of_storage;
    for (const double inflow : inflows())
      sum += inflow;
    return flows() ? sum / discharge() : 0.;
  }

  bool
  FlowOnMesh::flows() const
  {
    const dealii::BoundingBox<dim> body(mesh->vertices);
    double                         largest = 0.;
    for (const auto &k : permeability)
      largest = std::max(largest, trace(k));
    return discharge() > 1e-14 * largest * body.side_length(1);
  }

  std::string
  FlowOnMesh::text() const
  {
    const auto change = this->change();
    return format("%.5g ", discharge()) + scene.geometry.unit("m^3/s/m") +
           " through the body" +
           (change ? format(" (%+.2g %% from the mesh before)", 100. * *change)
                   : "") +
           format(", %u iterations", steady.iterations);
  }

  void
  let_water_flow(Scene         &scene,
                 const MPI_Comm comm,
                 Log           &log,
                 const bool     dry_run,
                 const double   time)
  {
    if (!scene.water.seepage.acts())
      return;
    const auto                steps = scene.water.flow_steps();
    std::vector<Water::Flow>  flows;
    std::optional<FlowOnMesh> flow;
    for (const Seepage::Step &step : steps)
      {
        stop_if_asked(comm);
        if (step.duration > 0.)
          flow->advance(step);
        else
          {
            dealii::Timer timer;
            flow.emplace(scene, step.levels, comm);
            flow->refine();
            if (flows.empty())
              for (const Seepage::Step &later : steps)
                flow->check(later.levels);
            if (dry_run) // the first flow on the first mesh stands for all
              {
                flows.assign(steps.size(), flow->result());
                break;
              }
            for (unsigned int level = 1; level < flow->n_levels(); ++level)
              flow->refine();
            log.print(format("seepage: %zu triangles, ",
                             flow->triangles().cells.size()) +
                      flow->text() + format("; %.2g s", timer.cpu_time()));
          }
        flows.push_back(flow->result());
      }
    scene.water.set_flows(std::move(flows), time);
  }
} // namespace geocone::GEOCONE_DIM
