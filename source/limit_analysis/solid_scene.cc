// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/limit_analysis/solid_scene.h>
#include <geocone/materials/drucker_prager.h>
#include <geocone/materials/spatial_mohr_coulomb.h>
#include <geocone/mesh/empty_regions.h>

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
    // No cell crosses the water table, at which the first mesh is divided.
    if (scene->water.acts())
      (factor == LoadFactor::all ? load.live : load.dead) +=
        scene->water.force(tetrahedra->centre(cell)) * units.length /
        units.stress;
    return load;
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

  namespace
  {
    /** Takes the tensile strength of a material. Beyond the apex of the pyramid it may
     *  count once the strength is reduced. */
    void
    take_tension(SolidStrength            &one,
                 const FrictionalStrength &given,
                 const std::string        &section)
    {
      if (!std::isfinite(given.tension))
        return;
      const std::string parameter = section + "/Tensile strength";
      if (given.tension == 0.)
        throw InputError(parameter,
                         0,
                         "none, or > 0 Pa where loads are bounded",
                         "free surfaces would be at their strength whatever "
                         "the load: give a small one, e.g. a hundredth of the "
                         "cohesion");
      if (given.gradient != 0.)
        throw InputError(parameter,
                         given.tension,
                         "none beside a 'Cohesion gradient' where loads are "
                         "bounded in three dimensions",
                         "take layers instead of the gradient");
      one.tension = given.tension;
    }
  } // namespace

  void
  SolidLoad::take_strengths(const Scene &scene)
  {
    strengths.clear();
    less_dilatant = false;
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const Material   &law     = scene.materials[m];
        const std::string section = "Materials/" + scene.materials.name(m);
        SolidStrength     one;
        if (const auto *pyramid =
              dynamic_cast<const SpatialMohrCoulomb *>(&law))
          {
            const FrictionalStrength given = *pyramid->plane_strain_strength();
            const double             phi   = radians(given.phi);
            one.a                          = std::sin(phi);
            one.k                          = 2. * given.c * std::cos(phi);
            one.growth = {2. * given.gradient * std::cos(phi), given.level};
            take_tension(one, given, section);
            less_dilatant = less_dilatant || given.theta < given.phi;
          }
        else if (const auto *circular =
                   dynamic_cast<const DruckerPrager *>(&law))
          {
            const FlowCone cone = *circular->flow_cone(nullptr);
            one.is_circular     = true;
            one.a               = cone.a;
            one.k               = cone.k;
            less_dilatant = less_dilatant || cone.b < cone.a * (1. - 1e-12);
            if (law.n_history() > 0)
              throw InputError(section + "/Cohesion gradient",
                               "a cohesion that varies",
                               "a constant one with Drucker-Prager or von "
                               "Mises where loads are bounded",
                               "take Mohr-Coulomb or Tresca, or layers");
            if (!(cone.a < 0.7))
              throw InputError(section + "/Friction angle",
                               "a cone as wide as this",
                               "a < 0.7 of the cone |s_t| <= a s_n + k where "
                               "loads are bounded",
                               "jumps of velocities are then not admissible; "
                               "take Mohr-Coulomb, or another 'Match'");
          }
        else
          throw InputError(section + "/Type",
                           ParameterFile::value(section + "/Type"),
                           "Mohr-Coulomb | Tresca | Drucker-Prager | von Mises "
                           "where loads are bounded",
                           "bounds are those of these laws; what cannot yield "
                           "carries any load: leave it out of the domain");
        if (law.hardens())
          throw InputError(section + "/Type",
                           "a law that hardens",
                           "Mohr-Coulomb | Tresca | Drucker-Prager | von Mises "
                           "where loads are bounded",
                           "take the strength that counts, initial or final");
        if (const std::string formula = law.strength_formula();
            !formula.empty())
          throw InputError(section + "/" + formula,
                           "set",
                           "a 'Cohesion gradient' where loads are bounded",
                           "strength is to be linear in each tetrahedron: give "
                           "a gradient, or layers");
        strengths.push_back(one);
      }
  }

  std::vector<FacetCondition>
  SolidLoad::facet_conditions(const Scene      &scene,
                              const Tetrahedra &tetrahedra) const
  {
    struct Components
    {
      std::array<std::optional<double>, dim> value;
      const BoundaryCondition               *last = nullptr;
    };
    std::vector<Components> all(tetrahedra.facets.size());
    for (const auto &condition : scene.dirichlet.list)
      for (const unsigned int f : tetrahedra.held_facets(*condition))
        {
          Components &own = all[f];
          own.last        = &*condition;
          const auto add  = [&](const unsigned int d, const double v) {
            if (own.value[d] &&
                std::abs(*own.value[d] - v) > 1e-12 * std::abs(v))
              throw InputError(condition->parameter("Sides"),
                               condition->part(),
                               "one prescribed velocity where loads are "
                                "bounded",
                               "two conditions differ on a face of the mesh: "
                                "leave one of them out there");
            own.value[d] = v;
          };
          for (unsigned int d = 0; d < dim; ++d)
            if (condition->components[d])
              {
                std::array<double, 3> v;
                for (unsigned int i = 0; i < 3; ++i)
                  v[i] = condition->components[d]->value(
                    tetrahedra.vertices[tetrahedra.facets[f].vertices[i]], 0.);
                for (unsigned int i = 1; i < 3; ++i)
                  if (std::abs(v[i] - v[0]) > 1e-12 * std::abs(v[0]))
                    throw InputError(
                      condition->parameter(std::string("Velocity ") + "xyz"[d]),
                      condition->formula(d),
                      "one velocity for all that is pushed where loads are "
                      "bounded",
                      "the bounded load is the reaction to one translation");
                add(d, v[0]);
              }
          if (condition->normal)
            {
              const Tensor<1, dim> n = tetrahedra.normal(f);
              const double         v = condition->normal->value(
                tetrahedra.vertices[tetrahedra.facets[f].vertices[0]], 0.);
              if (v != 0.)
                throw InputError(condition->parameter("Velocity normal"),
                                 condition->formula(dim),
                                 "0 where loads are bounded",
                                 "push by Velocity x, y or z");
              bool is_along = false;
              for (unsigned int d = 0; d < dim; ++d)
                if (std::abs(n[d]) > 1. - 1e-12)
                  {
                    is_along = true;
                    add(d, 0.);
                  }
              if (!is_along)
                throw InputError(condition->parameter("Velocity normal"),
                                 0,
                                 "a plane normal to an axis where loads are "
                                 "bounded in three dimensions",
                                 "turn the body, or hold all components there");
            }
        }

    std::vector<FacetCondition> held(all.size());
    for (unsigned int f = 0; f < all.size(); ++f)
      {
        unsigned int n_held = 0, axis = 0;
        for (unsigned int d = 0; d < dim; ++d)
          if (all[f].value[d])
            {
              ++n_held;
              axis                = d;
              held[f].velocity[d] = *all[f].value[d];
            }
        if (n_held == 0)
          continue;
        held[f].kind = n_held == dim ? FacetCondition::Kind::fixed
                                     : FacetCondition::Kind::plane;
        held[f].axis = axis;
        if (n_held == dim)
          continue;
        if (n_held > 1 || std::abs(tetrahedra.normal(f)[axis]) < 1. - 1e-12)
          throw InputError(all[f].last->parameter("Velocity x"),
                           "components that are neither all of them nor that "
                           "normal to the side",
                           "all of them, or the normal one alone, on a plane "
                           "normal to an axis, where loads are bounded in "
                           "three dimensions",
                           "hold all components, or set the others to free");
      }
    return held;
  }

  std::optional<Tensor<1, dim>>
  SolidLoad::prescribed_velocity(const std::vector<FacetCondition> &held)
  {
    std::optional<Tensor<1, dim>> velocity;
    for (const FacetCondition &facet : held)
      if (facet.velocity.norm() > 0.)
        {
          if (velocity &&
              (*velocity - facet.velocity).norm() > 1e-9 * velocity->norm())
            throw InputError("Boundary conditions/Names",
                             "several velocities that are not zero",
                             "one velocity for all that is pushed where loads "
                             "are bounded",
                             "the bounded load is the reaction to one "
                             "translation");
          velocity = facet.velocity;
        }
    return velocity;
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
            if (!(k > 0.))
              throw InputError(
                "Materials/" + scene.materials.name(m) + "/Cohesion",
                0,
                "> 0 Pa everywhere where loads are bounded in three "
                "dimensions",
                "give a small cohesion, e.g. a hundredth of weight times "
                "height: it raises the bounds a little");
            units.stress = std::max(units.stress, k);
          }
      }
    units.length = std::cbrt(volume) / 4.;
  }

  namespace
  {
    /** @throws InputError if a rigid motion of the body is free */
    void
    check_rigid_motions(const Tetrahedra                  &tetrahedra,
                        const std::vector<FacetCondition> &held,
                        const double                       length)
    {
      Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
      const Point<dim>            centre  = tetrahedra.centre(0);
      for (unsigned int f = 0; f < held.size(); ++f)
        if (held[f].kind != FacetCondition::Kind::free)
          for (const unsigned int v : tetrahedra.facets[f].vertices)
            for (unsigned int d = 0; d < dim; ++d)
              if (held[f].kind == FacetCondition::Kind::fixed ||
                  held[f].axis == d)
                {
                  const Tensor<1, dim> arm =
                    (tetrahedra.vertices[v] - centre) / length;
                  Tensor<1, dim> e;
                  e[d]                          = 1.;
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
    check_loads(scene, tetrahedra, held);
  }

  void
  SolidLoad::prepare_reduction(const Scene &scene, const Tetrahedra &tetrahedra)
  {
    take_strengths(scene);
    for (unsigned int m = 0; m < strengths.size(); ++m)
      if (strengths[m].is_circular && strengths[m].a > 0.)
        {
          const std::string type =
            "Materials/" + scene.materials.name(m) + "/Type";
          throw InputError(type,
                           ParameterFile::value(type),
                           "Mohr-Coulomb | Tresca | von Mises where the "
                           "strength is reduced",
                           "c and tan(phi) are those of Mohr-Coulomb");
        }
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
    choose_units(scene, tetrahedra);
    check_rigid_motions(tetrahedra, held, units.length);
    if (is_reaction())
      load_unit = units.stress * units.length * units.length *
                  std::abs(scene.observation.factor);
    const SolidScene bound   = on(scene, tetrahedra);
    bool             is_live = is_reaction();
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      is_live = is_live || bound.body_force(c).live.norm() > 0.;
    for (const auto &facet : bound.traction_of_facet)
      for (const auto &at_vertex : facet)
        is_live = is_live || at_vertex.live.norm() > 0.;
    if (!is_live)
      refuse_zero_load();
  }

  SolidScene
  SolidLoad::on(const Scene &scene, const Tetrahedra &tetrahedra) const
  {
    SolidScene bound;
    bound.scene      = &scene;
    bound.tetrahedra = &tetrahedra;
    bound.factor     = factor();
    bound.units      = units;
    for (SolidStrength one : strengths)
      {
        one.k /= units.stress;
        one.growth.slope /= units.stress;
        one.tension /= units.stress;
        bound.strengths.push_back(one);
      }
    bound.facet_conditions = facet_conditions(scene, tetrahedra);
    for (FacetCondition &facet : bound.facet_conditions)
      facet.velocity /= units.velocity;

    bound.traction_of_facet.resize(tetrahedra.facets.size());
    for (const auto &load : scene.tractions.list)
      for (const unsigned int f : tetrahedra.held_facets(*load))
        {
          const Tensor<1, dim> n        = tetrahedra.normal(f);
          const auto           traction = [&](const Point<dim> &x) {
            Tensor<1, dim> t = load->vector_on_side(x, n, 0.);
            for (unsigned int d = 0; d < dim; ++d)
              if (load->components[d])
                t[d] += load->components[d]->value(x, 0.);
            return t / units.stress;
          };
          Point<dim>                    middle;
          Tensor<1, dim>                mean;
          std::array<Tensor<1, dim>, 3> t;
          double                        largest = 0.;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Point<dim> &x =
                tetrahedra.vertices[tetrahedra.facets[f].vertices[i]];
              t[i] = traction(x);
              middle += x / 3.;
              mean += t[i] / 3.;
              largest = std::max(largest, t[i].norm());
              (factor() == LoadFactor::tractions || factor() == LoadFactor::all
                 ? bound.traction_of_facet[f][i].live
                 : bound.traction_of_facet[f][i].dead) += t[i];
            }
          const FacetCondition &held = bound.facet_conditions[f];
          bool is_free               = held.kind == FacetCondition::Kind::free;
          if (held.kind == FacetCondition::Kind::plane)
            is_free = std::abs(t[0][held.axis]) + std::abs(t[1][held.axis]) +
                        std::abs(t[2][held.axis]) <=
                      1e-12 * largest;
          if (!is_free && largest > 0.)
            throw InputError(load->parameter("Sides"),
                             load->part(),
                             "tractions along components that are free where "
                             "loads are bounded",
                             "leave the traction out where the velocity is "
                             "prescribed");
          if ((traction(middle) - mean).norm() > 1e-9 * largest)
            throw InputError(load->parameter("Traction x"),
                             load->part(),
                             "tractions that are linear in each face of the "
                             "mesh where loads are bounded",
                             "divide the side where its traction has a kink, "
                             "or take finer cells there");
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
