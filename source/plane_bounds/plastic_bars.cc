// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/plane_bounds/plastic_bars.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    double
    cross(const Tensor<1, dim> &a, const Tensor<1, dim> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Distance below which points of the mesh are equal (m). */
    double
    tolerance_of(const Triangles &triangles)
    {
      const dealii::BoundingBox<dim> body(triangles.vertices);
      return 1e-7 * (body.side_length(0) + body.side_length(1));
    }

    bool
    is_in_body(const Triangles  &triangles,
               const Point<dim> &x,
               const double      near)
    {
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        {
          const auto g      = triangles.gradients(c);
          bool       inside = true;
          for (unsigned int i = 0; i < 3 && inside; ++i)
            {
              const Point<dim> &opposite =
                triangles.vertices[triangles.cells[c][(i + 1) % 3]];
              inside = g[i] * (x - opposite) > -near * g[i].norm();
            }
          if (inside)
            return true;
        }
      return false;
    }

    /** Edges of the mesh along a segment, in order, each with its end that is farther
     *  along. Empty if they do not cover the segment. */
    std::vector<std::array<unsigned int, 2>>
    edges_along(const Triangles  &triangles,
                const Point<dim> &from,
                const Point<dim> &to,
                const double      near)
    {
      const double         length = from.distance(to);
      const Tensor<1, dim> t      = (to - from) / length;
      struct Found
      {
        double       begin, end;
        unsigned int edge, vertex;
      };
      std::vector<Found> found;
      for (unsigned int e = 0; e < triangles.edges.size(); ++e)
        {
          const auto &ends = triangles.edges[e].vertices;
          double      s[2];
          bool        is_on = true;
          for (unsigned int i = 0; i < 2; ++i)
            {
              const Tensor<1, dim> r = triangles.vertices[ends[i]] - from;
              s[i]                   = r * t;
              is_on = is_on && std::abs(cross(t, r)) < near && s[i] > -near &&
                      s[i] < length + near;
            }
          if (is_on)
            found.push_back({std::min(s[0], s[1]),
                             std::max(s[0], s[1]),
                             e,
                             ends[s[1] > s[0] ? 1 : 0]});
        }
      std::sort(found.begin(), found.end(), [](const Found &a, const Found &b) {
        return a.begin < b.begin;
      });
      double                                   reached = 0.;
      std::vector<std::array<unsigned int, 2>> edges;
      for (const Found &one : found)
        {
          if (std::abs(one.begin - reached) > 2. * near)
            return {};
          reached = one.end;
          edges.push_back({{one.edge, one.vertex}});
        }
      if (std::abs(reached - length) > 2. * near)
        return {};
      return edges;
    }
  } // namespace

  void
  PlasticBars::find_chain(const Structure &structure,
                          const Triangles &triangles)
  {
    const double near = tolerance_of(triangles);
    Chain        chain;
    chain.structure = &structure;
    for (std::size_t i = 1; i < structure.points.size(); ++i)
      {
        const Point<dim> &from = structure.points[i - 1],
                         &to   = structure.points[i];
        if (i > 1 && !structure.is_plate())
          {
            const Tensor<1, dim> before = from - structure.points[i - 2],
                                 after  = to - from;
            if (!(before * after > 0.) || std::abs(cross(before, after)) >
                                            1e-6 * before.norm() * after.norm())
              throw InputError(structure.parameter("Points"),
                               format("a bend at (%g, %g)", from[0], from[1]),
                               "points on a straight line where loads are "
                               "bounded",
                               "a bend of a geogrid would press on a point of "
                               "the soil: give two geogrids, or a plate");
          }
        const auto edges = edges_along(triangles, from, to, near);
        if (edges.empty())
          throw InputError(
            structure.parameter("Points"),
            format("(%g, %g) to (%g, %g)", from[0], from[1], to[0], to[1]),
            "a line in the body, of edges of the mesh, where "
            "loads are bounded",
            "set 'Mesh/Type' = unstructured, whose edges follow "
            "structures, or let them end where the body ends");
        for (const auto &[edge, end] : edges)
          {
            const auto &ends = triangles.edges[edge].vertices;
            if (chain.vertices.empty())
              chain.vertices.push_back(ends[0] == end ? ends[1] : ends[0]);
            chain.edges.push_back(edge);
            chain.vertices.push_back(end);
          }
      }
    chains.push_back(std::move(chain));
  }

  void
  PlasticBars::find_tie(const Structure &structure, const Triangles &triangles)
  {
    const double near = tolerance_of(triangles);
    Tie          tie;
    tie.structure = &structure;
    tie.along     = structure.points[1] - structure.points[0];
    tie.along /= tie.along.norm();
    bool is_tied = false;
    for (unsigned int end = 0; end < 2; ++end)
      {
        const Point<dim> &x = structure.points[end];
        tie.vertices[end]   = -1;
        bool holds_all = false, is_straight = true;
        for (const Chain &chain : chains)
          for (unsigned int i = 0; i < chain.vertices.size(); ++i)
            if (const unsigned int v = chain.vertices[i];
                triangles.vertices[v].distance(x) < near)
              {
                tie.vertices[end] = v;
                const Tensor<1, dim> t =
                  chain.structure->points[1] - chain.structure->points[0];
                holds_all   = holds_all || chain.structure->is_plate();
                is_straight = is_straight &&
                              std::abs(cross(t, tie.along)) < 1e-6 * t.norm();
                // A geogrid carries nothing across itself, not even the rounding of
                // given points.
                if (is_straight && !chain.structure->is_plate())
                  tie.along = (t * tie.along > 0. ? 1. : -1.) * t / t.norm();
              }
        const std::string where = format("(%g, %g)", x[0], x[1]);
        if (tie.vertices[end] < 0 && is_in_body(triangles, x, near))
          throw InputError(structure.parameter("Points"),
                           where,
                           "ends on a plate, on a geogrid or outside of the "
                           "body where loads are bounded",
                           "soil carries no force at a point: give the "
                           "grouted length as a geogrid with a 'Compressive "
                           "strength', and the end among the 'Points' of that "
                           "geogrid or plate");
        if (tie.vertices[end] >= 0 && !holds_all && !is_straight)
          throw InputError(structure.parameter("Points"),
                           where,
                           "the direction of the geogrid at its end where "
                           "loads are bounded",
                           "a geogrid carries axial forces only: turn one of "
                           "both, or let it end on a plate");
        is_tied = is_tied || tie.vertices[end] >= 0;
      }
    if (!is_tied)
      throw InputError(structure.parameter("Points"),
                       "two points outside of the body",
                       "one point at least on a plate or a geogrid where loads "
                       "are bounded",
                       "move one of them to a point of a plate");
    ties.push_back(tie);
  }

  void
  PlasticBars::number(const Triangles &triangles)
  {
    edge_number.assign(triangles.edges.size(), -1);
    vertex_number.assign(triangles.vertices.size(), -1);
    for (const Chain &chain : chains)
      {
        for (const unsigned int v : chain.vertices)
          if (vertex_number[v] < 0)
            {
              vertex_number[v] = vertices.size();
              vertices.push_back(v);
            }
        for (const unsigned int e : chain.edges)
          {
            if (edge_number[e] < 0)
              {
                edge_number[e] = edges.size();
                edges.emplace_back();
                edges.back().edge = e;
              }
            BarEdge &one           = edges[edge_number[e]];
            one.interface_strength = std::min(
              one.interface_strength, chain.structure->interface_strength);
          }
      }
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      for (const unsigned int e : triangles.edges_of_cell[c])
        if (edge_number[e] >= 0)
          {
            auto &cells                 = edges[edge_number[e]].cells;
            cells[cells[0] < 0 ? 0 : 1] = c;
          }
    first_rotation = dim * (4 * edges.size() + vertices.size());
    for (const Chain &chain : chains)
      {
        rotation_of_chain.push_back(n_rotations);
        n_rotations += chain.vertices.size();
      }
  }

  namespace
  {
    /** Triangle and its vertex. */
    using Corner = std::array<unsigned int, 2>;

    /** Triangles around a vertex that are connected by edges without structures. */
    struct Sector
    {
      std::vector<Corner> corners;
      double              angle = 0.;
      std::vector<bool>   is_frictional; ///< of the soil at each structure

      /** Whether the velocity of the sector relative to the structures beside it must be
       *  zero, or all but that: where the soil is frictional it leaves both of them.
       *  @param is_held whether the vertex has a prescribed velocity */
      bool
      is_bonded(const bool is_held) const
      {
        const unsigned int n =
          std::count(is_frictional.begin(), is_frictional.end(), true);
        if (n == 0)
          return false;
        return is_held ||
               (is_frictional.size() > 1 &&
                (n < is_frictional.size() || std::abs(angle - pi) > pi / 4.));
      }
    };

    double
    angle_at(const Triangles &triangles, const Corner &corner)
    {
      const auto          &v = triangles.cells[corner[0]];
      const Point<dim>    &x = triangles.vertices[v[corner[1]]];
      const Tensor<1, dim> a = triangles.vertices[v[(corner[1] + 1) % 3]] - x,
                           b = triangles.vertices[v[(corner[1] + 2) % 3]] - x;
      return std::atan2(cross(a, b), a * b);
    }

    /** Sectors of the corners around a vertex. @param is_bar of an edge */
    template <typename IsBar>
    std::vector<Sector>
    sectors_of(const Triangles         &triangles,
               std::vector<Corner>      corners,
               const std::vector<bool> &is_frictional,
               const IsBar             &is_bar)
    {
      std::vector<Sector> all;
      while (!corners.empty())
        {
          Sector              sector;
          std::vector<Corner> next = {corners.back()};
          corners.pop_back();
          while (!next.empty())
            {
              const Corner corner = next.back();
              next.pop_back();
              sector.corners.push_back(corner);
              sector.angle += angle_at(triangles, corner);
              for (const unsigned int e :
                   {(corner[1] + 1) % 3, (corner[1] + 2) % 3})
                {
                  const unsigned int edge =
                    triangles.edges_of_cell[corner[0]][e];
                  if (is_bar(edge))
                    {
                      sector.is_frictional.push_back(
                        is_frictional[triangles.material[corner[0]]]);
                      continue;
                    }
                  for (unsigned int k = corners.size(); k-- > 0;)
                    {
                      const auto &of = triangles.edges_of_cell[corners[k][0]];
                      if (std::count(of.begin(), of.end(), edge) > 0)
                        {
                          next.push_back(corners[k]);
                          corners.erase(corners.begin() + k);
                        }
                    }
                }
            }
          all.push_back(std::move(sector));
        }
      return all;
    }
  } // namespace

  void
  PlasticBars::divide(const Triangles         &triangles,
                      const std::vector<bool> &is_frictional,
                      const std::vector<bool> &is_held)
  {
    const unsigned int n_vertices = triangles.vertices.size(),
                       n_nodes    = n_vertices + triangles.edges.size();
    constexpr unsigned int           bonded = -1;
    std::vector<std::vector<Corner>> corners(vertices.size());
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        cell_nodes.emplace_back();
        sectors.push_back(triangles.cells[c]);
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int v = triangles.cells[c][i],
                               e = triangles.edges_of_cell[c][i];
            cell_nodes[c][i]     = v;
            cell_nodes[c][i + 3] = n_vertices + e;
            if (vertex_number[v] >= 0)
              corners[vertex_number[v]].push_back({{c, i}});
            if (edge_number[e] >= 0 && side_of(edge_number[e], c) > 0)
              cell_nodes[c][i + 3] = n_nodes + n_copies++;
          }
      }
    std::vector<bool> is_bonded(vertices.size(), false);
    for (unsigned int k = 0; k < vertices.size(); ++k)
      {
        bool is_first = true, is_first_sector = true;
        for (const Sector &sector : sectors_of(
               triangles, corners[k], is_frictional, [&](const unsigned int e) {
                 return edge_number[e] >= 0;
               }))
          {
            const bool         bonds = sector.is_bonded(is_held[vertices[k]]);
            const unsigned int node  = bonds      ? bonded
                                       : is_first ? vertices[k]
                                                  : n_nodes + n_copies++;
            is_first                 = is_first && bonds;
            is_bonded[k]             = is_bonded[k] || bonds;
            for (const Corner &corner : sector.corners)
              {
                cell_nodes[corner[0]][corner[1]] = node;
                if (!is_first_sector)
                  sectors[corner[0]][corner[1]] = n_vertices + n_more_sectors;
              }
            n_more_sectors += !is_first_sector;
            is_first_sector = false;
          }
      }
    first_bar_node = n_nodes + n_copies;
    number_jumps(triangles, is_bonded, is_held);
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      for (unsigned int i = 0; i < 3; ++i)
        if (cell_nodes[c][i] == bonded)
          cell_nodes[c][i] =
            node_of_vertex(vertex_number[triangles.cells[c][i]]);
  }

  void
  PlasticBars::number_jumps(const Triangles         &triangles,
                            const std::vector<bool> &is_bonded,
                            const std::vector<bool> &is_held)
  {
    std::vector<unsigned int> n_forces(vertices.size(), 0);
    for (const BarEdge &edge : edges)
      for (const unsigned int v : triangles.edges[edge.edge].vertices)
        ++n_forces[vertex_number[v]];
    for (const Tie &tie : ties)
      for (const int v : tie.vertices)
        if (v >= 0)
          ++n_forces[vertex_number[v]];
    for (const Chain &chain : chains)
      {
        const auto [least, most] = chain.structure->axial_strength();
        if (std::isinf(least) && std::isinf(most))
          continue;
        for (const unsigned int e : chain.edges)
          for (unsigned int end = 0; end < 2; ++end)
            {
              const unsigned int v    = triangles.edges[e].vertices[end];
              const unsigned int k    = vertex_number[v];
              BarEdge           &edge = edges[edge_number[e]];
              if (edge.jumps[end] < 0 && !edge.is_held && !is_bonded[k] &&
                  (n_forces[k] > 1 || is_held[v]))
                edge.jumps[end] = n_jumps++;
            }
      }
  }

  PlasticBars::PlasticBars(const Scene                  &scene,
                           const Triangles              &triangles,
                           const std::vector<Interface> &interfaces,
                           const std::vector<bool>      &is_frictional)
  {
    if (scene.structures.list.empty())
      return;
    for (const auto &structure : scene.structures.list)
      if (structure->is_chain())
        find_chain(*structure, triangles);
    for (const auto &structure : scene.structures.list)
      if (!structure->is_chain())
        find_tie(*structure, triangles);
    number(triangles);
    std::vector<bool> is_held(triangles.vertices.size(), false);
    for (const auto &condition : scene.dirichlet.list)
      for (const auto &held : triangles.held_edges(*condition))
        {
          for (const unsigned int v : triangles.edges[held.edge].vertices)
            is_held[v] = true;
          if (const int k = number_of_edge(held.edge); k >= 0)
            edges[k].is_held = true;
        }
    for (const Interface &interface : interfaces)
      for (const unsigned int v : triangles.edges[interface.held.edge].vertices)
        is_held[v] = true;
    for (const Interface &interface : interfaces)
      for (const Chain &chain : chains)
        {
          const auto &ends = triangles.edges[interface.held.edge].vertices;
          const auto  has  = [&](const unsigned int v) {
            return std::count(chain.vertices.begin(), chain.vertices.end(), v);
          };
          if (interface.obstacle < 0 && has(ends[0]) + has(ends[1]) > 0)
            throw InputError(chain.structure->parameter("Points"),
                             "a point on a side that slides along a line "
                             "oblique to x and y",
                             "points elsewhere where loads are bounded",
                             "such a side would not hold it: leave one of them "
                             "out there, or turn the scene");
          if (std::count(chain.edges.begin(),
                         chain.edges.end(),
                         interface.held.edge) > 0)
            throw InputError(chain.structure->parameter("Points"),
                             "a side that an obstacle touches",
                             "lines elsewhere where loads are bounded",
                             "leave one of them out there");
        }
    for (Chain &chain : chains)
      chain.ends_are_held =
        is_held[chain.vertices.front()] && is_held[chain.vertices.back()];
    divide(triangles, is_frictional, is_held);
  }
} // namespace geocone::GEOCONE_DIM
