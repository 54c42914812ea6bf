// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_limit_load_h
#define geocone_output_limit_load_h

#include <string>
#include <vector>

namespace geocone
{
  /** A point of the load-displacement curve. */
  struct LoadPoint
  {
    double displacement; ///< (m)
    double load;         ///< (N/m)
  };

  /** The plateau at the end of a load-displacement curve. */
  struct LimitLoad
  {
    bool   found     = false; ///< whether the load has settled
    double value     = 0.;    ///< mean over the plateau (N/m)
    double band_low  = 0.;    ///< smallest load on the plateau
    double band_high = 0.;    ///< largest load on the plateau
    double drift     = 0.;    ///< relative, over the last part tried
    double begins_at = 0.;    ///< where the plateau begins, from the start of
                              ///< the loading branch (m)
    double      peak = 0.;    ///< largest load of the whole curve
    std::string reason;       ///< why it has not been found
  };

  /**
   * Finds the limit load. Each load holds over the displacement of its step
   * (backward Euler). Of the branches of the curve between reversals of the
   * displacement, the one with the most work is the loading: taken from
   * the support (footing) or given to it (active wall). The plateau
   * is the longest of the last 1/2, 1/4, 1/8 of its displacement over which the
   * load drifts by at most @p tolerance: the means of the two halves of that
   * part differ by less, relative to its mean. A part of which a single step
   * covers nine tenths is compared with the load before. The limit load is the mean
   * over the plateau, never the peak: peaks are inertia.
   */
  LimitLoad
  find_limit_load(const std::vector<LoadPoint> &curve, const double tolerance);
} // namespace geocone

#endif
