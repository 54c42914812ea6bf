// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The same in three dimensions.
#include "../cone/pyramid_step-01.cc"

namespace three_pyramid_step_01
{
  const RegisteredTest registered(__FILE__, cone_pyramid_step_01::test);
}
