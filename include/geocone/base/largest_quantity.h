// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_largest_quantity_h
#define geocone_base_largest_quantity_h

namespace geocone
{
  /** Largest admissible magnitude of an input quantity (SI units). The
   *  square of this value is still finite. */
  constexpr double largest_quantity = 1e30;
} // namespace geocone

#endif
