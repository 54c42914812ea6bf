// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/contact/body_contact.h>
#include <geocone/surfaces/face_points.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Fraction of a face below which a facing piece is ignored. */
    constexpr double least_piece = 1e-9;

    /** Covered fraction below which a face is ignored: dual functions on so
     *  small a part consist of rounding errors. */
    constexpr double least_facing_part = dim == 2 ? 1e-6 : 1e-2;

    /** Minimum covered fraction of a node's tributary area for contact: at a
     *  corner of matching faces it is a half, in three dimensions a quarter. */
    constexpr double least_cover = dim == 2 ? 0.4 : 0.2;

    /** Share in a uniform pressure on its faces below which a node is free.
     *  Corners of quadratic triangles and quadratic nodes on an axis have
     *  none. */
    constexpr double least_share = 1e-9;

    /** Largest cosine between the normals of facing faces. */
    constexpr double facing = -0.1;

    /** Quadrature on intervals or triangles, exact for products of two shape
     *  functions of degree p, also on parallelograms. */
    template <int m>
    Quadrature<m>
    rule_of_piece(const bool simplicial, const unsigned int p)
    {
      if constexpr (m == 1)
        return QGauss<1>(p + 1);
      else
        return QDuffy(simplicial ? p + 1 : 2 * p + 1, 1.);
    }
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
        pairs.push_back({faces_of(pair->is_first), faces_of(pair->is_other)});
        for (const auto *faces : {&pairs.back().first, &pairs.back().other})
          if (faces->empty())
            throw InputError(
              "Contacts/" + pair->name + "/" +
                (faces == &pairs.back().first ? "Body" : "Other body"),
              "no boundary",
              "materials that are at the boundary of the mesh",
              "check the regions of the materials");
      }
  }

  std::vector<BodyContact::Face>
  BodyContact::faces_of(const std::vector<bool> &materials) const
  {
    std::vector<Face>                    faces;
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  N(space.nodes_per_cell());
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (materials[cell->material_id()])
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const auto                reference = cell->reference_cell();
              std::vector<unsigned int> vertices;
              for (unsigned int v = 0; v < cell->face(f)->n_vertices(); ++v)
                vertices.push_back(reference.face_to_cell_vertices(f, v, true));
              if (vertices.size() == 4) // in cyclic order
                std::swap(vertices[2], vertices[3]);
              std::vector<Point<dim>> places, unit;
              for (const unsigned int v : vertices)
                places.push_back(cell->vertex(v));
              const FacePlane plane{SidePart{places}};
              if (plane.signed_distance(cell->center()) > 0.)
                {
                  std::reverse(vertices.begin(), vertices.end());
                  std::reverse(places.begin(), places.end());
                }
              for (const unsigned int v : vertices)
                unit.push_back(reference.template vertex<dim>(v));
              Face face{cell, {unit}, {places}};
              face.size = plane.size;

              space.cell_nodes(cell, nodes);
              for (const Point<dim> &corner : unit)
                {
                  space.evaluate(cell, corner, N.data(), nullptr);
                  face.corners.push_back(space.local_node(
                    nodes[std::max_element(N.begin(), N.end()) - N.begin()]));
                }
              // Nodes whose functions do not vanish on it.
              std::vector<double> largest(N.size(), 0.), sum(N.size(), 0.);
              for (const FacePoint &point :
                   points_on_face(mesh, space, cell, f))
                for (unsigned int i = 0; i < N.size(); ++i)
                  {
                    largest[i] =
                      std::max(largest[i], std::abs(point.values[i]));
                    sum[i] += point.weight * point.values[i];
                  }
              std::vector<double> integrals;
              for (unsigned int i = 0; i < N.size(); ++i)
                if (largest[i] > 1e-12)
                  {
                    face.of_cell.push_back(i);
                    face.nodes.push_back(space.local_node(nodes[i]));
                    integrals.push_back(sum[i]);
                  }
              face.integrals = Eigen::Map<const Eigen::VectorXd>(
                integrals.data(), integrals.size());
              faces.push_back(face);
            }
    return faces;
  }

  std::vector<BodyContact::PlacedFace>
  BodyContact::placed(const std::vector<Face> &faces, const Positions &place)
  {
    std::vector<PlacedFace> result;
    for (const Face &face : faces)
      {
        SidePart outline;
        for (const unsigned int node : face.corners)
          outline.corners.push_back(place(node));
        result.push_back({&face, outline, FacePlane(outline)});
      }
    return result;
  }

  void
  BodyContact::evaluate(const Face           &face,
                        const Point<dim - 1> &s,
                        Eigen::VectorXd      &N) const
  {
    std::vector<double> all(space.nodes_per_cell());
    space.evaluate(face.cell, face.unit.at(s), all.data(), nullptr);
    N.resize(face.of_cell.size());
    for (unsigned int i = 0; i < face.of_cell.size(); ++i)
      N[i] = all[face.of_cell[i]];
  }

  std::vector<BodyContact::PointAhead>
  BodyContact::points_ahead(const PlacedFace              &face,
                            const std::vector<PlacedFace> &others,
                            const double                   reach) const
  {
    const FacePlane &plane = face.plane;
    const FlatPart   own   = plane.project(face.outline);

    struct Candidate
    {
      const PlacedFace     *other;
      FlatPart              flat;
      std::vector<FlatPart> shared;

      /** Projection onto the plane. */
      Point<dim>
      ahead_of(const Point<dim - 1> &x) const
      {
        return other->outline.at(unit_place(flat, x));
      }
    };
    std::vector<Candidate> candidates;
    for (const PlacedFace &other : others)
      {
        const FacePlane &its = other.plane;
        if (plane.place().distance(its.place()) >
              2. * (plane.diameter + its.diameter) + reach ||
            its.normal * plane.normal > facing)
          continue;
        Candidate      at{&other, plane.project(other.outline), {}};
        double         part = 0.;
        Point<dim - 1> middle;
        for (const FlatPart &piece : shared_part(own, at.flat))
          if (const double size = size_of(piece);
              size >= least_piece * plane.size)
            {
              at.shared.push_back(piece);
              part += size;
              for (const Point<dim - 1> &corner : piece.corners)
                middle += size / dim * corner;
            }
        if (part == 0.)
          continue;
        const double gap =
          plane.signed_distance(at.ahead_of(Point<dim - 1>(middle / part)));
        if (gap <= std::max(its.diameter, plane.diameter) + reach &&
            gap >= -std::min(its.diameter, plane.diameter))
          candidates.push_back(at);
      }

    // If several do, the nearest.
    const Quadrature<dim - 1> rule =
      rule_of_piece<dim - 1>(mesh.is_simplicial(), space.degree());
    std::vector<PointAhead> points;
    for (const Candidate &candidate : candidates)
      for (const FlatPart &piece : candidate.shared)
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Point<dim - 1> x       = piece.at(rule.point(q)),
                                 other_s = unit_place(candidate.flat, x);
            const double gap             = std::abs(
              plane.signed_distance(candidate.other->outline.at(other_s)));
            const bool is_hidden = std::any_of(
              candidates.begin(),
              candidates.end(),
              [&](const Candidate &before) {
                return before.other != candidate.other &&
                       is_in(before.flat, x) &&
                       std::abs(plane.signed_distance(before.ahead_of(x))) <
                         gap;
              });
            if (!is_hidden)
              points.push_back(
                {unit_place(own, x),
                 candidate.other->face,
                 other_s,
                 rule.weight(q) * (dim - 1) * size_of(piece) / plane.size});
          }
    return points;
  }

  void
  BodyContact::integrate(const PlacedFace              &placed_face,
                         const std::vector<PointAhead> &points,
                         std::map<unsigned int, Sums>  &sums) const
  {
    const Face      &face     = *placed_face.face;
    const FacePlane &plane    = placed_face.plane;
    const SidePart  &at_start = face.at_start;
    const auto       weight   = [&](const PointAhead &point) {
      return point.part * face.size * mesh.measure(at_start.at(point.s));
    };
    const unsigned int           m    = face.nodes.size();
    Eigen::MatrixXd              mass = Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd              D    = Eigen::VectorXd::Zero(m), N_other;
    double                       part = 0.;
    std::vector<Eigen::VectorXd> values(points.size());
    for (std::size_t q = 0; q < points.size(); ++q)
      {
        Eigen::VectorXd &N = values[q];
        const double     w = weight(points[q]);
        part += points[q].part;
        evaluate(face, points[q].s, N);
        mass += w * N * N.transpose();
        D += w * N;
      }
    if (part < least_facing_part)
      return;
    const Eigen::MatrixXd dual =
      D.asDiagonal() * mass.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    for (unsigned int i = 0; i < m; ++i)
      {
        Sums &own = sums[face.nodes[i]];
        own.D += D[i];
        own.faced += D.sum();
        own.diameter = std::max(own.diameter, plane.diameter);
        own.normal += part * plane.size * plane.normal;
      }
    for (std::size_t q = 0; q < points.size(); ++q)
      {
        const PointAhead &point = points[q];
        evaluate(*point.other, point.other_s, N_other);
        const Eigen::VectorXd psi = dual * values[q];
        const double          w   = weight(point);
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < N_other.size(); ++j)
            sums[face.nodes[i]].M[point.other->nodes[j]] +=
              w * psi[i] * N_other[j];
      }
  }

  void
  BodyContact::add_whole_faces(const std::vector<PlacedFace> &faces,
                               std::map<unsigned int, Sums>  &sums)
  {
    for (const PlacedFace &at : faces)
      for (unsigned int i = 0; i < at.face->nodes.size(); ++i)
        // Lateral faces of a corner are not related to the support of its base.
        if (const auto own = sums.find(at.face->nodes[i]);
            own != sums.end() &&
            at.plane.normal * own->second.normal >=
              std::cos(pi / 4.) * own->second.normal.norm())
          own->second.whole += at.face->integrals[i];
  }

  std::vector<FacingNode>
  BodyContact::find(const Positions &place, const double reach) const
  {
    std::vector<FacingNode> all;
    std::set<unsigned int>  taken;
    const unsigned int      n_obstacles = scene.obstacles.list.size();
    for (unsigned int k = 0; k < pairs.size(); ++k)
      {
        std::map<unsigned int, Sums>  sums;
        const std::vector<PlacedFace> first  = placed(pairs[k].first, place);
        const std::vector<PlacedFace> others = placed(pairs[k].other, place);
        for (const PlacedFace &face : first)
          integrate(face, points_ahead(face, others, reach), sums);
        add_whole_faces(first, sums);
        std::set<unsigned int> own;
        for (const auto &[node, sum] : sums)
          {
            if (!(sum.D > least_cover * sum.whole) ||
                !(sum.D > least_share * sum.faced) || taken.count(node) > 0)
              continue;
            FacingNode at;
            at.node.node     = node;
            at.node.obstacle = n_obstacles + k;
            at.node.normal   = -sum.normal / sum.normal.norm();
            at.node.length   = sum.D;
            Point<dim> other;
            for (const auto &[partner, M] : sum.M)
              if (std::abs(M) > 1e-14 * sum.D)
                {
                  if (taken.count(partner) > 0)
                    throw StepFailure(
                      "the node at (" + text_of_place(place(partner)) +
                      ") of the contact '" + scene.contacts.list[k]->name +
                      "' belongs to the 'Body' of one that comes before it "
                      "in 'Contacts/Names'\n"
                      "  remedy:  name first the contacts in which it is "
                      "'Other body', or exchange the bodies of one");
                  at.node.partners.push_back({partner, M / sum.D});
                  other += (M / sum.D) * place(partner);
                }
            at.gap  = (place(node) - other) * at.node.normal;
            at.size = sum.diameter;
            own.insert(node);
            all.push_back(at);
          }
        taken.insert(own.begin(), own.end());
      }
    return all;
  }

  void
  BodyContact::check_start(const Positions &place) const
  {
    for (const FacingNode &at : find(place, 0.))
      if (at.gap < -1e-3 * at.size)
        throw InputError(
          "Contacts/Names",
          scene.contacts.list[at.node.obstacle - scene.obstacles.list.size()]
            ->name,
          "bodies that do not overlap at the start",
          format("'Body' is %.3g m in the other one at (%s): move one of them, "
                 "or make the cells of curved sides smaller",
                 -at.gap,
                 text_of_place(place(at.node.node)).c_str()));
  }
} // namespace geocone::GEOCONE_DIM
