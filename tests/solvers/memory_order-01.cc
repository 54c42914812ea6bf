// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Friction with memory is stepped by Euler's implicit rule: with a memory of 0.02 s
// the load of a footing without dilatancy, on its climb, must change 1.5 to 3 times
// less with each halving of the step. With a shorter memory it must come near the
// load of the exact law.

#include "../simulate.h"

#include <cmath>
#include <cstdio>

double
load(const double step, const std::string &memory)
{
  const geocone::Json summary =
    simulate(GEOCONE_SOURCE_DIR "/prm/footing_dilatancy_free.prm",
             {"Loading/push/Duration = 0.04",
              "Loading/push/Step size = " + std::to_string(step),
              "Materials/soil/Friction memory = " + memory,
              "Output/Expectations ="});
  return summary["limit_load"]["last"].get<double>();
}

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  double step = 0.01, last = load(step, "0.02"), change = 0.;
  for (int halving = 1; halving <= 3; ++halving)
    {
      step /= 2.;
      const double next = load(step, "0.02");
      if (halving > 1)
        std::printf("halving %d: changes 1.5 to 3 times less: %s\n",
                    halving,
                    std::abs(change) > 1.5 * std::abs(next - last) &&
                        std::abs(change) < 3. * std::abs(next - last)
                      ? "yes"
                      : "NO");
      change = next - last;
      last   = next;
    }
  last               = load(step, "0.0025");
  const double exact = load(step, "0");
  std::printf("within 2 %% of the exact law: %s\n",
              std::abs(last / exact - 1.) < 0.02 ? "yes" : "NO");
}
