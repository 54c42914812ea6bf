// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_law_traits_h
#define geocone_materials_law_traits_h

#include <cmath>
#include <limits>

namespace geocone
{
  /** Properties of the laws of a scene that methods depend on. */
  struct LawTraits
  {
    bool symmetric       = true;  ///< all tangents are symmetric
    bool has_natural_map = true;  ///< all laws have a natural map
    bool spatial         = false; ///< a law is three-dimensional
    bool can_yield       = false; ///< a law can yield and checks its flow
    bool frictionless    = false; ///< laws yield, all have cylinders (a = 0)
    bool dilates         = false; ///< a law has a cone with dilatancy
    bool undrained       = false; ///< ConstitutiveLaw::fluid_modulus() > 0
    /** Whether the exact law of a material without memory is hard to solve
     *  (Material::hard_flow). */
    bool has_hard_flow = false;

    double non_associativity = 0.; ///< greatest (a - b)/a, 0 to 1
    /** Shortest relaxation time of friction with memory (s); infinite: none. */
    double friction_memory = std::numeric_limits<double>::infinity();

    /** Whether a law has friction with memory. */
    bool
    remembers() const
    {
      return std::isfinite(friction_memory);
    }
  };
} // namespace geocone

#endif
