// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_contact_traits_h
#define geocone_contact_contact_traits_h

namespace geocone
{
  /** Properties of the contact of a step on which it depends how it is solved. */
  struct ContactTraits
  {
    bool exists           = false; ///< something may touch
    bool of_bodies        = false; ///< bodies may touch each other
    bool rubs             = false; ///< a node has friction or adhesion
    bool moves_obstacles  = false; ///< motions of obstacles are unknowns
    bool obstacles_loaded = false; ///< these bear loads of their own
  };
} // namespace geocone

#endif
