// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/text_of_place.h>
#include <geocone/contact/contact.h>

#include <algorithm>
#include <utility>

// Potential contact nodes of a step: their free directions, tangents and corners.

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Minimum length of the free part of the normal for twins, which are
     *  supported alike: any direction not nearly orthogonal is sufficient. */
    constexpr double hardly = 0.1;
  } // namespace

  void
  ContactNode::support(const std::array<bool, dim> &is_prescribed,
                       const Tensor<1, dim>        &v)
  {
    Tensor<1, dim> free = normal, carried;
    for (unsigned int d = 0; d < dim; ++d)
      if (is_prescribed[d])
        {
          free[d]    = 0.;
          carried[d] = normal[d];
        }
    const double s = free.norm();
    carried /= s;
    normal = free / s;
    least  = least / s - carried * v;
    friction /= s;
    tension *= s;
    of_obstacle = outer_product(normal, carried);
    for (unsigned int d = 0; d < dim; ++d)
      if (!is_prescribed[d])
        of_obstacle[d][d] += 1.;
  }

  bool
  Contact::support(ContactNode  &node,
                   const Vector &prescribed,
                   std::string  &refusal) const
  {
    const unsigned int n = n_free(node.node);
    if (n == dim)
      return true;
    const Tensor<1, dim> free = free_part(node.normal, node.node);
    const double         part = free.norm(); // of the normal
    if (n == 0 || part < (node.is_twin          ? hardly
                          : node.touches_body() ? least_free_component
                                                : least_free_normal))
      {
        if (node.touches_body() && !node.is_twin)
          refusal = "a node of a 'Body' of the section 'Contacts' is held by a "
                    "boundary condition against the other body\n"
                    "  remedy:  exchange 'Body' and 'Other body', or hold it "
                    "elsewhere";
        return false;
      }
    if (node.touches_body())
      {
        if (node.is_twin) // u.n by its free part
          node.least /= part;
        node.normal = free / part;
        return true;
      }
    std::array<bool, dim> is_prescribed;
    Force                 v;
    for (unsigned int d = 0; d < dim; ++d)
      {
        is_prescribed[d] = !unknowns.is_free(dim * node.node + d);
        v[d]             = prescribed.local_element(dim * node.node + d);
      }
    node.support(is_prescribed, v);
    return true;
  }

  void
  Contact::append(ContactNode &node, std::string &refusal)
  {
    if (list.empty() || list.back().node != node.node)
      {
        list.push_back(node);
        return;
      }
    ContactNode &nearer = list.back();
    const double cosine = nearer.normal * node.normal;
    if (n_free(node.node) > 1 && std::abs(cosine) < parallel)
      {
        make_corner(nearer, node);
        list.push_back(node);
        return;
      }
    // The one that acts first in the free directions counts; with both normals
    // in these it is the nearer one.
    if (std::min(nearer.free_part_of_normal(), node.free_part_of_normal()) >
        1. - 1e-12)
      return;
    if (cosine < 0. && nearer.least + node.least >= 0.)
      refusal =
        "the node at (" + text_of_place((*unknowns.node_positions)[node.node]) +
        "), which a boundary condition leaves free in one direction, is "
        "squeezed along it between two contacts\n"
        "  remedy:  leave the corner out of the body, or end the loading "
        "before";
    if (node.least > nearer.least)
      nearer = node;
  }

  void
  Contact::begin_step(ContactStep step, const Vector &prescribed)
  {
    obstacles.begin_step(std::move(step.bodies));
    has_pairs = step.has_pairs;
    list.clear();
    std::string refusal;
    for (ContactNode &node : step.nodes)
      if (support(node, prescribed, refusal))
        {
          make_tangents(node);
          if (node.n_tangents == 0)
            {
              node.friction = 0.;
              node.adhesion = 0.;
            }
          append(node, refusal);
        }
    refusal = text_of_any_rank(prescribed.get_mpi_communicator(), refusal);
    if (!refusal.empty())
      throw StepFailure(refusal);
  }

  void
  Contact::make_tangents(ContactNode &node) const
  {
    const unsigned int n = n_free(node.node);
    node.n_tangents      = 0;
    if constexpr (dim == 2)
      {
        if (n == 2)
          node.tangents[node.n_tangents++] =
            Force({-node.normal[1], node.normal[0]});
      }
    else
      // Starting with the free directions farthest from the normal.
      while (node.n_tangents + 1 < n)
        {
          Force  best;
          double longest = 0.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              Force t =
                free_part(dealii::Point<dim>::unit_vector(d), node.node);
              t -= (t * node.normal) * node.normal;
              for (unsigned int k = 0; k < node.n_tangents; ++k)
                t -= (t * node.tangents[k]) * node.tangents[k];
              if (t.norm() > longest)
                {
                  longest = t.norm();
                  best    = t / longest;
                }
            }
          node.tangents[node.n_tangents++] = best;
        }
  }

  void
  Contact::make_corner(ContactNode &a, ContactNode &b)
  {
    const double cosine = a.normal * b.normal;
    const auto   dual   = [&](const Force &n, const Force &m) {
      return (n - cosine * m) / (1. - cosine * cosine);
    };
    a.share = outer_product(a.normal, dual(a.normal, b.normal));
    b.share = outer_product(b.normal, dual(b.normal, a.normal));
    if constexpr (dim == 3)
      {
        const Force edge = cross_product_3d(a.normal, b.normal);
        a.share += outer_product(edge, edge) / edge.norm_square();
      }
    b.is_second = true;
    for (ContactNode *node : {&a, &b})
      {
        node->is_corner = true;
        node->friction  = 0.;
        node->adhesion  = 0.;
        node->tension   = 0.;
      }
  }
} // namespace geocone::GEOCONE_DIM
