// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_step_traits_h
#define geocone_terms_step_traits_h

#include <geocone/contact/contact_traits.h>
#include <geocone/materials/law_traits.h>

namespace geocone
{
  /** Features of an incremental problem that determine the solution strategy. */
  struct StepTraits
  {
    LawTraits     law;
    ContactTraits contact;
    bool          has_inertia        = false;
    bool          has_constraints    = false; ///< linear constraints H v = q
    bool          has_cell_pressures = false; ///< CellPressures are used
    bool          points_move        = false; ///< material points (MPM)
    bool          scales_loads       = false; ///< load stepping to the limit

    /** Returns true if stresses must be computed by return mapping (not by the
     *  natural map). Some laws have no natural map, and cell pressures exclude
     *  it. */
    bool
    needs_return_map() const
    {
      return !law.has_natural_map || has_cell_pressures;
    }
  };
} // namespace geocone

#endif
