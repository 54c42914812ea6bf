// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_largest_quantity_h
#define geocone_base_largest_quantity_h

namespace geocone
{
  /** No quantity of a file in SI units is larger; squares of it are still numbers. */
  constexpr double largest_quantity = 1e30;
} // namespace geocone

#endif
