// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_load_bracket_h
#define geocone_output_load_bracket_h

#include <geocone/output/expectations.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Bounds and estimate of a limit load by limit analysis. If the dilatancy is smaller
   * than the friction, the certified lower bound holds for associated flow only, the
   * upper bound holds for any dilatancy (Radenkovic 1961), and Davis's load (1968) is
   * an estimate, not a bound.
   */
  struct LoadBracket
  {
    std::string           name = "load";
    std::string           unit;         ///< of a reaction; empty for a factor
    std::optional<double> lower, upper; ///< empty if not certified

    /** Both bounds for Davis's soil, for non-associated flow: of a load, or of a factor
     *  of safety by the variants A, B and C. */
    std::vector<std::array<double, 2>> davis;
    bool                               is_associated = true;

    unsigned int cells   = 0;  ///< of the last mesh
    double       seconds = 0.; ///< of all meshes

    /** Adopts better bounds from another mesh; empty if not certified. */
    void
    take(const std::optional<double> other_lower,
         const std::optional<double> other_upper);

    /** Gap upper/lower - 1, if both exist. */
    std::optional<double>
    gap() const;

    /** Topic bounds: lower, upper, gap, middle, certified; null if undefined. */
    Json
    bounds() const;

    /** Topic non_associated: the certified bounds and Davis's estimate. */
    Json
    non_associated() const;

    /** One line with the certified bounds and the estimate. */
    std::string
    text() const;

    /** One line that compares an incremental load with both. */
    std::string
    beside(const double incremental) const;
  };
} // namespace geocone

#endif
