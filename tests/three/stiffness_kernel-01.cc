// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The same in three dimensions.
#include "../mechanics/stiffness_kernel-01.cc"

namespace three_stiffness_kernel_01
{
  const RegisteredTest registered(__FILE__,
                                  mechanics_stiffness_kernel_01::test);
}
