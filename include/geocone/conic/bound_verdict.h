// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_bound_verdict_h
#define geocone_conic_bound_verdict_h

#include <geocone/base/take_larger.h>

#include <limits>
#include <string>

namespace geocone
{
  /** Load of a lower or an upper bound, and whether its fields prove it. */
  struct BoundVerdict
  {
    double      load      = 0.;
    bool        certified = false;
    std::string rejection; ///< reason for rejection, if not certified

    /** Largest violation of the yield condition (lower bound) or the flow rule
     *  (upper bound) before the stresses or velocities are repaired. For a
     *  lower bound it is the violation of the strength, relative to the largest
     *  stress; for an upper bound it is the violation of the flow rule,
     *  relative to the largest strain rate or jump. */
    double violation = 0.;

    /** Largest residual of equilibrium (lower bound) or of incompressibility
     *  where phi = 0 (upper bound). Lower bound: div s + body force (times the
     *  cell size) and the imbalance of tractions between cells and on the
     *  boundary, relative to the largest stress. Upper bound: volumetric strain
     *  rate and normal jump, relative to the largest rate and jump. */
    double error = 0.;
  };

  /** Comparison of the stresses of a lower bound with equilibrium and with the
   *  strength of all principal stresses. Values that are not numbers lead to a
   *  rejection. */
  struct StressCheck
  {
    double largest   = std::numeric_limits<double>::min(); ///< norm of a stress
    double violation = 0.;    ///< largest excess over a strength k
    double error     = 0.;    ///< largest residual of equilibrium
    double theta     = 1.;    ///< factor that makes all stresses admissible
    bool   is_dead   = false; ///< whether a dead load prevents scaling

    /** Adds a stress. @param utilisation ratio of the stress to the strength
     *  @param k strength at its point @param norm of the stress */
    void
    add(const double utilisation, const double k, const double norm);

    /** Adds a residual of equilibrium. */
    void
    add_error(const double residual);

    /** Judges a lower bound.
     *  @param load for which the unscaled stresses are in equilibrium
     *  @return factor of the certified stresses */
    double
    judge(BoundVerdict &verdict, const double load) const;
  };

  /** Least power of live loads, in scaled units, per largest velocity of an upper bound:
   *  a smaller one is a rounding error of its sum. */
  constexpr double least_work = 1e-12;

  /** Comparison of the velocities of an upper bound with admissible flow.
   *  Values that are not numbers lead to a rejection. */
  struct VelocityCheck
  {
    double largest_rate = std::numeric_limits<double>::min(),
           fastest      = largest_rate; ///< norms of a strain rate, a velocity
    double rate_missed = 0., jump_missed = 0.;
    double volume_change = 0., normal_jump = 0.; ///< where phi = 0

    /** Adds a strain rate. @tparam Flow SpatialStrength::Flow */
    template <typename Flow>
    void
    add_rate(const Flow &flow, const double norm)
    {
      take_larger(largest_rate, norm);
      take_larger(rate_missed, flow.miss);
      take_larger(volume_change, flow.constrained);
    }

    /** Adds a jump of the velocity. */
    template <typename Flow>
    void
    add_jump(const Flow &flow)
    {
      take_larger(jump_missed, flow.miss);
      take_larger(normal_jump, flow.constrained);
    }

    /** Judges an upper bound. @param power dissipation less the power of dead
     *  loads @param work power of the live loads */
    void
    judge(BoundVerdict &verdict, const double power, const double work) const;
  };
} // namespace geocone

#endif
