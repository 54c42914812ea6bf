// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The program with the law of doc/tutorials/soil.md, for soil-01.sh.

#include "../test.h"
#include "anisotropic_clay.h"

#include <geocone/laws/material_library.h>
#include <geocone/program.h>

#include <cstdlib>

namespace tutorials_soil_01
{
  void
  test(int argc, char **argv)
  {
    geocone::add_law("anisotropic clay", [](const std::string &section) {
      return std::unique_ptr<geocone::ConstitutiveLaw>(
        std::make_unique<geocone::AnisotropicClay>(section));
    });
    std::exit(geocone::run_geocone(argc, argv));
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace tutorials_soil_01
