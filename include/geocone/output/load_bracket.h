// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_load_bracket_h
#define geocone_output_load_bracket_h

#include <geocone/folder/expectations.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Lower bound, upper bound and Davis's estimate of a limit load, from limit
   * analysis. If the dilatancy is smaller than the friction, the certified lower bound
   * holds for associated flow only, the upper bound holds for any dilatancy
   * (Radenkovic 1961), and Davis's load (1968) is an estimate, not a bound.
   */
  struct LoadBracket
  {
    std::string           name = "load";
    std::string           unit;         ///< empty for a load factor
    std::optional<double> lower, upper; ///< empty if not certified

    /** Lower and upper bounds computed with Davis's reduced strength for
     *  non-associated flow. One pair for a limit load; for a factor of safety, one
     *  pair for each of the variants A, B and C. */
    std::vector<std::array<double, 2>> davis;
    bool                               is_associated = true;

    unsigned int cells   = 0;  ///< number of cells of the last mesh
    double       seconds = 0.; ///< computing time of all meshes (s)

    /** Message if the bounded load is another one than the load that steps
     *  observe; empty if both can be compared. */
    std::string other_than_observed;

    /** Replaces each bound for which another mesh provides a tighter bound. A
     *  bound is empty if it is not certified. */
    void
    take(const std::optional<double> other_lower,
         const std::optional<double> other_upper);

    /** Relative gap upper/lower - 1 between the bounds; empty if a bound is
     *  missing. */
    std::optional<double>
    gap() const;

    /** Section "bounds" of summary.json. Entries: lower, upper, gap, middle,
     *  certified; null if undefined. */
    Json
    bounds() const;

    /** Section "non_associated" of summary.json: certified bounds and Davis's
     *  estimate. */
    Json
    non_associated() const;

    /** Line of text with the certified bounds and Davis's estimate. */
    std::string
    text() const;

    /** Line of text that compares the limit load of an incremental analysis with the
     *  bounds and Davis's estimate. */
    std::string
    beside(const double incremental) const;
  };
} // namespace geocone

#endif
