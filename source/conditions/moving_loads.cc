// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/conditions/moving_loads.h>

#include <algorithm>
#include <optional>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Part of a facet or segment that was not found. */
    struct MissingPart
    {
      double      percent;
      std::string place; ///< of its middle
    };

    /** Finds the facet or segment with the least part found, if a part is missing.
     *  Collective. @param found fraction of each one that this rank found */
    std::optional<MissingPart>
    missing_part(const std::vector<Point<dim>> &middles,
                 std::vector<double>            found,
                 const MPI_Comm                 comm)
    {
      sum_over_ranks(found, comm);
      const auto least = std::min_element(found.begin(), found.end());
      if (!(*least < 1. - 1e-6))
        return std::nullopt;
      return MissingPart{100. * (1. - *least),
                         text_of_place(middles[least - found.begin()])};
    }

    /** Checks that functions with mass carry the facets of a traction. Collective.
     *  @param carried fraction of each facet on this rank with such functions or
     *  without load
     *  @throws StepFailure if a facet has none */
    void
    check_on_soil(const BoundaryCondition       &load,
                  const std::vector<Point<dim>> &middles,
                  std::vector<double>            carried,
                  const MPI_Comm                 comm)
    {
      if (const auto missing = missing_part(middles, std::move(carried), comm))
        throw StepFailure(format(
          "the side of '%s' has left the particles: no function with mass "
          "carries %.3g %% of its part around (%s)\n"
          "  remedy:  smaller steps, or B-splines, which reach farther",
          load.name.c_str(),
          missing->percent,
          missing->place.c_str()));
    }
  } // namespace

  void
  check_in_mesh(const BoundaryCondition       &condition,
                const std::vector<Point<dim>> &middles,
                std::vector<double>            in_mesh,
                const MPI_Comm                 comm)
  {
    if (const auto missing = missing_part(middles, std::move(in_mesh), comm))
      throw StepFailure(
        format("the side of '%s' has left the background mesh: %.3g %% of its "
               "part around (%s) is outside\n"
               "  remedy:  a larger Mesh/Box, so that the side stays in it",
               condition.name.c_str(),
               missing->percent,
               missing->place.c_str()));
  }

  MovingLoads::MovingLoads(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space)
    : scene(scene)
    , mesh(mesh)
    , space(space)
  {
    const auto &tractions = scene.tractions.list;
    for (unsigned int c = 0; c < tractions.size(); ++c)
      {
        const std::vector<SidePart> panels =
          segments_of_body(*tractions[c], scene.geometry);
        double size = 0.;
        for (const SidePart &panel : panels)
          for (unsigned int k = 0; k + 1 < dim; ++k)
            size = std::max(size, cell_size_along(mesh, panel, k));
        loads.push_back({c, MovingSurface(panels, size)});
        loads.back().surface.remove(
          [&](const Point<dim> &x) {
            return scene.loading.adds(
              scene.materials.name(scene.regions.material_at(x)));
          },
          0.,
          0.);
      }
  }

  void
  MovingLoads::remove(const Stage &stage, const double t, const double duration)
  {
    for (LoadedSide &side : loads)
      side.surface.remove(
        [&](const Point<dim> &x) { return stage.removes(x); }, t, duration);
  }

  void
  MovingLoads::add(const unsigned int material)
  {
    for (LoadedSide &side : loads)
      side.surface.add([&](const Point<dim> &x) {
        return scene.regions.material_at(x) == material;
      });
  }

  Tensor<1, dim>
  MovingLoads::traction_at(const BoundaryCondition &load,
                           const double             size,
                           const Tensor<1, dim>    &area,
                           const Point<dim>        &x,
                           const double             t) const
  {
    // Dead loads are per initial size.
    Tensor<1, dim> f;
    for (unsigned int d = 0; d < dim; ++d)
      if (const auto &traction = load.components[d])
        f[d] = traction->value(x, t) * size;
    // Pressure acts on the current boundary.
    if (load.normal || load.tangential)
      f += area.norm() * load.vector_on_side(x, area / area.norm(), t);
    return f * mesh.measure(x); // around an axis, current radius
  }

  void
  MovingLoads::add_forces(Vector              &force,
                          const NodesWithMass &has_mass,
                          const double         t,
                          const Stage         *stage,
                          const bool           scaled) const
  {
    const MPI_Comm      comm = mesh.triangulation().get_communicator();
    std::vector<double> N;
    for (const auto &[condition, surface] : loads)
      {
        const BoundaryCondition &load = *scene.tractions.list[condition];
        const bool               is_active =
          stage == nullptr || stage->scales(load.name) == scaled;
        const std::vector<SidePart> facets = surface.facets();
        std::vector<double>         carried(facets.size(), 0.);
        const auto add = [&, &surface = surface](const std::size_t    number,
                                                 const BoundaryPoint &point) {
          const double   left = surface.part_left(number, t);
          Tensor<1, dim> f;
          if (is_active && left > 0.)
            f = left * traction_at(load,
                                   surface.size_at_start(number),
                                   area_of(facets[number]),
                                   point.position,
                                   t);
          N = point.values;
          if (f.norm() > 0. && has_mass &&
              !keep_nodes_with_mass(space, has_mass, point.nodes, N))
            return;
          carried[number] += point.weight;
          for (unsigned int i = 0; i < point.nodes.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              force.local_element(dim * space.local_node(point.nodes[i]) + d) +=
                point.weight * N[i] * f[d];
        };
        std::vector<double> parts = for_each_point(mesh, space, facets, add);
        std::vector<Point<dim>> middles;
        for (std::size_t i = 0; i < facets.size(); ++i)
          {
            middles.push_back(facets[i].middle());
            if (!(surface.part_left(i, t) > 0.)) // may be anywhere
              parts[i] = carried[i] = 1.;
          }
        check_in_mesh(load, middles, parts, comm);
        if (has_mass)
          check_on_soil(load, middles, carried, comm);
      }
    if (!loads.empty())
      force.compress(VectorOperation::add);
  }

  void
  MovingLoads::move(const NodesWithMass &has_mass,
                    const Vector        &v,
                    const double         h)
  {
    for (LoadedSide &side : loads)
      side.surface.move(mesh, space, has_mass, v, h);
  }

  void
  MovingLoads::for_each_loaded_point(
    const std::function<void(const BoundaryPoint &)> &f) const
  {
    for (const LoadedSide &side : loads)
      for_each_point(
        mesh,
        space,
        side.surface.facets_with_soil(),
        [&](const std::size_t, const BoundaryPoint &point) { f(point); });
  }

  std::vector<SidePart>
  MovingLoads::facets_with_soil() const
  {
    std::vector<SidePart>         all;
    std::set<std::vector<double>> seen; // corners of facets
    for (const LoadedSide &side : loads)
      for (SidePart &facet : side.surface.facets_with_soil())
        {
          std::vector<double> places;
          for (const Point<dim> &corner : facet.corners)
            places.insert(places.end(), corner.begin_raw(), corner.end_raw());
          if (seen.insert(places).second)
            all.push_back(std::move(facet));
        }
    return all;
  }

  void
  MovingLoads::state(StateRow &row)
  {
    for (LoadedSide &side : loads)
      side.surface.state(row);
  }
} // namespace geocone::GEOCONE_DIM
