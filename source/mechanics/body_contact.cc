// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mechanics/body_contact.h>
#include <geocone/scene/edge_normal.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** What faces an edge by less than this part of it is left out. */
    constexpr double least_part = 1e-9;

    /** A node touches if the other body faces this part of what the node stands for:
     *  half at a corner, where edges fit. */
    constexpr double least_cover = 0.4;

    /** Edges face each other up to this cosine between their normals. */
    constexpr double facing = -0.1;
  } // namespace

  BodyContact::BodyContact(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space)
    : scene(scene)
    , mesh(mesh)
    , space(space)
  {
    for (const auto &pair : scene.contacts.list)
      {
        pairs.push_back({edges_of(pair->is_first), edges_of(pair->is_other)});
        for (const auto *edges : {&pairs.back().first, &pairs.back().other})
          if (edges->empty())
            throw InputError(
              "Contacts/" + pair->name + "/" +
                (edges == &pairs.back().first ? "Body" : "Other body"),
              "no boundary",
              "materials that are at the boundary of the mesh",
              "check the regions of the materials");
      }
  }

  std::vector<BodyContact::Edge>
  BodyContact::edges_of(const std::vector<bool> &materials) const
  {
    std::vector<Edge>                    edges;
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  N(space.nodes_per_cell());
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (materials[cell->material_id()])
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              Edge edge;
              edge.cell                             = cell;
              const auto                  reference = cell->reference_cell();
              std::array<unsigned int, 2> ends;
              for (unsigned int v = 0; v < 2; ++v)
                ends[v] = reference.face_to_cell_vertices(f, v, true);
              if (edge_normal(cell->vertex(ends[0]), cell->vertex(ends[1])) *
                    (cell->center() - cell->vertex(ends[0])) >
                  0.)
                std::swap(ends[0], ends[1]);
              edge.unit_start = reference.template vertex<dim>(ends[0]);
              edge.unit_end   = reference.template vertex<dim>(ends[1]);
              space.cell_nodes(cell, nodes);
              // Those that are not zero everywhere on it.
              std::set<unsigned int> on_edge;
              for (const double s : {0., 0.21, 0.37, 0.5, 0.71, 1.})
                {
                  space.evaluate(
                    cell,
                    Point<dim>(edge.unit_start +
                               s * (edge.unit_end - edge.unit_start)),
                    N.data(),
                    nullptr);
                  for (unsigned int i = 0; i < N.size(); ++i)
                    if (std::abs(N[i]) > 1e-12)
                      on_edge.insert(i);
                  for (unsigned int i = 0; i < N.size(); ++i)
                    if (std::abs(N[i] - 1.) < 1e-12)
                      (s == 0. ? edge.start : edge.end) =
                        space.local_node(nodes[i]);
                }
              for (const unsigned int i : on_edge)
                {
                  edge.of_cell.push_back(i);
                  edge.nodes.push_back(space.local_node(nodes[i]));
                }
              const auto &x = space.node_positions();
              edge.length   = x[edge.start].distance(x[edge.end]);
              const QGauss<1> rule(space.degree() + 1);
              Eigen::VectorXd value(edge.nodes.size());
              edge.integrals = Eigen::VectorXd::Zero(value.size());
              for (unsigned int q = 0; q < rule.size(); ++q)
                {
                  evaluate(edge, rule.point(q)[0], value.data());
                  edge.integrals += rule.weight(q) * edge.length * value;
                }
              edges.push_back(edge);
            }
    return edges;
  }

  void
  BodyContact::evaluate(const Edge &edge, const double s, double *N) const
  {
    std::vector<double> all(space.nodes_per_cell());
    space.evaluate(
      edge.cell,
      Point<dim>(edge.unit_start + s * (edge.unit_end - edge.unit_start)),
      all.data(),
      nullptr);
    for (unsigned int i = 0; i < edge.of_cell.size(); ++i)
      N[i] = all[edge.of_cell[i]];
  }

  std::vector<BodyContact::Piece>
  BodyContact::pieces(const Edge              &edge,
                      const std::vector<Edge> &others,
                      const Place             &place,
                      const double             reach) const
  {
    const Point<dim>     a = place(edge.start), b = place(edge.end);
    const double         length = a.distance(b);
    const Tensor<1, dim> along  = (b - a) / length,
                         n      = edge_normal(a, b) / length;

    // Of each other edge the interval that faces it.
    struct Candidate
    {
      const Edge    *other;
      Point<dim>     c;
      Tensor<1, dim> cd;
      double         begin, end;

      /** Part of the other edge that is straight ahead of a part of the edge. */
      double
      ahead(const double          s,
            const Point<dim>     &a,
            const Tensor<1, dim> &along,
            const double          length) const
      {
        return std::clamp(
          ((a + s * length * along - c) * along) / (cd * along), 0., 1.);
      }
    };
    std::vector<Candidate> candidates;
    std::vector<double>    ends;
    for (const Edge &other : others)
      {
        Candidate at;
        at.other           = &other;
        at.c               = place(other.start);
        const Point<dim> d = place(other.end);
        at.cd              = d - at.c;
        const double size  = at.cd.norm();
        if (edge_normal(at.c, d) * n > facing * size)
          continue;
        const double s = (at.c - a) * along / length,
                     t = (d - a) * along / length;
        at.begin       = std::max(std::min(s, t), 0.);
        at.end         = std::min(std::max(s, t), 1.);
        if (at.end - at.begin < least_part)
          continue;
        const double middle = (at.begin + at.end) / 2.,
                     gap =
                       (at.c + at.ahead(middle, a, along, length) * at.cd - a) *
                       n;
        if (gap > std::max(size, length) + reach ||
            gap < -std::min(size, length))
          continue;
        candidates.push_back(at);
        ends.push_back(at.begin);
        ends.push_back(at.end);
      }
    std::sort(ends.begin(), ends.end());

    // Where several do, the nearest.
    std::vector<Piece> all;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      {
        if (ends[k + 1] - ends[k] < least_part)
          continue;
        const double     middle  = (ends[k] + ends[k + 1]) / 2.;
        double           nearest = std::numeric_limits<double>::infinity();
        const Candidate *best    = nullptr;
        for (const Candidate &at : candidates)
          if (at.begin <= middle && middle <= at.end)
            {
              const double gap = std::abs(
                (at.c + at.ahead(middle, a, along, length) * at.cd - a) * n);
              if (gap < nearest)
                {
                  nearest = gap;
                  best    = &at;
                }
            }
        if (best != nullptr)
          all.push_back({ends[k],
                         ends[k + 1],
                         best->other,
                         best->ahead(ends[k], a, along, length),
                         best->ahead(ends[k + 1], a, along, length)});
      }
    return all;
  }

  void
  BodyContact::integrate(const Edge                   &edge,
                         const std::vector<Piece>     &facing,
                         const Place                  &place,
                         std::map<unsigned int, Sums> &sums) const
  {
    const Point<dim>   a = place(edge.start), b = place(edge.end);
    const unsigned int m = edge.nodes.size();
    const QGauss<1>    rule(space.degree() + 1);
    Eigen::MatrixXd    mass = Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd    D    = Eigen::VectorXd::Zero(m), N(m);
    double             part = 0.;
    for (const Piece &piece : facing)
      {
        part += piece.end - piece.begin;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const double s =
              piece.begin + rule.point(q)[0] * (piece.end - piece.begin);
            evaluate(edge, s, N.data());
            const double w =
              rule.weight(q) * (piece.end - piece.begin) * edge.length;
            mass += w * N * N.transpose();
            D += w * N;
          }
      }
    if (part < 1e-6)
      return;
    const Eigen::MatrixXd dual =
      D.asDiagonal() * mass.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    for (unsigned int i = 0; i < m; ++i)
      {
        Sums &own = sums[edge.nodes[i]];
        own.D += D[i];
        own.normal += part * edge_normal(a, b);
      }
    std::vector<double> N_other;
    for (const Piece &piece : facing)
      {
        N_other.resize(piece.other->nodes.size());
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const double x = rule.point(q)[0], w = rule.weight(q) *
                                                   (piece.end - piece.begin) *
                                                   edge.length;
            evaluate(
              edge, piece.begin + x * (piece.end - piece.begin), N.data());
            evaluate(*piece.other,
                     piece.other_begin +
                       x * (piece.other_end - piece.other_begin),
                     N_other.data());
            const Eigen::VectorXd psi = dual * N;
            for (unsigned int i = 0; i < m; ++i)
              for (unsigned int j = 0; j < N_other.size(); ++j)
                sums[edge.nodes[i]].M[piece.other->nodes[j]] +=
                  w * psi[i] * N_other[j];
          }
      }
  }

  void
  BodyContact::add_whole_edges(const std::vector<Edge>      &edges,
                               const Place                  &place,
                               std::map<unsigned int, Sums> &sums) const
  {
    for (const Edge &edge : edges)
      {
        const Tensor<1, dim> n =
          edge_normal(place(edge.start), place(edge.end));
        for (unsigned int i = 0; i < edge.nodes.size(); ++i)
          // The sides of a corner have nothing to do with what its base stands on.
          if (const auto own = sums.find(edge.nodes[i]);
              own != sums.end() &&
              n * own->second.normal >=
                std::cos(pi / 4.) * n.norm() * own->second.normal.norm())
            own->second.whole += edge.integrals[i];
      }
  }

  std::vector<FacingNode>
  BodyContact::find(const Place &place, const double reach) const
  {
    std::vector<FacingNode> all;
    std::set<unsigned int>  taken;
    const unsigned int      n_obstacles = scene.obstacles.list.size();
    for (unsigned int k = 0; k < pairs.size(); ++k)
      {
        std::map<unsigned int, Sums> sums;
        for (const Edge &edge : pairs[k].first)
          integrate(
            edge, pieces(edge, pairs[k].other, place, reach), place, sums);
        add_whole_edges(pairs[k].first, place, sums);
        const InterfaceLaw    &law = scene.contacts.list[k]->law;
        std::set<unsigned int> own;
        for (const auto &[node, sum] : sums)
          {
            if (!(sum.D > least_cover * sum.whole) || taken.count(node) > 0)
              continue;
            FacingNode at;
            at.node.node     = node;
            at.node.obstacle = n_obstacles + k;
            at.node.normal   = -sum.normal / sum.normal.norm();
            at.node.friction = law.friction;
            at.node.adhesion = law.adhesion * sum.D;
            at.node.rebounds = law.restitution > 0.;
            at.node.length   = sum.D;
            Point<dim> other;
            for (const auto &[partner, M] : sum.M)
              if (std::abs(M) > 1e-14 * sum.D)
                {
                  if (taken.count(partner) > 0)
                    {
                      const Point<dim> x = place(partner);
                      throw StepFailure(
                        format(
                          "the node at (%g, %g) of the contact '", x[0], x[1]) +
                        scene.contacts.list[k]->name +
                        "' belongs to the 'Body' of one that comes before it "
                        "in 'Contacts/Names'\n"
                        "  remedy:  name first the contacts in which it is "
                        "'Other body', or exchange the bodies of one");
                    }
                  at.node.partners.push_back({partner, M / sum.D});
                  other += (M / sum.D) * place(partner);
                }
            at.gap = (place(node) - other) * at.node.normal;
            own.insert(node);
            all.push_back(at);
          }
        taken.insert(own.begin(), own.end());
      }
    return all;
  }

  void
  BodyContact::check_start(const Place &place) const
  {
    for (const FacingNode &at : find(place, 0.))
      if (at.gap < -1e-3 * at.node.length)
        {
          const Point<dim> x = place(at.node.node);
          throw InputError(
            "Contacts/Names",
            scene.contacts.list[at.node.obstacle - scene.obstacles.list.size()]
              ->name,
            "bodies that do not overlap at the start",
            format("'Body' is %.3g m in the other one at (%g, %g): move one "
                   "of them, or make the cells of curved sides smaller",
                   -at.gap,
                   x[0],
                   x[1]));
        }
  }
} // namespace geocone
