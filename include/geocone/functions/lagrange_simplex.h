// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_lagrange_simplex_h
#define geocone_functions_lagrange_simplex_h

#include <geocone/base/types.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Lagrange shape functions of a triangle or tetrahedron, in barycentric
   *  coordinates l. With the degree k, node a is at l = a/k, where the integers
   *  a sum to k, and
   *    N_a(l) = product over i and m < a_i of (k l_i - m)/(m + 1). */
  class LagrangeSimplex
  {
  public:
    using Barycentric = std::array<double, dim + 1>;
    using Index       = std::array<unsigned int, dim + 1>;

    explicit LagrangeSimplex(const unsigned int degree);

    unsigned int
    degree() const
    {
      return k;
    }

    /** The indices a of all nodes; the first dim + 1 are those of the
     *  corners. */
    const std::vector<Index> &
    nodes() const
    {
      return all_nodes;
    }

    double
    value(const unsigned int node, const Barycentric &l) const;

    /** Derivatives of value() by the barycentric coordinates, as if they were
     *  independent. */
    Barycentric
    derivatives(const unsigned int node, const Barycentric &l) const;

  private:
    unsigned int       k;
    std::vector<Index> all_nodes;
  };
} // namespace geocone::GEOCONE_DIM

#endif
