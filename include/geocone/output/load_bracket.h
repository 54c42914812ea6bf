// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_load_bracket_h
#define geocone_output_load_bracket_h

#include <geocone/output/expectations.h>

#include <array>
#include <optional>
#include <string>

namespace geocone
{
  /**
   * What a limit analysis proves and what it estimates of a limit load. Where soil
   * dilates less than its friction, the certified lower bound holds for associated flow
   * only, the upper one for any dilatancy (Radenkovic 1961), and Davis's load (1968) is
   * an estimate and no bound.
   */
  struct LoadBracket
  {
    std::string           name = "load";
    std::string           unit;         ///< of a reaction; a factor has none
    std::optional<double> lower, upper; ///< certified, or not there

    /** Both bounds of the load of Davis's soil, where flow is not associated. */
    std::optional<std::array<double, 2>> davis;
    bool                                 is_associated = true;

    unsigned int cells   = 0;  ///< of the last mesh
    double       seconds = 0.; ///< of all meshes

    /** Takes bounds of another mesh that are better; those that are not certified are
     *  not there. */
    void
    take(const std::optional<double> other_lower,
         const std::optional<double> other_upper);

    /** upper/lower - 1, if there are both. */
    std::optional<double>
    gap() const;

    /** The topic bounds: lower, upper, gap, middle, certified; null where there is
     *  none. */
    Json
    bounds() const;

    /** The topic non_associated: what is certified, and Davis's estimate. */
    Json
    non_associated() const;

    /** What is certified and what is an estimate, in a line. */
    std::string
    text() const;

    /** How an incremental load compares with both, in a line. */
    std::string
    beside(const double incremental) const;
  };
} // namespace geocone

#endif
