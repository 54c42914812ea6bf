// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Pore pressures by the pore pressure ratio are half of the weight of the soil columns in two
// layers below a slope, by hand: at (2, 1) 0.5 (4 m 20 kN/m^3 + 5 m 16 kN/m^3) = 80 kPa, at (10, 5),
// 2 m below the face, 0.5 (20 + 16) = 18 kPa. On the face, of slope -0.6, -grad u has the horizontal
// component 0.5 x 0.6 x 20 = 6 kN/m^3 where the upper layer is on top, 4.8 where the lower one is.
// Lines of the mesh are below the crest, below the toe, and below the layer's exit on the face, x = 35/3.

#include <geocone/scene/scene.h>

#include "../test.h"

#include <cstdio>

namespace mechanics_soil_columns_01
{
  using namespace geocone;
  using Place = dealii::Point<2>;

  void
  test()
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file(
      GEOCONE_SOURCE_DIR "/tests/mechanics/soil_columns.prm", {});
    Scene scene(file);
    file.parse();
    scene.prepare();
    for (const Place &x : {Place(2., 8.),
                           Place(2., 1.),
                           Place(10., 5.),
                           Place(10., 6.5),
                           Place(13., 2.),
                           Place(18., 0.),
                           Place(18., 5.)})
      {
        const auto f = scene.water.force(x);
        std::printf("u(%g, %g) = %.6f kPa, -grad u = (%.6f, %.6f) kN/m^3\n",
                    x[0],
                    x[1],
                    scene.water.pressure(x) / 1e3,
                    f[0] / 1e3 + 0., // no -0
                    f[1] / 1e3 + 0.);
      }
    for (const auto &[a, b] : scene.water.lines(Place(0., 0.), Place(20., 10.)))
      std::printf(
        "line from (%.6f, %.6f) to (%.6f, %.6f)\n", a[0], a[1], b[0], b[1]);
    std::printf("level: %d\n", scene.water.is_level());
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_soil_columns_01
