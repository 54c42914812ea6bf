// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_points.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/bounds/load_choice.h>
#include <geocone/plane_bounds/bound_loads.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using bernstein::Linear;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Radius in units of length; that of vertices on the axis is exactly zero. */
    double
    scaled_radius(const Point<dim> &x, const double unit)
    {
      const double r = x[0] / unit;
      return r < 1e-12 ? 0. : r;
    }

    /** @throws InputError for a condition on the axis that holds more than the
     *  radius */
    void
    check_condition_on_axis(const BoundaryCondition &condition,
                            const FacetPlace        &place)
    {
      for (const Point<dim> &x : place.vertices)
        if (condition.components[1] ||
            (condition.components[0] &&
             condition.components[0]->value(x, 0.) != 0.))
          throw InputError(condition.parameter("Sides"),
                           condition.part(),
                           "Velocity x = 0 alone on the axis, where loads are "
                           "bounded",
                           "the axis has no area: hold another side");
    }
  } // namespace

  AxisymmetricScene::AxisymmetricScene(const BoundScene &bound)
    : bound(bound)
  {
    const Triangles &triangles = bound.triangles;
    const Scene     &scene     = bound.scene;
    const double     L         = bound.units.length;
    const auto       is_live   = [&](const LoadFactor kind) {
      return bound.factor == kind || bound.factor == LoadFactor::all;
    };
    edges.resize(triangles.edges.size());
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      {
        Cell cell;
        cell.area      = triangles.area(c) / (L * L);
        cell.gradients = triangles.gradients(c);
        for (unsigned int i = 0; i < 3; ++i)
          {
            cell.gradients[i] *= L;
            const Point<dim> &x = triangles.vertices[triangles.cells[c][i]];
            cell.radius[i]      = scaled_radius(x, L);
            cell.strength[i]    = positive_strength(
              scene, bound.strengths, triangles.material[c], x);
            Edge &edge = edges[triangles.edges_of_cell[c][i]];
            if (edge.cells[0] == Edge::none)
              edge.normal = -cell.gradients[i] / cell.gradients[i].norm();
            edge.cells[edge.cells[0] == Edge::none ? 0 : 1] = c;
          }
        const Tensor<1, dim> weight = weight_of_cell(bound, c);
        if (weight[0] != 0.)
          throw InputError("Gravity/Acceleration",
                           scene.gravity.at(0.)[0],
                           "0 along x where loads are bounded around an axis",
                           "let the weight act along the axis");
        (is_live(LoadFactor::weight) ? cell.body_force.live
                                     : cell.body_force.dead) = weight;
        if (scene.water.acts())
          (is_live(factor_of_water(scene)) ? cell.body_force.live
                                           : cell.body_force.dead) +=
            seepage_force_of_cell(bound, c);
        cells.push_back(cell);
      }
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        const FacetPlace place = place_of(e);
        edges[e].length = place.vertices[0].distance(place.vertices[1]) / L;
        for (unsigned int i = 0; i < 2; ++i)
          edges[e].radius[i] = scaled_radius(place.vertices[i], L);
      }

    std::vector<HeldComponents> held(edges.size());
    for (const auto &condition : scene.dirichlet.list)
      for (const auto &of : triangles.held_edges(*condition))
        if (edges[of.edge].is_on_axis())
          check_condition_on_axis(*condition, place_of(of.edge));
        else
          held[of.edge].add(*condition, place_of(of.edge));
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        edges[e].condition = held[e].condition(place_of(e));
        edges[e].condition.velocity /= bound.units.velocity;
      }
    for (const auto &load : scene.tractions.list)
      add_traction(*load, is_live(LoadFactor::tractions));
  }

  FacetPlace
  AxisymmetricScene::place_of(const unsigned int edge) const
  {
    FacetPlace place;
    place.normal = edges[edge].normal;
    for (unsigned int i = 0; i < 2; ++i)
      place.vertices[i] =
        bound.triangles.vertices[bound.triangles.edges[edge].vertices[i]];
    return place;
  }

  void
  AxisymmetricScene::add_traction(const BoundaryCondition &load,
                                  const bool               is_live)
  {
    for (const auto &of : bound.triangles.held_edges(load))
      {
        Edge &edge = edges[of.edge];
        if (edge.is_on_axis())
          continue;
        const auto t =
          tractions_at_vertices(load, place_of(of.edge), edge.condition);
        for (unsigned int i = 0; i < 2; ++i)
          (is_live ? edge.traction[i].live : edge.traction[i].dead) +=
            t[i] / bound.units.stress;
      }
  }

  AxisymmetricScene
  AxisymmetricScene::without_loads() const
  {
    AxisymmetricScene scene = *this;
    for (Cell &cell : scene.cells)
      cell.body_force = Load();
    for (Edge &edge : scene.edges)
      edge.traction = {};
    return scene;
  }

  AxisymmetricScene
  AxisymmetricScene::with_weight_of(const unsigned int material) const
  {
    AxisymmetricScene scene = without_loads();
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (bound.triangles.material[c] == material)
        scene.cells[c].body_force.live = weight_of_cell(bound, c);
    return scene;
  }

  AxisymmetricScene
  AxisymmetricScene::with_traction(const BoundaryCondition &load) const
  {
    AxisymmetricScene scene = without_loads();
    scene.add_traction(load, true);
    return scene;
  }

  void
  AxisymmetricScene::check_support() const
  {
    if (std::none_of(edges.begin(), edges.end(), [](const Edge &edge) {
          return edge.condition.holds(1);
        }))
      throw InputError("Boundary conditions/Names",
                       "conditions that leave the motion along the axis free",
                       "a support with Velocity y",
                       "nothing resists a translation of the body along y, so "
                       "no load has a limit: hold another side");
  }

  bool
  AxisymmetricScene::has_live_load() const
  {
    return std::any_of(cells.begin(),
                       cells.end(),
                       [](const Cell &cell) {
                         return cell.body_force.live.norm() > 0.;
                       }) ||
           std::any_of(edges.begin(), edges.end(), [](const Edge &edge) {
             return edge.traction[0].live.norm() +
                      edge.traction[1].live.norm() >
                    0.;
           });
  }

  const SpatialStrength &
  AxisymmetricScene::strength_of_jump(const unsigned int edge,
                                      Linear<2>         &cohesion) const
  {
    const auto strength_of = [&](const unsigned int cell) -> const auto &
    {
      return bound.strengths[bound.triangles.material[cell]];
    };
    const auto of_face = [&](const unsigned int cell) {
      return strength_of(cell).face_cohesion_per_k() * strength_of(cell).k;
    };
    const auto &[first, second] = edges[edge].cells;
    const SpatialStrength &one  = strength_of(
      second != Edge::none && of_face(second) < of_face(first) ? second
                                                               : first);
    for (unsigned int i = 0; i < 2; ++i)
      cohesion[i] =
        one.face_cohesion_per_k() *
        one.k_at(
          bound.triangles.vertices[bound.triangles.edges[edge].vertices[i]]);
    return one;
  }

  ConicProblem
  forces_of(const AxisymmetricScene &scene, const BoundSide side)
  {
    return side == BoundSide::upper ? upper_forces(scene) : lower_forces(scene);
  }
} // namespace geocone::GEOCONE_DIM
