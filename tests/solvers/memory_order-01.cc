// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Friction with memory is stepped by Euler's implicit rule: without inertia, and with
// a memory as long as the run, the load of a footing without dilatancy must change 1.5
// to 2.5 times less with each halving of the step. With a short memory, and inertia,
// it must come near the load of the exact law.

#include "../simulate.h"
#include "../test.h"

#include <cmath>
#include <cstdio>

namespace solvers_memory_order_01
{
  double
  load(const std::vector<std::string> &settings)
  {
    std::vector<std::string> all = settings;
    all.push_back("Output/Expectations =");
    all.push_back("Mesh/Cell size = 0.2");
    const geocone::Json summary =
      simulate(GEOCONE_SOURCE_DIR "/prm/footing_dilatancy_free.prm", all);
    return summary["limit_load"]["last"].get<double>();
  }

  double
  slow_load(const double step)
  {
    return load({"Loading/push/Duration = 0.08",
                 "Loading/push/Step size = " + std::to_string(step),
                 "Time stepping/Inertia = false",
                 "Materials/soil/Friction memory = 0.08"});
  }

  double
  fast_load(const std::string &memory)
  {
    return load({"Loading/push/Duration = 0.1",
                 "Loading/push/Step size = 0.005",
                 "Materials/soil/Friction memory = " + memory});
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    double step = 0.005, last = slow_load(step), change = 0.;
    for (int halving = 1; halving <= 3; ++halving)
      {
        step /= 2.;
        const double next = slow_load(step);
        if (halving > 1)
          std::printf("halving %d: changes 1.5 to 2.5 times less: %s\n",
                      halving,
                      std::abs(change) > 1.5 * std::abs(next - last) &&
                          std::abs(change) < 2.5 * std::abs(next - last)
                        ? "yes"
                        : "NO");
        change = next - last;
        last   = next;
      }
    std::printf("within 2 %% of the exact law: %s\n",
                std::abs(fast_load("0.00125") / fast_load("0") - 1.) < 0.02
                  ? "yes"
                  : "NO");
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_memory_order_01
