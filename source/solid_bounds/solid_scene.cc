// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mesh/bisection.h>
#include <geocone/solid_bounds/solid_scene.h>

#include <geocone/mesh/empty_regions.h>
#include <deal.II/base/bounding_box.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  SolidScene::Load
  SolidScene::body_force(const unsigned int cell) const
  {
    const Tensor<1, dim> b =
      scene->density(tetrahedra->material[cell], tetrahedra->centre(cell)) *
      scene->gravity.at(std::numeric_limits<double>::max()) * units.length /
      units.stress;
    Load       load;
    const bool is_live =
      factor == LoadFactor::weight || factor == LoadFactor::all;
    (is_live ? load.live : load.dead) = b;
    if (scene->water.acts())
      (factor == factor_of_water(*scene) || factor == LoadFactor::all
         ? load.live
         : load.dead) += seepage_force(cell) * units.length / units.stress;
    return load;
  }

  bool
  SolidScene::is_without_traction(const unsigned int facet,
                                  const unsigned int vertex) const
  {
    const Load &load = traction_of_facet[facet][vertex];
    return tetrahedra->facets[facet].cells[1] == Tetrahedra::none &&
           facet_conditions[facet].kind == FacetCondition::Kind::free &&
           load.dead.norm() == 0. && load.live.norm() == 0.;
  }

  Tensor<1, dim>
  SolidScene::seepage_force(const unsigned int cell) const
  {
    // No cell crosses the water table, at which the first mesh is divided.
    const Water &water = scene->water;
    if (!water.varies_in_cells())
      return water.force(tetrahedra->centre(cell));
    const auto     g = tetrahedra->gradients(cell);
    Tensor<1, dim> force;
    for (unsigned int i = 0; i < 4; ++i)
      force -=
        water.pressure(tetrahedra->vertices[tetrahedra->cells[cell][i]]) * g[i];
    return force;
  }

  std::array<double, 4>
  SolidScene::strength_at_vertices(const unsigned int cell) const
  {
    std::array<double, 4> k;
    for (unsigned int i = 0; i < 4; ++i)
      k[i] = strengths[tetrahedra->material[cell]].k_at(
        tetrahedra->vertices[tetrahedra->cells[cell][i]]);
    return k;
  }

  void
  SolidLoad::take_strengths(const Scene &scene)
  {
    strengths     = spatial_strengths(scene);
    less_dilatant = std::any_of(
      strengths.begin(), strengths.end(), [](const SpatialStrength &one) {
        return !one.is_associated;
      });
  }

  namespace
  {
    FacetPlace
    place_of(const Tetrahedra &tetrahedra, const unsigned int facet)
    {
      FacetPlace place;
      place.normal = tetrahedra.normal(facet);
      for (unsigned int i = 0; i < dim; ++i)
        place.vertices[i] =
          tetrahedra.vertices[tetrahedra.facets[facet].vertices[i]];
      return place;
    }
  } // namespace

  std::vector<FacetCondition>
  SolidLoad::facet_conditions(const Scene      &scene,
                              const Tetrahedra &tetrahedra) const
  {
    std::vector<HeldComponents> all(tetrahedra.facets.size());
    for (const auto &condition : scene.dirichlet.list)
      for (const unsigned int f : tetrahedra.held_facets(*condition))
        all[f].add(*condition, place_of(tetrahedra, f));
    std::vector<FacetCondition> held;
    for (unsigned int f = 0; f < all.size(); ++f)
      held.push_back(all[f].condition(place_of(tetrahedra, f)));
    const std::vector<int> touched = obstacles_of_facets(scene, tetrahedra);
    for (unsigned int f = 0; f < held.size(); ++f)
      if (touched[f] >= 0)
        {
          const Obstacle &obstacle = *scene.obstacles.list[touched[f]];
          if (held[f].kind != FacetCondition::Kind::free)
            throw InputError(obstacle.parameter("Shape"),
                             obstacle.name,
                             "an obstacle beside sides without prescribed "
                             "velocities where loads are bounded",
                             "it touches a face whose velocity is prescribed: "
                             "leave one of them out there");
          held[f].kind     = FacetCondition::Kind::interface;
          held[f].velocity = obstacle.velocity(0.).centre;
          held[f].obstacle = touched[f];
        }
    return held;
  }

  CoarseMesh
  SolidLoad::divided_at_edges(const Scene      &scene,
                              const Tetrahedra &tetrahedra) const
  {
    using Kind = FacetCondition::Kind;
    const std::vector<FacetCondition> held =
      facet_conditions(scene, tetrahedra);
    return divided_between(
      tetrahedra, [&](const unsigned int f, const unsigned int g) {
        for (const unsigned int one : {f, g})
          if (tetrahedra.facets[one].cells[1] != Tetrahedra::none ||
              held[one].kind == Kind::fixed)
            return false;
        if (held[f].kind == Kind::free && held[g].kind == Kind::free)
          return true;
        return held[f].kind != held[g].kind &&
               std::abs(tetrahedra.normal(f) * tetrahedra.normal(g)) > 1e-6;
      });
  }

  void
  SolidLoad::choose_units(const Scene &scene, const Tetrahedra &tetrahedra)
  {
    double volume = 0.;
    units.stress  = 0.;
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      {
        volume += tetrahedra.volume(c);
        const unsigned int m = tetrahedra.material[c];
        for (const unsigned int v : tetrahedra.cells[c])
          {
            const double k = strengths[m].k_at(tetrahedra.vertices[v]);
            if (!(k > 0. || (k == 0. && strengths[m].a > 0.)))
              throw InputError("Materials/" + scene.materials.name(m) +
                                 "/Cohesion",
                               k < 0. ? "negative somewhere" : "0",
                               "> 0 Pa everywhere, or 0 with friction, where "
                               "loads are bounded in three dimensions",
                               "raise it, or give a friction angle");
            units.stress = std::max(units.stress, k);
          }
      }
    units.length = std::cbrt(volume) / 4.;
    // Soil that hardly has cohesion is pressed by its loads.
    const dealii::BoundingBox<dim> body(tetrahedra.vertices);
    double of_loads = stress_of_weight(scene, body.side_length(1));
    for (const auto &load : scene.tractions.list)
      for (const unsigned int f : tetrahedra.held_facets(*load))
        for (const Tensor<1, dim> &t :
             tractions_at_vertices(*load, place_of(tetrahedra, f), {}))
          of_loads = std::max(of_loads, t.norm());
    units.is_of_loads = of_loads / 8. > units.stress;
    units.stress      = std::max(units.stress, of_loads / 8.);
  }

  namespace
  {
    /** @throws InputError if a rigid motion of the body is free */
    void
    check_rigid_motions(const Scene                       &scene,
                        const Tetrahedra                  &tetrahedra,
                        const std::vector<FacetCondition> &held,
                        const double                       length)
    {
      // The part of a translation that supports and obstacles resist.
      const auto resisted = [&](const unsigned int    f,
                                const Tensor<1, dim> &e) -> Tensor<1, dim> {
        if (held[f].kind != FacetCondition::Kind::interface)
          return held[f].held_part(e);
        const Tensor<1, dim> n = tetrahedra.normal(f);
        return InterfaceStrength(scene.obstacles.list[held[f].obstacle]->law,
                                 1.)
                   .is_smooth()
                 ? (e * n) * n
                 : e;
      };
      Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
      const Point<dim>            centre  = tetrahedra.centre(0);
      for (unsigned int f = 0; f < held.size(); ++f)
        if (held[f].kind != FacetCondition::Kind::free)
          for (const unsigned int v : tetrahedra.facets[f].vertices)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const Tensor<1, dim> arm =
                  (tetrahedra.vertices[v] - centre) / length;
                const Tensor<1, dim> e =
                  resisted(f, Point<dim>::unit_vector(d));
                const Tensor<1, dim>        m = cross_product_3d(arm, e);
                Eigen::Matrix<double, 6, 1> row;
                row << e[0], e[1], e[2], m[0], m[1], m[2];
                squares += row * row.transpose();
              }
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
        squares);
      if (!(solver.eigenvalues()[0] > 1e-10 * solver.eigenvalues()[5]))
        throw InputError("Boundary conditions/Names",
                         "conditions that leave a rigid motion free",
                         "supports that hold the body against translation and "
                         "rotation",
                         "nothing resists a rigid motion of the body, so no "
                         "load has a limit: hold another side");
    }
  } // namespace

  void
  SolidLoad::prepare(const Scene &scene, const Tetrahedra &tetrahedra)
  {
    take_strengths(scene);
    const std::vector<FacetCondition> held =
      facet_conditions(scene, tetrahedra);
    choose(prescribed_velocity(held), scene.gravity.acts());
    refuse_pore_pressures(scene);
    check_loads(scene, tetrahedra, held);
  }

  void
  SolidLoad::prepare_reduction(const Scene &scene, const Tetrahedra &tetrahedra)
  {
    take_strengths(scene);
    check_reducible(scene, strengths);
    const std::vector<FacetCondition> held =
      facet_conditions(scene, tetrahedra);
    choose_all(prescribed_velocity(held).has_value(), "strength reduction");
    check_loads(scene, tetrahedra, held);
  }

  void
  SolidLoad::check_loads(const Scene                       &scene,
                         const Tetrahedra                  &tetrahedra,
                         const std::vector<FacetCondition> &held)
  {
    std::vector<unsigned int> n_cells(scene.materials.size());
    for (const unsigned int material : tetrahedra.material)
      ++n_cells[material];
    refuse_empty_regions(scene, n_cells);
    refuse_cut_cells(scene, tetrahedra);
    choose_units(scene, tetrahedra);
    check_rigid_motions(scene, tetrahedra, held, units.length);
    if (is_reaction())
      load_unit = units.stress * units.length * units.length *
                  std::abs(scene.observation.factor);
    const SolidScene bound   = on(scene, tetrahedra);
    bool             is_live = is_reaction(), is_dead = false;
    const auto       add = [&](const SolidScene::Load &one) {
      is_live = is_live || one.live.norm() > 0.;
      is_dead = is_dead || one.dead.norm() > 0.;
    };
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      add(bound.body_force(c));
    for (const auto &facet : bound.traction_of_facet)
      for (const auto &at_vertex : facet)
        add(at_vertex);
    if (!is_live)
      refuse_zero_load();
    if (!is_dead && std::all_of(strengths.begin(),
                                strengths.end(),
                                [](const SpatialStrength &one) {
                                  return one.k == 0. && one.growth.slope == 0.;
                                }))
      throw InputError("Materials/" + scene.materials.name(0) + "/Cohesion",
                       0,
                       "> 0 Pa for some material where no load is constant",
                       "without cohesion such loads have no factor: give a "
                       "small one, e.g. a thousandth of the weight times the "
                       "height, or bound the reaction to a velocity in soil "
                       "with weight");
  }

  SolidScene
  SolidLoad::on(const Scene &scene, const Tetrahedra &tetrahedra) const
  {
    SolidScene bound;
    bound.scene      = &scene;
    bound.tetrahedra = &tetrahedra;
    bound.factor     = factor();
    bound.units      = units;
    for (SpatialStrength one : strengths)
      {
        one.scale(units.stress);
        bound.strengths.push_back(one);
      }
    for (const auto &obstacle : scene.obstacles.list)
      bound.interfaces.emplace_back(obstacle->law, units.stress);
    bound.facet_conditions = facet_conditions(scene, tetrahedra);
    for (FacetCondition &facet : bound.facet_conditions)
      facet.velocity /= units.velocity;

    bound.traction_of_facet.resize(tetrahedra.facets.size());
    for (const auto &load : scene.tractions.list)
      for (const unsigned int f : tetrahedra.held_facets(*load))
        {
          const auto t = tractions_at_vertices(
            *load, place_of(tetrahedra, f), bound.facet_conditions[f]);
          const bool is_live =
            factor() == LoadFactor::tractions || factor() == LoadFactor::all;
          for (unsigned int i = 0; i < dim; ++i)
            {
              SolidScene::Load &own = bound.traction_of_facet[f][i];
              (is_live ? own.live : own.dead) += t[i] / units.stress;
            }
        }
    return bound;
  }

  SolidScene
  SolidLoad::reduced(const Scene      &scene,
                     const Tetrahedra &tetrahedra,
                     const double      F) const
  {
    SolidScene bound = on(scene, tetrahedra);
    for (unsigned int m = 0; m < strengths.size(); ++m)
      if (scene.materials[m].is_reduced())
        bound.strengths[m].reduce(F);
    return bound;
  }
} // namespace geocone::GEOCONE_DIM
