// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_contact_traits_h
#define geocone_contact_contact_traits_h

namespace geocone
{
  /** Properties of the contact in a step on which the solution strategy
   *  depends. */
  struct ContactTraits
  {
    bool exists           = false; ///< there may be contact
    bool of_bodies        = false; ///< between deformable bodies
    bool has_friction     = false; ///< a node has friction or adhesion
    bool moves_obstacles  = false; ///< motions of obstacles are unknowns
    bool obstacles_loaded = false; ///< obstacles carry loads
  };
} // namespace geocone

#endif
