// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_law_traits_h
#define geocone_materials_law_traits_h

#include <cmath>
#include <limits>

namespace geocone
{
  /** Properties of the laws of a scene on which its methods depend. */
  struct LawTraits
  {
    bool symmetric       = true;  ///< all tangents are symmetric
    bool has_natural_map = true;  ///< all laws have one
    bool spatial         = false; ///< a law is one of all principal stresses
    bool can_yield       = false; ///< a law has a strength, and checks its flow
    bool frictionless    = false; ///< laws yield, and all by cylinders (a = 0)
    bool dilates         = false; ///< a law has a cone along which soil dilates
    bool undrained       = false; ///< ConstitutiveLaw::fluid_modulus() > 0
    /** The exact law of one is hard (Material::hard_flow), without a memory. */
    bool has_hard_flow = false;

    double non_associativity = 0.; ///< greatest (a - b)/a, 0 to 1
    /** Least relaxation time of friction with memory (s); infinite: there is none. */
    double friction_memory = std::numeric_limits<double>::infinity();

    /** Whether friction of a law has a memory. */
    bool
    remembers() const
    {
      return std::isfinite(friction_memory);
    }
  };
} // namespace geocone

#endif
