// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, samples would be refined for a bound that cannot decide them, or given up too early.
// The bounds are those of the load factor l on N triangles with the errors 0.1 and 0.1 times 1000/N;
// on the largest mesh of 20000 the error is 0.005, of which a half counts. The gap of the mean sample
// is 0.2 of its lower bound. A triangle whose error is all is divided until there are ten.

#include <geocone/mesh/bisected.h>
#include <geocone/reliability/sample_search.h>

#include "../test.h"

#include <array>
#include <cstdio>
#include <limits>

namespace limit_load_sample_search_01
{
  using namespace geocone;

  const char *
  next(const SampleSearch &search)
  {
    const auto side = search.next();
    return !side ? "none" : *side == BoundSide::lower ? "lower" : "upper";
  }

  /** Bounds of a load factor on meshes of 1000 and 2000 triangles. */
  void
  show(const double factor)
  {
    SampleSearch search(0.2, 20000);
    search.add(BoundSide::lower, 1000, factor - 0.1);
    std::printf("%.4f: %s", factor, next(search));
    search.add(BoundSide::upper, 1000, factor + 0.1);
    std::printf(" %s", next(search));
    const BoundSide side = *search.next();
    search.add(side, 2000, factor + (side == BoundSide::lower ? -0.05 : 0.05));
    std::printf(" %s\n", next(search));
  }

  void
  test()
  {
    // Without an upper bound the limit is (l - 0.1) 1.1: 1.0175 at l = 1.025, 0.9955 at 1.005.
    for (const double factor : {1.025, 1.005, 1.002, 0.998, 0.995, 0.9})
      show(factor);
    SampleSearch uncertified(0.2, 20000);
    uncertified.add(
      BoundSide::lower, 1000, std::numeric_limits<double>::quiet_NaN());
    std::printf("without a lower bound: %s\n", next(uncertified));

    CoarseMesh square;
    square.points = {{0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}};
    for (const auto &vertices : {std::array<unsigned int, 3>{{0, 1, 2}},
                                 std::array<unsigned int, 3>{{3, 2, 1}}})
      {
        dealii::CellData<2> cell(3);
        cell.vertices.assign(vertices.begin(), vertices.end());
        square.cells.push_back(cell);
      }
    const NestedMesh fine = bisected(NestedMesh(square), {1., 0.}, 10);
    unsigned int     n    = 0;
    for (const unsigned int parent : fine.parent)
      n += parent == 0;
    std::printf("triangles: %s, most in the first: %s\n",
                fine.mesh.cells.size() >= 10 ? "10 or more" : "too few",
                2 * n > fine.parent.size() ? "yes" : "NO");
    std::printf("without an error: %zu\n",
                bisected(NestedMesh(square), {0., 0.}, 10).mesh.cells.size());
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace limit_load_sample_search_01
