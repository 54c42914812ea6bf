// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_kernel_h
#define geocone_kernels_subloading_kernel_h

#include <geocone/kernels/subloading_constants.h>

namespace geocone
{
  /** State variables and strain increments of the subloading model at four
   *  points, as a structure of arrays. Components in the order of
   *  SubloadingState, compression positive. */
  template <int n>
  struct SubloadingLanes
  {
    static constexpr int size = 4;

    double stress[n][size], a[n][size], beta[n][size], pcb[size], Rb[size];
    double strain[n][size];

    /** @name Results */
    /** @{ */
    double plastic_strain[size]; ///< ||d eps_p|| of the increment (-)
    bool   is_done[size];        ///< if false, the state is unchanged
    /** @} */

    /** Copies the state and the strain increment of a point into a SIMD lane.
     *  @param y a SubloadingState (a template argument, so that kernels need
     *  not include the class) */
    template <typename State, typename Strain>
    void
    put(const State &y, const Strain &of_step, const int lane)
    {
      for (int i = 0; i < n; ++i)
        {
          stress[i][lane] = y.stress[i];
          a[i][lane]      = y.a[i];
          beta[i][lane]   = y.beta[i];
          strain[i][lane] = of_step[i];
        }
      pcb[lane] = y.pcb;
      Rb[lane]  = y.Rb;
    }

    template <typename State>
    void
    take(const int lane, State &y) const
    {
      for (int i = 0; i < n; ++i)
        {
          y.stress[i] = stress[i][lane];
          y.a[i]      = a[i][lane];
          y.beta[i]   = beta[i][lane];
        }
      y.pcb = pcb[lane];
      y.Rb  = Rb[lane];
    }
  };

  /**
   * Integrates the subloading model at four points over their strain
   * increments, in one substep per point. One substep is taken where
   * SubloadingModel::integrate() would take only one: the loading is plastic
   * from the start, the error of the full increment is within the tolerance,
   * and no limit is reached. In explicit steps this is the usual case. The
   * other points are left to integrate().
   */
  void
  take_single_substeps(const DerivedSubloadingConstants &,
                       SubloadingLanes<4> &);
  void
  take_single_substeps(const DerivedSubloadingConstants &,
                       SubloadingLanes<6> &);
} // namespace geocone

#endif
