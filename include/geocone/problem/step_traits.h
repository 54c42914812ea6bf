// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_step_traits_h
#define geocone_problem_step_traits_h

#include <geocone/contact/contact_traits.h>
#include <geocone/materials/law_traits.h>

namespace geocone
{
  /** Properties of the incremental problem of a step on which the solution
   *  strategy depends. */
  struct StepTraits
  {
    LawTraits     law;
    ContactTraits contact;
    bool          has_inertia        = false;
    bool          has_constraints    = false; ///< H v = q has rows
    bool          has_cell_pressures = false; ///< CellPressures
    bool          points_move        = false; ///< material points
    bool          raises_loads       = false; ///< to the limit load

    /** Whether points have a local solver of their own, which excludes the
     *  natural map: laws without one, and cell pressures. */
    bool
    needs_return_map() const
    {
      return !law.has_natural_map || has_cell_pressures;
    }
  };
} // namespace geocone

#endif
