// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/bounds/strengths_in_files.h>
#include <geocone/solid_bounds/solid_bounds.h>
#include <geocone/solid_bounds/solid_certificate_files.h>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    template <typename Vector>
    Json
    triple(const Vector &v, const double unit = 1.)
    {
      return Json::array({unit * v[0], unit * v[1], unit * v[2]});
    }

    /** Obstacles with their motions and interfaces. */
    Json
    obstacles_of(const SolidScene &given)
    {
      Json obstacles = Json::array();
      for (const auto &obstacle : given.scene->obstacles.list)
        {
          const InterfaceLaw &law = obstacle->law;
          obstacles.push_back(
            {{"name", obstacle->name},
             {"velocity", triple(obstacle->velocity(0.).centre)},
             {"friction", law.friction},
             {"adhesion", law.adhesion},
             {"tensile_strength",
              law.never_opens() ? Json() : Json(law.tension)}});
        }
      return obstacles;
    }

    /** Loads of the cells, and loads and supports of the faces on the boundary. */
    void
    add_loads_and_supports(const SolidScene &given, Json &json)
    {
      const Tetrahedra &tetrahedra = *given.tetrahedra;
      const double      stress     = given.units.stress;
      Json              dead = Json::array(), live = Json::array();
      for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
        {
          const SolidScene::Load load = given.body_force(c);
          dead.push_back(triple(load.dead, stress / given.units.length));
          live.push_back(triple(load.live, stress / given.units.length));
        }
      json["body_force"] = {{"dead", dead}, {"live", live}};

      Json faces = Json::array(), held = Json::array(), oblique = Json::array(),
           obstacle = Json::array(), velocity = Json::array(),
           dead_pull = Json::array(), live_pull = Json::array();
      for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
        {
          if (tetrahedra.facets[f].cells[1] != Tetrahedra::none)
            continue;
          const FacetCondition &condition = given.facet_conditions[f];
          Json of_face = Json::array(), dead_at = Json::array(),
               live_at = Json::array();
          for (unsigned int d = 0; d < dim; ++d)
            of_face.push_back(condition.holds(d));
          for (const SolidScene::Load &at_vertex : given.tractions(f))
            {
              dead_at.push_back(triple(at_vertex.dead, stress));
              live_at.push_back(triple(at_vertex.live, stress));
            }
          faces.push_back(tetrahedra.facets[f].vertices);
          held.push_back(of_face);
          oblique.push_back(condition.is_oblique());
          obstacle.push_back(
            condition.kind == FacetCondition::Kind::interface ? int(condition
                                                                      .obstacle)
                                                              : -1);
          velocity.push_back(triple(condition.velocity, given.units.velocity));
          dead_pull.push_back(dead_at);
          live_pull.push_back(live_at);
        }
      json["boundary"] = {{"face", faces},
                          {"held", held},
                          {"oblique", oblique},
                          {"obstacle", obstacle},
                          {"velocity", velocity},
                          {"dead", dead_pull},
                          {"live", live_pull}};
    }

    /** Pairs (i, j) of vertices of a tetrahedron to which the coefficients of a field
     *  belong, in Bernstein's basis: l_i for degree one, l_i^2 or 2 l_i l_j for degree two.
     *  @param n number of the coefficients */
    Json
    pairs_of_nodes(const std::size_t n)
    {
      Json pairs = Json::array();
      for (unsigned int i = 0; i < 4; ++i)
        pairs.push_back({i, i});
      if (n > 4)
        for (const auto &[i, j] : simplex_nodes::edges)
          pairs.push_back({i, j});
      return pairs;
    }
  } // namespace

  void
  write_certificate(const std::string      &folder,
                    const SolidScene       &given,
                    const SolidBound       &bound,
                    const CertificateClaim &claim)
  {
    const Tetrahedra &tetrahedra  = *given.tetrahedra;
    const bool        is_reaction = given.factor == LoadFactor::velocity;
    const std::size_t n_of_cell =
      (claim.is_lower ? bound.stress.size() : bound.velocity.size()) /
      tetrahedra.cells.size();
    Json json          = claim.entries("limit analysis in space",
                              is_reaction ? 0. : bound.lambda,
                              is_reaction ? given.units.velocity : 0.);
    json["materials"]  = materials_with_strengths(
      *given.scene, given.strengths, given.units.stress);
    json["tetrahedra"] = tetrahedra.cells;
    json["material"]   = tetrahedra.material;
    json["nodes"]      = pairs_of_nodes(n_of_cell);
    Json vertices = Json::array();
    for (const auto &x : tetrahedra.vertices)
      vertices.push_back(triple(x));
    json["vertices"] = vertices;
    json["obstacles"] = obstacles_of(given);
    add_loads_and_supports(given, json);
    Json fields = Json::array();
    for (std::size_t c = 0; c < tetrahedra.cells.size(); ++c)
      {
        Json of_cell = Json::array();
        for (std::size_t i = n_of_cell * c; i < n_of_cell * (c + 1); ++i)
          if (claim.is_lower)
            {
              // xx, yy, zz, xy, yz, zx.
              Json s = Json::array();
              for (const auto &[a, b] :
                   {std::pair(0, 0), {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}})
                s.push_back(given.units.stress / (a == b ? 1. : sqrt2) *
                            bound.stress[i][index_of_component[a][b]]);
              of_cell.push_back(s);
            }
          else
            of_cell.push_back(triple(bound.velocity[i], given.units.velocity));
        fields.push_back(of_cell);
      }
    json[claim.is_lower ? "stress" : "velocity"] = fields;
    claim.write(folder, json);
  }
} // namespace geocone::GEOCONE_DIM
