// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/seepage/flow_boundaries.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  FlowBoundaries::FlowBoundaries(const Scene &scene, const FlowMesh &mesh)
    : of_vertex(mesh.vertices.size(), -1)
    , of_facet(mesh.facet_vertices.size(), -1)
    , scene(scene)
    , mesh(mesh)
  {
    const auto &list = scene.water.seepage.list;
    for (unsigned int b = 0; b < list.size(); ++b)
      {
        parts.push_back(part_of(*list[b]));
        for (const unsigned int f : parts.back().facets)
          of_facet[f] = b;
      }
    all_groups = sorted_groups();
    for (const Group &group : all_groups)
      for (const unsigned int v : group.vertices)
        of_vertex[v] = group.boundary;
  }

  std::vector<FlowBoundaries::Group>
  FlowBoundaries::sorted_groups() const
  {
    const auto         &list = scene.water.seepage.list;
    std::vector<double> of_facets(mesh.facet_vertices.size(), 0.),
      of_connections(mesh.connections.size(), 0.);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const double k =
          trace(scene.materials.law(mesh.material[c]).permeability());
        for (const unsigned int f : mesh.facets_by_cell[c])
          of_facets[f] = std::max(of_facets[f], k);
        for (const unsigned int e : mesh.connections_of_cell[c])
          of_connections[e] = std::max(of_connections[e], k);
      }
    std::vector<Group> groups;
    for (unsigned int b = 0; b < list.size(); ++b)
      {
        std::map<double, Group> by_permeability;
        for (const unsigned int f : parts[b].facets)
          if (of_facet[f] == int(b))
            {
              Group &group = by_permeability[of_facets[f]];
              group.facets.push_back(f);
              for (const unsigned int v : mesh.facet_vertices[f])
                group.vertices.push_back(v);
            }
        if (dim == 3)
          for (const unsigned int e : parts[b].connections)
            for (const unsigned int v : mesh.connections[e])
              by_permeability[of_connections[e]].vertices.push_back(v);
        for (auto &[k, group] : by_permeability)
          {
            group.permeability = k;
            group.boundary     = b;
            groups.push_back(std::move(group));
          }
      }
    std::stable_sort(
      groups.begin(), groups.end(), [&](const Group &a, const Group &b) {
        return std::tie(a.permeability, list[a.boundary]->level) <
               std::tie(b.permeability, list[b.boundary]->level);
      });
    return groups;
  }

  FlowBoundaries::Jump
  FlowBoundaries::largest_jump(const Seepage::Levels &levels) const
  {
    std::vector<double> permeability(mesh.vertices.size(), 0.);
    for (const Group &group : all_groups)
      for (const unsigned int v : group.vertices)
        permeability[v] = group.permeability; // the last one is the largest
    Jump largest;
    for (const Group &group : all_groups)
      for (const unsigned int v : group.vertices)
        {
          const int    other = of_vertex[v];
          const double jump =
            head(levels[group.boundary], v) - head(levels[other], v);
          if (jump == 0.)
            continue;
          // Permeabilities are traces.
          const double k =
            2. / dim / (1. / group.permeability + 1. / permeability[v]);
          const double flow =
            std::abs(jump) * k *
            Geometry::measure(scene.geometry.symmetry, mesh.vertices[v]);
          if (flow > largest.flow)
            largest = {std::abs(jump),
                       flow,
                       mesh.vertices[v],
                       jump > 0. ? group.boundary : other,
                       jump > 0. ? other : group.boundary};
        }
    return largest;
  }

  FlowBoundaries::Part
  FlowBoundaries::part_of(const SeepageBoundary &boundary) const
  {
    Part part;
    if (boundary.drain.empty())
      {
        part.facets = mesh.outer_facets(boundary);
        for (const unsigned int f : part.facets)
          for (const unsigned int v : mesh.facet_vertices[f])
            part.vertices.push_back(v);
        return part;
      }
    double rest = 0.; // without edges
    for (std::size_t i = 1; i < boundary.drain.size(); ++i)
      rest += boundary.drain[i].distance(boundary.drain[i - 1]);
    const double length = rest;
    for (unsigned int e = 0; e < mesh.connections.size(); ++e)
      {
        const auto &[a, b] = mesh.connections[e];
        if (!boundary.is_on_drain(mesh.vertices[a]) ||
            !boundary.is_on_drain(mesh.vertices[b]))
          continue;
        rest -= mesh.vertices[a].distance(mesh.vertices[b]);
        part.vertices.insert(part.vertices.end(), {a, b});
        part.connections.push_back(e);
        if (dim == 2) // the edge is a facet
          part.facets.push_back(e);
      }
    if (part.vertices.empty() || (dim == 3 && rest > 1e-6 * length))
      throw InputError(
        boundary.parameter("Drain"),
        dealii::Patterns::Tools::to_string(boundary.drain),
        dim == 2 ? "a line in the body" : "a line along edges of the mesh",
        dim == 2 ? "choose points inside of it; in a mesh of a file "
                   "drains follow edges of cells"
                 : "let it follow lines of the grid of 'Mesh', or edges "
                   "of the cells of a file");
    return part;
  }

  void
  FlowBoundaries::check(const Seepage::Levels &levels) const
  {
    for (unsigned int b = 0; b < levels.size(); ++b)
      if (levels[b])
        {
          double lowest = std::numeric_limits<double>::max();
          for (const unsigned int v : parts[b].vertices)
            lowest = std::min(lowest, mesh.vertices[v][1]);
          if (!(*levels[b] > lowest))
            throw InputError(scene.water.seepage.list[b]->parameter("Level"),
                             *levels[b],
                             format("above the lowest point of its sides, y = "
                                    "%g m",
                                    lowest),
                             "a side in the air has no level: none");
        }
  }

  FlowConditions
  FlowBoundaries::conditions(const Seepage::Levels &levels,
                             const double           time,
                             const double           duration) const
  {
    using Kind                = FlowConditions::Kind;
    const unsigned int n      = mesh.vertices.size();
    const auto        &listed = scene.water.seepage.list;
    FlowConditions     all;
    all.kind.assign(n, Kind::none);
    all.head.assign(n, 0.);
    all.rain.assign(n, 0.);
    for (unsigned int v = 0; v < n; ++v)
      if (of_vertex[v] >= 0)
        {
          all.kind[v] = Kind::seepage_face;
          all.head[v] = head(levels[of_vertex[v]], v);
          if (all.head[v] > 1e-9 * (1. + std::abs(mesh.vertices[v][1])))
            all.kind[v] = Kind::head;
        }
    std::vector<double> rain; // means over the step
    for (const auto &boundary : listed)
      {
        constexpr unsigned int n_samples = 64;
        const unsigned int     n_used    = duration > 0. ? n_samples : 1;
        double                 sum       = 0.;
        for (unsigned int k = 0; k < n_used; ++k)
          sum += boundary->rain(time - duration * (k + 0.5) / n_used);
        rain.push_back(sum / n_used);
      }
    for (unsigned int f = 0; f < mesh.facet_vertices.size(); ++f)
      if (of_facet[f] >= 0)
        {
          const double flow =
            rain[of_facet[f]] * mesh.projected_size(f) *
            Geometry::measure(scene.geometry.symmetry, mesh.facet_centre(f));
          for (const unsigned int v : mesh.facet_vertices[f])
            all.rain[v] += flow / dim;
        }
    return all;
  }

  std::vector<double>
  FlowBoundaries::hydrostatic(const Seepage::Levels &levels,
                              const bool             is_unsaturated) const
  {
    double highest = std::numeric_limits<double>::lowest();
    for (const auto &level : levels)
      highest = std::max(highest, level.value_or(highest));
    if (is_unsaturated)
      for (const Point<dim> &x : mesh.vertices)
        if (highest < x[1] &&
            std::none_of(levels.begin(), levels.end(), [](const auto &level) {
              return level.has_value();
            }))
          highest = x[1];
    std::vector<double> s;
    for (const Point<dim> &x : mesh.vertices)
      s.push_back(is_unsaturated ? highest - x[1]
                                 : std::max(highest - x[1], -0.5));
    return s;
  }
} // namespace geocone::GEOCONE_DIM
