// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_law_traits_h
#define geocone_materials_law_traits_h

#include <cmath>
#include <limits>

namespace geocone
{
  /** Summary of the properties of all constitutive laws in a scene. */
  struct LawTraits
  {
    bool symmetric       = true;  ///< all tangents are symmetric
    bool has_natural_map = true;  ///< all laws have a natural map
    bool spatial         = false; ///< any law is three-dimensional
    bool can_yield       = false; ///< any law can yield, with check_flow()
    bool frictionless    = false; ///< some laws yield, all on cylinders (a = 0)
    bool dilates         = false; ///< any law has plastic dilatancy
    bool undrained       = false; ///< any soil is undrained
    /** True if any law without friction memory is strongly non-associated
     *  (degree above Material::strong_non_associativity). */
    bool strongly_non_associated = false;

    double non_associativity = 0.; ///< largest degree, from 0 to 1
    /** Shortest relaxation time of friction with memory over all laws (s);
     *  infinite if no law has friction memory. */
    double friction_memory = std::numeric_limits<double>::infinity();

    /** Returns true if any law has friction memory, i.e. a strength that
     *  follows the normal stress with a delay. */
    bool
    has_friction_memory() const
    {
      return std::isfinite(friction_memory);
    }
  };
} // namespace geocone

#endif
