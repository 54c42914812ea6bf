// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_sample_search_h
#define geocone_reliability_sample_search_h

#include <geocone/plane_bounds/bound_problem.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Choice of the bound that is expected to decide whether the load factor of a sample is
   * at least one, by extrapolation from coarser meshes. On meshes that are refined where
   * the soil yields, errors of bounds fall about as 1/N of the number of triangles N. The
   * choice proves nothing: if it is wrong, it costs a solution, or the sample remains
   * undecided.
   */
  class SampleSearch
  {
  public:
    /** @param gap of both bounds on the first mesh, relative to the lower one: of another
     *  sample
     *  @param most_cells largest number of triangles of a mesh */
    SampleSearch(const double gap, const unsigned int most_cells)
      : gap(gap)
      , most_cells(most_cells)
    {}

    /** Adds a bound, that is not certified if it is not finite. The lower bound of the first
     *  mesh comes first. */
    void
    add(const BoundSide side, const unsigned int n_cells, const double bound);

    /** Returns the bound that is expected to decide; none if neither is on a mesh of
     *  most_cells triangles. */
    std::optional<BoundSide>
    next() const;

  private:
    struct Value
    {
      double n_cells, bound;
    };
    using Values = std::vector<Value>;

    /** Load factor to which the bounds converge. */
    double
    limit() const;

    /** Returns true if the error on the largest mesh may be less than the distance of the
     *  limit from one. */
    bool
    may_decide(const Values &bounds, const double limit) const;

    const double gap, most_cells;
    Values       lower, upper;
  };
} // namespace geocone::GEOCONE_DIM

#endif
