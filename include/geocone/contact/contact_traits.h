// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_contact_traits_h
#define geocone_contact_contact_traits_h

namespace geocone
{
  /** Features of the contact problem in a step that determine the solution
   *  strategy. */
  struct ContactTraits
  {
    bool exists             = false; ///< contact is possible
    bool of_bodies          = false; ///< contact between deformable bodies
    bool has_friction       = false; ///< friction or adhesion at some node
    bool has_free_obstacles = false; ///< motions of obstacles are unknowns
    bool obstacles_loaded   = false; ///< loads act on free obstacles
  };
} // namespace geocone

#endif
