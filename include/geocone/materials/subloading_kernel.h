// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_subloading_kernel_h
#define geocone_materials_subloading_kernel_h

#include <geocone/materials/subloading_constants.h>

namespace geocone
{
  /** States of the subloading model at four points, and strain increments: component
   *  by component in the order of SubloadingState, compression positive. */
  template <int n>
  struct SubloadingLanes
  {
    static constexpr int size = 4;

    double stress[n][size], a[n][size], beta[n][size], pcb[size], Rb[size];
    double strain[n][size];

    /** @name Answers */
    /** @{ */
    double plastic_strain[size]; ///< of the increment
    bool   is_done[size];        ///< or else the state is as it was
    /** @} */
  };

  /**
   * Carries four points along their strain increments, each by one substep, where that
   * is all that SubloadingModel::integrate() would do: where the point loads from the
   * start, the error of the whole increment is within the tolerance, and nothing has to
   * be limited. This is the rule in explicit steps. The others are left to it.
   */
  void
  take_single_substeps(const SubloadingNumbers &, SubloadingLanes<4> &);
  void
  take_single_substeps(const SubloadingNumbers &, SubloadingLanes<6> &);
} // namespace geocone

#endif
