// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The same in three dimensions.
#include "../cone/pyramid_step-01.cc"
