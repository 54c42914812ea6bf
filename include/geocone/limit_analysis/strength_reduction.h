// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_strength_reduction_h
#define geocone_limit_analysis_strength_reduction_h

#include <geocone/bounds/safety_search.h>
#include <geocone/limit_analysis/certified_bounds.h>

#include <functional>

namespace geocone::GEOCONE_DIM
{
  /** Strict bounds on the factor of safety of a plane body (SafetySearch). */
  class StrengthReduction
  {
  public:
    /** Function that returns the input of the limit analysis on the current mesh for
     *  strength divided by F. */
    using Reduced = std::function<BoundScene(const double F)>;

    struct Level : SafetySearch::Level
    {
      /** Both bounds on the load factor for the strength divided by
       *  `factor`. */
      CertifiedBounds bounds;

      /** Solutions that certify the bounds on the factor of safety. */
      CertifiedSide lower_proof, upper_proof;
    };

    /** Computes both bounds on the factor of safety, using a given mesh.
     *  @param tolerance of the interior-point method, relative to the load
     *  @throws StepFailure if the body fails for no factor F, or for all
     *  factors */
    Level
    on_mesh(const Reduced &reduced, const double tolerance);

    void
    state(StateRow &row)
    {
      row(search);
    }

    /** Search for the roots, with the exponent of the last mesh. */
    const SafetySearch &
    last_search() const
    {
      return search;
    }

  private:
    SafetySearch search;
  };
} // namespace geocone::GEOCONE_DIM

#endif
