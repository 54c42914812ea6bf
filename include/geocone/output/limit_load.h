// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_limit_load_h
#define geocone_output_limit_load_h

#include <string>
#include <vector>

namespace geocone
{
  /** Point of the load-displacement curve. */
  struct LoadPoint
  {
    double displacement; ///< (m)
    double load;         ///< (N/m)
  };

  /** Final plateau of a load-displacement curve. */
  struct LimitLoad
  {
    bool        found     = false; ///< whether the load has settled
    double      value     = 0.;    ///< mean over the plateau (N/m)
    double      band_low  = 0.;    ///< smallest load on the plateau (N/m)
    double      band_high = 0.;    ///< largest load on the plateau (N/m)
    double      drift     = 0.;    ///< relative, over the last interval
    double      begins_at = 0.;    ///< displacement at its start (m)
    double      peak      = 0.;    ///< largest load of the curve (N/m)
    std::string reason;            ///< why no limit load was found
  };

  /**
   * Determines the limit load as the mean load over the final plateau of a
   * load-displacement curve. Each load acts over the displacement of its step (backward
   * Euler). Among the branches of the curve between reversals of the displacement, the
   * loading branch is the one with the most work, done by the support (footing) or on
   * it (active wall). The plateau is the longest of the last 1/2, 1/4, 1/8 of its
   * displacement over which the load drifts by at most @p tolerance: the means of its
   * two halves differ by less, relative to the mean. If a single step covers nine
   * tenths of a part, it is compared with the load before. The limit load is the mean
   * over the plateau, never the peak, since peaks are due to inertia.
   */
  LimitLoad
  find_limit_load(const std::vector<LoadPoint> &curve, const double tolerance);
} // namespace geocone

#endif
