// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/conditions/moving_conditions.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Position relative to a panel of the body's boundary. */
    struct Seen
    {
      std::array<double, dim - 1> along;  ///< 0 to 1 within the panel
      double                      beyond; ///< outside the body (m)
      double                      length; ///< of its shortest edge (m)

      /** Whether it is only a short distance behind: farther away may be
       *  another part of the body. */
      bool
      is_close_behind() const
      {
        constexpr double rounding = 1e-9;
        return std::all_of(along.begin(),
                           along.end(),
                           [](const double s) {
                             return s > rounding && s < 1. - rounding;
                           }) &&
               beyond > rounding * length && beyond < length;
      }
    };

    Seen
    seen_from(const SidePart &panel, const Point<dim> &x)
    {
      const Tensor<1, dim> to = x - panel.corners[0], area = area_of(panel);
      Seen                 seen;
      seen.beyond = area * to / area.norm();
      seen.length = 1e300;
      // In the plane of a parallelogram, by the reciprocals of its edges.
      for (unsigned int k = 0; k + 1 < dim; ++k)
        {
          const Tensor<1, dim> edge = panel.edge(k);
          Tensor<1, dim>       dual = edge;
          if (dim == 3)
            {
              const Tensor<1, dim> other = panel.edge(dim - 2 - k);
              dual -= (edge * other) / other.norm_square() * other;
            }
          seen.along[k] = (to * dual) / (edge * dual);
          seen.length   = std::min(seen.length, edge.norm());
        }
      return seen;
    }

    /** Whether a condition prescribes the normal velocity of a panel. */
    bool
    holds_normal(const BoundaryCondition &condition, const SidePart &panel)
    {
      const Tensor<1, dim> area = area_of(panel);
      for (unsigned int d = 0; d < dim; ++d)
        if (!condition.components[d] && std::abs(area[d]) > 1e-6 * area.norm())
          return false;
      return true;
    }

    bool
    is_on_side(const BoundaryCondition &condition)
    {
      return condition.imposed_on() == Imposition::On::side;
    }

    /** Whether the side of a condition moves as prescribed: not that of a mean
     *  of all particles, which are free to deviate from it, and not through
     *  FLIP, which leaves the velocity of the grid free. */
    bool
    moves_as_prescribed(const BoundaryCondition &condition)
    {
      if (is_on_side(condition))
        return true;
      const Imposition &imposition = *condition.imposition.get();
      const auto        row_of     = [&](const unsigned int particle) {
        return imposition.share({particle, particle, 1., 1.}).row;
      };
      return !imposition.through_flip && row_of(0) != row_of(1); // in two cells
    }

    /** Panels whose corners have moved with the velocity of the grid.
     *  Collective. */
    std::vector<SidePart>
    moved_with_body(const std::vector<SidePart> &panels,
                    const BackgroundMesh        &mesh,
                    const Space                 &space,
                    const NodesWithMass         &has_mass,
                    const Vector                &v,
                    const double                 h)
    {
      constexpr double undivided = std::numeric_limits<double>::max();
      MovingSurface    surface(panels, undivided);
      surface.move(mesh, space, has_mass, v, h);
      // Of a panel in space: two triangles with its ends.
      const std::vector<SidePart> facets   = surface.facets();
      constexpr unsigned int      n_facets = dim - 1;
      std::vector<SidePart>       moved;
      for (std::size_t i = 0; i < facets.size(); i += n_facets)
        {
          const auto &first = facets[i].corners,
                     &last  = facets[i + n_facets - 1].corners;
          std::array<Point<dim>, dim> ends;
          ends[0]       = first[0];
          ends[1]       = first[1];
          ends[dim - 1] = last.back();
          moved.push_back(spanned_by(ends));
        }
      return moved;
    }
  } // namespace

  MovingConditions::MovingConditions(const Scene          &scene,
                                     const BackgroundMesh &mesh,
                                     const Space          &space)
    : scene(scene)
    , mesh(mesh)
    , space(space)
    , is_active(scene.dirichlet.acting_in(scene.loading.list.front()->name))
    , tractions(scene, mesh, space)
  {
    const auto &list = scene.dirichlet.list;
    for (unsigned int c = 0; c < list.size(); ++c)
      if (list[c]->moves_with_body())
        {
          std::vector<SidePart> panels = // also checks the names
            segments_of_body(*list[c], scene.geometry);
          if (!moves_as_prescribed(*list[c]))
            continue;
          if (is_on_side(*list[c]))
            shorten(*list[c], panels);
          supports.push_back({c, panels});
        }
  }

  void
  MovingConditions::shorten(const BoundaryCondition &condition,
                            std::vector<SidePart>   &panels) const
  {
    if (condition.shortening == 0.)
      return;
    for (SidePart &panel : panels)
      {
        UnitPart rest;
        for (unsigned int k = 0; k + 1 < dim; ++k)
          {
            rest.lower[k] = condition.shortening / 2. *
                            cell_size_along(mesh, panel, k) /
                            panel.edge(k).norm();
            rest.upper[k] = 1. - rest.lower[k];
            if (rest.lower[k] >= rest.upper[k])
              throw InputError(condition.parameter("Segment shortening"),
                               condition.shortening,
                               "less than the side has cells",
                               "take smaller cells or a smaller number");
          }
        panel = part_of(panel, rest);
      }
  }

  std::vector<double>
  MovingConditions::sum_prescribed(const MaterialPoints &points) const
  {
    std::vector<double> sum(scene.dirichlet.list.size());
    for (unsigned int p = 0; p < points.held_by.size(); ++p)
      if (const unsigned int held = points.held_by[p]; held > 0)
        sum[held - 1] += mesh.measure(points.position[p]);
    sum_over_ranks(sum, mesh.triangulation().get_communicator());
    return sum;
  }

  void
  MovingConditions::check_held_particles(const MaterialPoints &points) const
  {
    const std::vector<double> of_conditions = sum_prescribed(points);
    for (unsigned int c = 0; c < of_conditions.size(); ++c)
      if (const BoundaryCondition &condition = *scene.dirichlet.list[c];
          condition.imposed_on() == Imposition::On::particles &&
          of_conditions[c] == 0.)
        throw InputError(condition.parameter("Box"),
                         condition.part(),
                         "a part of a side with particles under it",
                         "this condition holds no particle: check its sides "
                         "and its box");
  }

  void
  MovingConditions::add_rows_of_sides(const double t, Multipliers &rows) const
  {
    for (const PrescribedSide &side : supports)
      {
        const BoundaryCondition &condition =
          *scene.dirichlet.list[side.condition];
        if (!is_active[side.condition] || !is_on_side(condition))
          continue;
        std::array<unsigned int, dim - 1> n;
        n.fill(condition.n_segments);
        std::vector<double>     part_in_mesh;
        std::vector<Point<dim>> middles;
        unsigned int            number = 0;
        for (const SidePart &panel : side.panels)
          for (const SidePart &segment : parts_of(panel, n))
            {
              part_in_mesh.push_back(0.);
              // In axisymmetric problems the mean is over the area; there is
              // none on the axis.
              middles.push_back(segment.middle());
              const double mean_measure = mesh.measure(middles.back());
              for (const BoundaryPoint &point : points_on(mesh, space, segment))
                {
                  part_in_mesh.back() += point.weight;
                  const double relative =
                    mean_measure > 0.
                      ? mesh.measure(point.position) / mean_measure
                      : 1.;
                  add_to_row(side.condition,
                             {number, point.weight * relative},
                             point.position,
                             t,
                             point.nodes,
                             point.values.data(),
                             rows);
                }
              ++number;
            }
        check_in_mesh(condition,
                      middles,
                      part_in_mesh,
                      mesh.triangulation().get_communicator());
      }
  }

  void
  MovingConditions::add_rows_of_particles(const MaterialPoints &points,
                                          const double          t,
                                          const Transfer       &transfer,
                                          Multipliers          &rows) const
  {
    const auto &conditions = scene.dirichlet.list;
    if (std::none_of(
          conditions.begin(), conditions.end(), [](const auto &condition) {
            return condition->imposed_on() == Imposition::On::particles;
          }))
      return;
    const std::vector<double>            of_conditions = sum_prescribed(points);
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  of_cell(conditions.size());
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        std::fill(of_cell.begin(), of_cell.end(), 0.);
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          if (const unsigned int held = points.held_by[p];
              held > 0 && is_active[held - 1])
            of_cell[held - 1] += mesh.measure(points.position[p]);
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          if (const unsigned int held = points.held_by[p];
              held > 0 && is_active[held - 1])
            {
              const double            size = mesh.measure(points.position[p]);
              const Imposition::Share share =
                conditions[held - 1]->imposition.get()->share(
                  {points.id[p],
                   static_cast<unsigned int>(
                     points.cells[c]->global_active_cell_index()),
                   size / of_cell[held - 1],
                   size / of_conditions[held - 1]});
              space.cell_nodes(points.cells[c], nodes);
              const bool through_flip =
                conditions[held - 1]->imposition.get()->through_flip;
              add_to_row(held - 1,
                         share,
                         points.position[p],
                         through_flip ? transfer.t_end : t,
                         nodes,
                         &points.values[p * points.n_nodes],
                         rows);
              if (through_flip)
                add_flip_offsets(points, p, share, nodes, transfer, rows);
            }
      }
  }

  void
  MovingConditions::add_to_row(
    const unsigned int                          c,
    const Imposition::Share                    &share,
    const Point<dim>                           &x,
    const double                                t,
    const std::vector<types::global_dof_index> &nodes,
    const double                               *values,
    Multipliers                                &rows) const
  {
    const BoundaryCondition &condition = *scene.dirichlet.list[c];
    for (unsigned int d = 0; d < dim; ++d)
      if (condition.components[d])
        {
          const Multipliers::Key key{c, d, share.row};
          for (unsigned int i = 0; i < nodes.size(); ++i)
            rows.add_coefficient(key, nodes[i], share.weight * values[i]);
          rows.add_target(key,
                          share.weight * condition.components[d]->value(x, t));
        }
  }

  void
  MovingConditions::add_flip_offsets(
    const MaterialPoints                       &points,
    const unsigned int                          p,
    const Imposition::Share                    &share,
    const std::vector<types::global_dof_index> &nodes,
    const Transfer                             &transfer,
    Multipliers                                &rows) const
  {
    const double *const N = &points.values[p * points.n_nodes];
    Tensor<1, dim>      L; // N v^L
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        L[d] += N[i] * transfer.velocity_L.local_element(
                         dim * space.local_node(nodes[i]) + d);
    const unsigned int       c         = points.held_by[p] - 1;
    const BoundaryCondition &condition = *scene.dirichlet.list[c];
    for (unsigned int d = 0; d < dim; ++d)
      if (condition.components[d])
        {
          const double prescribed =
            condition.components[d]->value(points.position[p], transfer.t_end);
          const double end = // N v_end
            prescribed - transfer.flip_part * (points.velocity[p][d] - L[d]);
          rows.add_offset({c, d, share.row},
                          share.weight *
                            (L[d] + transfer.part * (end - L[d]) - prescribed));
        }
  }

  void
  MovingConditions::make_rows(const MaterialPoints &points,
                              const Vector         &prescribed,
                              const double          t,
                              const Transfer       &transfer,
                              Constraints          &constraints) const
  {
    Multipliers &rows = constraints.multipliers;
    rows.clear();
    add_rows_of_sides(t, rows);
    add_rows_of_particles(points, t, transfer, rows);
    const auto refusal = rows.assemble(space, constraints, prescribed);
    if (!refusal)
      return;
    const BoundaryCondition &condition =
      *scene.dirichlet.list[refusal->key.condition];
    if (!refusal->is_supported)
      throw InputError(
        condition.parameter("Box"),
        condition.part(),
        "a part of a side with particles near it",
        "no function with mass supports the constraint: check "
        "its sides and its box, or whether the body has left it");
    const unsigned int component = refusal->key.component;
    throw InputError(
      condition.parameter(std::string("Velocity ") + coordinate[component]),
      condition.formula(component),
      "velocities that the functions of the space can take",
      format("its rows depend on each other but contradict: %g "
             "m/s is asked where the others leave %g m/s; impose "
             "segments or cell averages, or a velocity that is "
             "the same for all its points",
             refusal->prescribed,
             refusal->implied));
  }

  void
  MovingConditions::move(const NodesWithMass &has_mass,
                         const Vector        &v,
                         const double         h,
                         const double         t)
  {
    for (PrescribedSide &side : supports)
      {
        side.before = side.panels;
        if (!is_active[side.condition])
          {
            side.panels =
              moved_with_body(side.panels, mesh, space, has_mass, v, h);
            continue;
          }
        for (SidePart &panel : side.panels)
          {
            auto ends = ends_of(panel);
            for (Point<dim> &x : ends)
              for (unsigned int d = 0; d < dim; ++d)
                if (const auto &q =
                      scene.dirichlet.list[side.condition]->components[d])
                  x[d] += h * q->value(x, t);
            panel = spanned_by(ends);
          }
      }
    tractions.move(has_mass, v, h);
  }

  std::vector<bool>
  MovingConditions::loaded_nodes() const
  {
    if (supports.empty() && !tractions.exist())
      return {};
    Vector     mark(space.partitioner());
    const auto mark_nodes = [&](const BoundaryPoint &point) {
      for (unsigned int i = 0; i < point.nodes.size(); ++i)
        if (point.values[i] > 0.)
          mark.local_element(dim * space.local_node(point.nodes[i])) += 1.;
    };
    for (const PrescribedSide &side : supports)
      for (const SidePart &panel : side.panels)
        if (is_active[side.condition])
          for (const BoundaryPoint &point : points_on(mesh, space, panel))
            mark_nodes(point);
    tractions.for_each_loaded_point(mark_nodes);
    mark.compress(VectorOperation::add);
    mark.update_ghost_values();
    std::vector<bool> is_loaded(space.n_local_nodes());
    for (unsigned int node = 0; node < is_loaded.size(); ++node)
      is_loaded[node] = mark.local_element(dim * node) > 0.;
    return is_loaded;
  }

  std::optional<Point<dim>>
  MovingConditions::return_to_boundary(const Point<dim> &before,
                                       const Point<dim> &after) const
  {
    std::optional<Point<dim>> place;
    for (const PrescribedSide &side : supports)
      for (unsigned int l = 0; l < side.panels.size(); ++l)
        {
          const SidePart          &panel = side.panels[l];
          const Seen               now   = seen_from(panel, after);
          const BoundaryCondition &condition =
            *scene.dirichlet.list[side.condition];
          if (!now.is_close_behind() || !is_active[side.condition] ||
              !is_on_side(condition) || !holds_normal(condition, panel))
            continue;
          const Seen was = seen_from(side.before[l], before);
          if (was.is_close_behind())
            continue;
          Point<dim> here        = after;
          bool       from_beside = false;
          for (unsigned int k = 0; k + 1 < dim; ++k)
            if (was.along[k] <= 0. || was.along[k] >= 1.)
              {
                const double end = was.along[k] <= 0. ? 0. : 1.;
                here += (end - now.along[k]) * panel.edge(k);
                from_beside = true;
              }
          if (!from_beside)
            {
              const Tensor<1, dim> area = area_of(panel);
              here -= now.beyond / area.norm() * area;
            }
          if (!place || here.distance(after) < place->distance(after))
            place = here;
        }
    return place;
  }

  unsigned int
  MovingConditions::n_penetrated(const MaterialPoints &points) const
  {
    if (supports.empty())
      return 0;
    unsigned int n = 0;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        bool behind = false;
        for (const PrescribedSide &side : supports)
          for (const SidePart &panel : side.panels)
            {
              const BoundaryCondition &condition =
                *scene.dirichlet.list[side.condition];
              const Seen seen = seen_from(panel, points.position[p]);
              behind =
                behind ||
                (is_active[side.condition] && is_on_side(condition) &&
                 seen.is_close_behind() &&
                 seen.beyond > 0.1 * scene.geometry.size_of_point(
                                       points.position[p], points.volume[p]) &&
                 holds_normal(condition, panel));
            }
        n += behind;
      }
    return Utilities::MPI::sum(n, mesh.triangulation().get_communicator());
  }

  SoilBoundary
  MovingConditions::soil_boundary() const
  {
    SoilBoundary boundary;
    for (const PrescribedSide &side : supports)
      for (const SidePart &panel : side.panels)
        {
          const Tensor<1, dim> area = area_of(panel);
          for (unsigned int d = 0; d < dim; ++d)
            if (is_active[side.condition] &&
                std::abs(area[d]) > (1. - 1e-9) * area.norm() &&
                holds_normal(*scene.dirichlet.list[side.condition], panel))
              boundary.limits.push_back({d,
                                         panel.corners[0][d],
                                         area[d] > 0.,
                                         BoundingBox<dim>(panel.corners)});
        }
    boundary.loaded = tractions.facets_with_soil();
    return boundary;
  }

  void
  MovingConditions::state(StateRow &row)
  {
    for (PrescribedSide &side : supports)
      for (SidePart &panel : side.panels)
        {
          auto ends = ends_of(panel);
          for (Point<dim> &x : ends)
            row(x);
          panel = spanned_by(ends);
        }
    tractions.state(row);
  }

  std::pair<Point<dim>, Point<dim>>
  MovingConditions::box_of(const BoundaryCondition &condition) const
  {
    std::vector<Point<dim>> corners;
    for (const PrescribedSide &side : supports)
      if (scene.dirichlet.list[side.condition].get() == &condition)
        for (const SidePart &panel : side.panels)
          for (const Point<dim> &x : panel.corners)
            corners.push_back(x);
    return BoundingBox<dim>(corners).get_boundary_points();
  }
} // namespace geocone::GEOCONE_DIM
