// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Delayed friction is a time discretisation of at least first order: the load of a
// footing without dilatancy, on its climb, must change at least 1.8 times less with
// each halving of the step, and come near that of the exact law. Measured: changes
// of 797, 279 and 104 N/m, and 1.3 % from 16820 N/m by the exact law.

#include "../simulate.h"

#include <cmath>
#include <cstdio>

double
load(const double step, const std::string &friction)
{
  const geocone::Json summary =
    simulate(GEOCONE_SOURCE_DIR "/prm/footing_dilatancy_free.prm",
             {"Loading/push/Duration = 0.04",
              "Loading/push/Step size = " + std::to_string(step),
              "Time stepping/Friction = " + friction,
              "Output/Expectations ="});
  return summary["limit_load"]["last"].get<double>();
}

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  double step = 0.01, last = load(step, "delayed"), change = 0.;
  for (int halving = 1; halving <= 3; ++halving)
    {
      step /= 2.;
      const double next = load(step, "delayed");
      if (halving > 1)
        std::printf("halving %d: changes 1.8 to 4 times less: %s\n",
                    halving,
                    std::abs(change) > 1.8 * std::abs(next - last) &&
                        std::abs(change) < 4. * std::abs(next - last)
                      ? "yes"
                      : "NO");
      change = next - last;
      last   = next;
    }
  const double exact = load(step, "exact");
  std::printf("within 2 %% of the exact law: %s\n",
              std::abs(last / exact - 1.) < 0.02 ? "yes" : "NO");
}
