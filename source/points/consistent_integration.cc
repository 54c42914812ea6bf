// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/points/consistent_integration.h>
#include <geocone/surfaces/side_points.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Fraction of a cell's size that counts as zero. */
    constexpr double negligible_part = 1e-9;

    /** Filled fractions of the volume of the cells around a vertex, and of each
     *  of them, from which the vertex is in the body. At a flat surface half of
     *  them are full and the others to two fifths. Single cells of a body that is
     *  sheared a lot may be less than half full. */
    constexpr double least_fill_of_patch = 0.7, least_fill_of_cell = 0.1;

    /** Soil fraction of a cell up to which it need not be filled. */
    constexpr double least_part = 0.1;

    /** Relative size of gaps between loaded facets over a cell that counts as
     *  zero. */
    constexpr double negligible_gap = 1e-6;

    /** Slope up to which the mean level of a loaded side is taken at the edge of
     *  another one: an error of this part of the traction. */
    constexpr double small_slope = 0.02;

    /** Lower and upper corner of a box. */
    using Corners = std::pair<Point<dim>, Point<dim>>;

    /** Part of a cell's box on the soil's side of the limits that intersect it
     *  or lie at most one cell away. */
    Corners
    part_within(const BoundingBox<dim>       &box,
                const std::vector<SoilLimit> &limits)
    {
      auto [lower, upper] = box.get_boundary_points();
      for (const SoilLimit &limit : limits)
        {
          bool acts = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double size = box.side_length(d);
              acts =
                acts && (d == limit.axis
                           ? limit.level > box.lower_bound(d) - size &&
                               limit.level < box.upper_bound(d) + size
                           : limit.extent.lower_bound(d) <
                                 box.lower_bound(d) + negligible_part * size &&
                               limit.extent.upper_bound(d) >
                                 box.upper_bound(d) - negligible_part * size);
            }
          if (!acts)
            continue;
          const double level = std::clamp(limit.level,
                                          box.lower_bound(limit.axis),
                                          box.upper_bound(limit.axis));
          if (limit.soil_is_below)
            upper[limit.axis] = std::min(upper[limit.axis], level);
          else
            lower[limit.axis] = std::max(lower[limit.axis], level);
        }
      return {lower, upper};
    }

    /** Area of a box normal to an axis; in two dimensions a length. */
    double
    cross_section(const Corners &box, const unsigned int axis)
    {
      double product = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          product *= std::max(0., box.second[d] - box.first[d]);
      return product;
    }

    /** Facet of a loaded side, with an axis along which it limits the soil. */
    struct LoadedFacet
    {
      SidePart         part;
      unsigned int     axis = 0;
      bool             soil_is_below;
      BoundingBox<dim> extent;

      LoadedFacet(const SidePart &part, const unsigned int axis)
        : part(part)
        , axis(axis)
        , soil_is_below(area_of(part)[axis] > 0.)
        , extent(part.corners)
      {}

      /** Facet along the axis to which it is nearly normal. */
      explicit LoadedFacet(const SidePart &part)
        : LoadedFacet(part, main_axis(area_of(part)))
      {}

      /** Whether it acts on a cell along a direction: over the cross-section,
       *  at most one cell away. */
      bool
      is_near(const BoundingBox<dim> &cell, const unsigned int along) const
      {
        bool near = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double margin =
              (d == along ? 1. : -negligible_part) * cell.side_length(d);
            near = near &&
                   extent.lower_bound(d) < cell.upper_bound(d) + margin &&
                   extent.upper_bound(d) > cell.lower_bound(d) - margin;
          }
        return near;
      }

      double
      projected_area() const
      {
        return std::abs(area_of(part)[axis]);
      }

      bool
      is_nearly_normal_to_axis() const
      {
        Tensor<1, dim> across = area_of(part);
        const double   size   = across.norm();
        across[axis]          = 0.;
        return across.norm() < small_slope * size;
      }

    private:
      static unsigned int
      main_axis(const Tensor<1, dim> &area)
      {
        unsigned int axis = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(area[d]) > std::abs(area[axis]))
            axis = d;
        return axis;
      }
    };

    /** Known boundaries of the soil. */
    struct Boundary
    {
      std::vector<SoilLimit>   limits;
      std::vector<LoadedFacet> loaded;
    };

    /** Part of a cell that can be soil: a box, or its part up to loaded facets
     *  along one axis. */
    struct SoilPart
    {
      Corners                  box;
      std::vector<LoadedFacet> top = {}; ///< inside the box

      /** Volume, or area in two dimensions. */
      double
      volume() const
      {
        if (top.empty())
          return cross_section(box, 0) *
                 std::max(0., box.second[0] - box.first[0]);
        double sum = 0.;
        for (const LoadedFacet &facet : top)
          sum += facet.projected_area() * height(facet, facet.part.middle());
        return sum;
      }

      /** Height of a position on a facet above the end of the box on the
       *  soil's side. */
      double
      height(const LoadedFacet &facet, const Point<dim> &x) const
      {
        return facet.soil_is_below ? x[facet.axis] - box.first[facet.axis]
                                   : box.second[facet.axis] - x[facet.axis];
      }

      /** Quadrature points and weights, n in each direction of a box. */
      std::vector<std::pair<Point<dim>, double>>
      quadrature(const unsigned int n) const
      {
        std::vector<std::pair<Point<dim>, double>> points;
        if (top.empty())
          {
            const QGauss<dim> rule(n);
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                Point<dim> x;
                for (unsigned int d = 0; d < dim; ++d)
                  x[d] = box.first[d] +
                         (box.second[d] - box.first[d]) * rule.point(q)[d];
                points.push_back({x, rule.weight(q) * volume()});
              }
            return points;
          }
        const Quadrature<dim - 1> across = rule_of_facets();
        const QGauss<1>           along(n + 1);
        for (const LoadedFacet &facet : top)
          for (unsigned int q = 0; q < across.size(); ++q)
            {
              Point<dim>   x       = facet.part.at(across.point(q));
              const double top_end = x[facet.axis], h = height(facet, x);
              for (unsigned int k = 0; k < along.size(); ++k)
                {
                  x[facet.axis] = top_end + (facet.soil_is_below ? -h : h) *
                                              along.point(k)[0];
                  points.push_back({x,
                                    facet.projected_area() * h *
                                      across.weight(q) * along.weight(k)});
                }
            }
        return points;
      }
    };

    /** Parts of facets in the column of a box along their axis, limited to the
     *  box. */
    std::vector<LoadedFacet>
    over_box(const Corners                  &box,
             const unsigned int              axis,
             const std::vector<LoadedFacet> &facets)
    {
      std::vector<SideOfPlane> column;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          {
            column.push_back({box.first, Point<dim>::unit_vector(d)});
            column.push_back({box.second, -Point<dim>::unit_vector(d)});
          }
      const double         from = box.first[axis], to = box.second[axis];
      const Tensor<1, dim> up = Point<dim>::unit_vector(axis);
      const std::vector<std::vector<SideOfPlane>> layers = {
        {{box.first, -up}},
        {{box.first, up}, {box.second, -up}},
        {{box.second, up}}};
      std::vector<LoadedFacet> result;
      const auto               add = [&](SidePart piece) {
        for (Point<dim> &corner : piece.corners)
          corner[axis] = std::clamp(corner[axis], from, to);
        if (std::abs(area_of(piece)[axis]) > 0.)
          result.emplace_back(piece, axis);
      };
      for (const LoadedFacet &facet : facets)
        for (const SidePart &piece : pieces_between(column, facet.part))
          {
            const BoundingBox<dim> extent(piece.corners);
            if (!(extent.side_length(axis) > negligible_part * (to - from)))
              add(piece);
            else // below, inside and above the box
              for (const std::vector<SideOfPlane> &layer : layers)
                for (const SidePart &rest : pieces_between(layer, piece))
                  add(rest);
          }
      return result;
    }

    double
    projected_area(const std::vector<LoadedFacet> &facets)
    {
      double sum = 0.;
      for (const LoadedFacet &facet : facets)
        sum += facet.projected_area();
      return sum;
    }

    /** Whether facets cover the cross-section of a box up to a part of it. */
    bool
    covers(const std::vector<LoadedFacet> &facets,
           const Corners                  &box,
           const unsigned int              axis,
           const double                    gap)
    {
      const double size = cross_section(box, axis);
      return std::abs(projected_area(facets) - size) < gap * size;
    }

    /** Part of a box up to the loaded facets that lie over it along an axis, if
     *  they cover its cross-section and have the soil on the same side. With the
     *  axis chosen for all of them, columns of the box neither overlap nor leave
     *  gaps, whatever their slopes. */
    std::optional<SoilPart>
    cut_along(const unsigned int              axis,
              const BoundingBox<dim>         &cell,
              const Corners                  &box,
              const std::vector<LoadedFacet> &loaded)
    {
      std::vector<LoadedFacet> near;
      for (const LoadedFacet &facet : loaded)
        if (facet.is_near(cell, axis))
          near.emplace_back(facet.part, axis);
      SoilPart                                cut{box};
      const double                            size = cell.side_length(axis);
      std::array<std::vector<LoadedFacet>, 2> tops; // by side of the soil
      std::array<bool, 2>                     limits = {};
      for (const LoadedFacet &facet : over_box(box, axis, near))
        {
          const bool below = facet.soil_is_below;
          tops[below].push_back(facet);
          if (cut.height(facet, facet.part.middle()) <
              box.second[axis] - box.first[axis] - negligible_part * size)
            limits[below] = true;
        }
      if (limits[0] && limits[1])
        return std::nullopt; // a thin body
      // Of a side beyond the box nothing remains but its soil in all of it.
      if (!tops[0].empty() && !tops[1].empty())
        tops[limits[1] ? 0 : 1].clear();
      cut.top = tops[0].empty() ? tops[1] : tops[0];
      if (!covers(cut.top, box, axis, negligible_gap))
        return std::nullopt;
      return cut;
    }

    /** Part of a box at a convex corner of loaded sides nearly normal to the
     *  axes: the box up to their mean levels. */
    std::optional<SoilPart>
    cut_at_corner(const BoundingBox<dim>         &cell,
                  const Corners                  &box,
                  const std::vector<LoadedFacet> &loaded)
    {
      std::array<std::vector<LoadedFacet>, dim> near; // by axis
      for (const LoadedFacet &facet : loaded)
        if (facet.is_near(cell, facet.axis))
          {
            if (!facet.is_nearly_normal_to_axis())
              return std::nullopt;
            near[facet.axis].push_back(facet);
          }
      SoilPart cut{box};
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const std::vector<LoadedFacet> tops = over_box(box, axis, near[axis]);
          if (tops.empty())
            continue;
          const bool below = tops[0].soil_is_below;
          double     level = 0.;
          for (const LoadedFacet &facet : tops)
            level += facet.projected_area() / projected_area(tops) *
                     facet.part.middle()[axis];
          for (const LoadedFacet &facet : tops)
            if (facet.soil_is_below != below ||
                std::abs(facet.part.middle()[axis] - level) >
                  small_slope * cell.side_length(axis))
              return std::nullopt; // a thin body, or a step
          (below ? cut.box.second : cut.box.first)[axis] = level;
        }
      // Facets that end at a re-entrant corner do not cover the box.
      for (unsigned int axis = 0; axis < dim; ++axis)
        if (!near[axis].empty() &&
            !covers(
              over_box(cut.box, axis, near[axis]), cut.box, axis, small_slope))
          return std::nullopt;
      return cut;
    }

    /** Limits the soil part of a cell to the loaded sides near it, where it is
     *  known exactly from them. */
    void
    cut_at_loaded_sides(const BoundingBox<dim>         &cell,
                        const std::vector<LoadedFacet> &loaded,
                        SoilPart                       &part)
    {
      std::vector<LoadedFacet> near;
      Tensor<1, dim>           area; // without signs
      for (const LoadedFacet &facet : loaded)
        {
          bool is_near = false;
          for (unsigned int d = 0; d < dim; ++d)
            is_near = is_near || facet.is_near(cell, d);
          if (!is_near)
            continue;
          near.push_back(facet);
          const Tensor<1, dim> of_facet = area_of(facet.part);
          for (unsigned int d = 0; d < dim; ++d)
            area[d] += std::abs(of_facet[d]);
        }
      if (near.empty())
        return;
      std::array<unsigned int, dim> axes;
      std::iota(axes.begin(), axes.end(), 0);
      std::stable_sort(axes.begin(),
                       axes.end(),
                       [&](const unsigned int a, const unsigned int b) {
                         return area[a] > area[b];
                       });
      for (const unsigned int axis : axes)
        if (const auto cut = cut_along(axis, cell, part.box, near))
          {
            part = *cut;
            return;
          }
      if (const auto cut = cut_at_corner(cell, part.box, near))
        part = *cut;
    }

    /** Part of a cell on the soil's side of all boundaries. */
    SoilPart
    soil_part(const BoundingBox<dim> &cell, const Boundary &boundary)
    {
      SoilPart part{part_within(cell, boundary.limits)};
      if (!boundary.loaded.empty())
        cut_at_loaded_sides(cell, boundary.loaded, part);
      return part;
    }

    /** Integrals for the corrections, over a part of a cell. */
    struct CellIntegrals
    {
      double                      volume = 0.;
      std::vector<Tensor<1, dim>> gradient; ///< of grad N_i
      std::vector<double>         hoop;     ///< of N_i/r, around an axis

      /** Adds the integrals of another cell, for the nodes shared with this
       *  one. */
      void
      add(const CellIntegrals                        &other,
          const std::vector<types::global_dof_index> &nodes_of_other,
          const std::vector<types::global_dof_index> &nodes)
      {
        volume += other.volume;
        for (unsigned int j = 0; j < nodes_of_other.size(); ++j)
          if (const auto found =
                std::find(nodes.begin(), nodes.end(), nodes_of_other[j]);
              found != nodes.end())
            {
              gradient[found - nodes.begin()] += other.gradient[j];
              if (!hoop.empty())
                hoop[found - nodes.begin()] += other.hoop[j];
            }
      }
    };

    CellIntegrals
    integrate(const BackgroundMesh &mesh,
              const Space          &space,
              const Space::Cell    &cell,
              const SoilPart       &part)
    {
      const unsigned int          n   = space.nodes_per_cell();
      const BoundingBox<dim>      box = cell->bounding_box();
      std::vector<double>         values(n);
      std::vector<Tensor<1, dim>> unit_gradient(n);
      CellIntegrals               sum;
      sum.gradient.resize(n);
      sum.hoop.resize(mesh.is_axisymmetric() ? n : 0);
      for (const auto &[x, size] : part.quadrature(
             space.degree() / 2 + 1 + (mesh.is_axisymmetric() ? 1 : 0)))
        {
          Point<dim> unit;
          for (unsigned int d = 0; d < dim; ++d)
            unit[d] = (x[d] - box.lower_bound(d)) / box.side_length(d);
          const double weight = size * mesh.measure(x);
          space.evaluate(cell, unit, values.data(), unit_gradient.data());
          const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
          sum.volume += weight;
          for (unsigned int i = 0; i < n; ++i)
            sum.gradient[i] += weight * (unit_gradient[i] * inverse);
          for (unsigned int i = 0; i < sum.hoop.size(); ++i)
            sum.hoop[i] += weight * values[i] / x[0];
        }
      return sum;
    }

    /** Capacity of a cell with points: the part that can be soil, and the
     *  fraction of it filled by the volumes of its points. */
    struct Room
    {
      SoilPart part;
      double   share;  ///< of the cell
      double   volume; ///< of the part
      double   filled; ///< volume of the points over this
    };

    std::vector<Room>
    rooms_of_cells(const BackgroundMesh &mesh,
                   const Boundary       &boundary,
                   const MaterialPoints &points)
    {
      std::vector<Room> rooms;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const BoundingBox<dim> box  = points.cells[c]->bounding_box();
          const SoilPart         part   = soil_part(box, boundary);
          double                 volume = 0.;
          for (const auto &[x, size] : part.quadrature(1))
            volume += size * mesh.measure(x); // which is linear
          rooms.push_back(
            {part,
             part.volume() / box.volume(),
             volume,
             std::accumulate(&points.volume[points.first_point[c]],
                             &points.volume[points.first_point[c + 1] - 1] + 1,
                             0.) /
               volume});
        }
      return rooms;
    }

    /** Filled fractions of all cells of this rank and its ghost cells.
     *  Collective. */
    std::vector<double>
    filled_parts(const BackgroundMesh    &mesh,
                 const std::vector<Room> &rooms,
                 const MaterialPoints    &points)
    {
      const auto                                &tria = mesh.triangulation();
      LinearAlgebra::distributed::Vector<double> filled(
        tria.global_active_cell_index_partitioner().lock());
      for (unsigned int c = 0; c < rooms.size(); ++c)
        filled[points.cells[c]->global_active_cell_index()] = rooms[c].filled;
      filled.update_ghost_values();
      std::vector<double> result(tria.n_active_cells(), 0.);
      for (const Space::Cell &cell : tria.active_cell_iterators())
        if (!cell->is_artificial())
          result[cell->active_cell_index()] =
            filled[cell->global_active_cell_index()];
      return result;
    }

    /** Facets with soil behind and none beyond them. Of the others, some have
     *  no soil in the present stage: no point lies in their cell and in the one
     *  behind it. Some have been buried: a cell away from them along their
     *  normal points fill half of a cell. Collective. */
    std::vector<LoadedFacet>
    free_facets(const BackgroundMesh        &mesh,
                const std::vector<SidePart> &facets,
                const MaterialPoints        &points)
    {
      std::vector<LoadedFacet> loaded(facets.begin(), facets.end()), free;
      // Beyond each facet, and number of cells with points behind it.
      std::vector<double> filled(loaded.size(), 0.), behind = filled;
      for (unsigned int c = 0; c < points.n_cells() && !loaded.empty(); ++c)
        {
          const BoundingBox<dim> box = points.cells[c]->bounding_box();
          const double           part =
            std::accumulate(&points.volume[points.first_point[c]],
                            &points.volume[points.first_point[c + 1] - 1] + 1,
                            0.) /
            (box.volume() * mesh.measure(box.center()));
          for (std::size_t i = 0; i < loaded.size(); ++i)
            {
              const LoadedFacet &facet  = loaded[i];
              const Point<dim>   middle = facet.part.middle();
              // Along an axis, diagonal facets through vertices would see the
              // cells that they cut.
              const Tensor<1, dim> area = area_of(facet.part),
                                   out  = box.side_length(facet.axis) /
                                         area.norm() * area;
              if (box.point_inside(middle + out))
                filled[i] = std::max(filled[i], part);
              if (box.point_inside(middle) || box.point_inside(middle - out))
                behind[i] += 1.;
            }
        }
      sum_over_ranks(filled, mesh.triangulation().get_communicator());
      sum_over_ranks(behind, mesh.triangulation().get_communicator());
      for (std::size_t i = 0; i < loaded.size(); ++i)
        if (filled[i] < 0.5 && behind[i] > 0.)
          free.push_back(loaded[i]);
      return free;
    }

    /** Whether the cells around a vertex that can contain soil are filled. */
    std::vector<bool>
    surrounded_vertices(const BackgroundMesh      &mesh,
                        const Boundary            &boundary,
                        const std::vector<double> &filled)
    {
      const auto         &tria = mesh.triangulation();
      std::vector<bool>   result(tria.n_vertices(), true);
      std::vector<double> available(tria.n_vertices(), 0.),
        taken(tria.n_vertices(), 0.);
      for (const Space::Cell &cell : tria.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const BoundingBox<dim> box  = cell->bounding_box();
            const double           soil =
                           soil_part(box, boundary).volume() / box.volume(),
                         part = filled[cell->active_cell_index()];
            if (!(soil > least_part))
              continue;
            for (const unsigned int v : cell->vertex_indices())
              {
                const unsigned int vertex = cell->vertex_index(v);
                available[vertex] += soil * box.volume();
                taken[vertex] += part * soil * box.volume();
                if (!(part > least_fill_of_cell))
                  result[vertex] = false;
              }
          }
      for (unsigned int vertex = 0; vertex < result.size(); ++vertex)
        result[vertex] =
          result[vertex] &&
          taken[vertex] >= least_fill_of_patch * available[vertex];
      return result;
    }

    /** The adjacent cell, if a boundary leaves a sliver without points in
     *  it. */
    std::optional<Space::Cell>
    sliver_beside(const Space::Cell         &cell,
                  const Boundary            &boundary,
                  const std::vector<double> &filled)
    {
      std::array<bool, 2 *dim> is_limited = {};
      for (const SoilLimit &limit : boundary.limits)
        is_limited[2 * limit.axis + limit.soil_is_below] = true;
      for (const LoadedFacet &facet : boundary.loaded)
        is_limited[2 * facet.axis + facet.soil_is_below] = true;
      for (unsigned int face = 0; face < 2 * dim; ++face)
        {
          if (!is_limited[face] || cell->at_boundary(face))
            continue;
          const Space::Cell other = cell->neighbor(face);
          if (other->is_artificial() || filled[other->active_cell_index()] > 0.)
            continue;
          const BoundingBox<dim> box  = other->bounding_box();
          const double part = soil_part(box, boundary).volume() / box.volume();
          if (part > negligible_part && part < 1. - negligible_part)
            return other;
        }
      return std::nullopt;
    }

    /** Scales the weights of the points of a cell and shifts their gradients,
     *  so that sums over the points equal the integrals. */
    void
    match_integrals(const CellIntegrals &exact,
                    const unsigned int   cell,
                    const double         volume_of_points,
                    MaterialPoints      &points)
    {
      const unsigned int first    = points.first_point[cell],
                         n_points = points.first_point[cell + 1] - first,
                         n        = points.n_nodes;
      double *const weight        = &points.weight[first];
      for (unsigned int q = 0; q < n_points; ++q)
        weight[q] *= exact.volume / volume_of_points;
      const auto shift =
        [&](const auto &integral, double *values, const std::size_t stride) {
          for (unsigned int i = 0; i < n; ++i)
            {
              double defect = integral(i);
              for (unsigned int q = 0; q < n_points; ++q)
                defect -= weight[q] * values[q * stride + i];
              for (unsigned int q = 0; q < n_points; ++q)
                values[q * stride + i] += defect / exact.volume;
            }
        };
      for (unsigned int d = 0; d < dim; ++d)
        shift([&](const unsigned int i) { return exact.gradient[i][d]; },
              &points.gradients[(std::size_t(first) * dim + d) * n],
              dim * n);
      if (!points.hoop.empty())
        shift([&](const unsigned int i) { return exact.hoop[i]; },
              &points.hoop[std::size_t(first) * n],
              n);
    }
  } // namespace

  void
  make_consistent(const BackgroundMesh &mesh,
                  const Space          &space,
                  const SoilBoundary   &sides,
                  MaterialPoints       &points)
  {
    const Boundary boundary{sides.limits,
                            free_facets(mesh, sides.loaded, points)};
    points.weight.assign(points.volume.begin(), points.volume.end());
    const std::vector<Room>   rooms  = rooms_of_cells(mesh, boundary, points);
    const std::vector<double> filled = filled_parts(mesh, rooms, points);
    const std::vector<bool>   is_surrounded =
      surrounded_vertices(mesh, boundary, filled);
    std::vector<types::global_dof_index> nodes, nodes_beside;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const Space::Cell  cell(points.cells[c]);
        const Room        &room  = rooms[c];
        const unsigned int first = points.first_point[c],
                           last  = points.first_point[c + 1];
        if (room.share < negligible_part)
          {
            std::fill(&points.weight[first], &points.weight[last - 1] + 1, 0.);
            continue;
          }
        const auto vertices = cell->vertex_indices();
        const bool is_inside =
          std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
            return is_surrounded[cell->vertex_index(v)];
          });
        if (room.share > 1. - negligible_part && !is_inside &&
            !(std::abs(room.filled - 1.) < 0.03))
          continue;
        CellIntegrals exact = integrate(mesh, space, cell, room.part);
        if (const auto beside = sliver_beside(cell, boundary, filled))
          {
            space.cell_nodes(cell, nodes);
            space.cell_nodes(*beside, nodes_beside);
            exact.add(integrate(mesh,
                                space,
                                *beside,
                                soil_part((*beside)->bounding_box(), boundary)),
                      nodes_beside,
                      nodes);
          }
        match_integrals(exact, c, room.filled * room.volume, points);
      }
  }
} // namespace geocone::GEOCONE_DIM
