// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Four points at once, by one substep each, against the model itself: where the kernel
// says that it is done the state is the model's, which takes one substep, too; elsewhere
// it is as it was. Four random walks that load, unload and turn.

#include <geocone/kernels/subloading_kernel.h>

#include "../test.h"
#include "subloading_tests.h"

#include <random>

namespace subloading_single_substeps_01
{
  using namespace subloading_tests;

  template <int n>
  using State = SubloadingState<n>;

  template <int n>
  void
  compare(const std::string &name, const SubloadingConstants &constants)
  {
    using Vector = typename SubloadingModel<n>::Vector;
    const SubloadingModel<n> model(constants);
    std::mt19937             engine(7);
    const auto               random = [&](const double size) {
      return size * (2. * (engine() + 0.5) / 4294967296. - 1.);
    };
    State<n> y[4];
    Vector   direction[4];
    for (int k = 0; k < 4; ++k)
      {
        y[k]         = structured_state<n>(k % 3);
        direction[k] = Vector::Zero();
      }

    Comparison   stress, others, plastic;
    unsigned int n_plastic = 0, n_elastic = 0, n_left = 0, n_more = 0,
                 n_changed = 0;
    for (unsigned int step = 0; step < 4000; ++step)
      {
        SubloadingLanes<n> lanes;
        Vector             strain[4];
        for (int k = 0; k < 4; ++k)
          {
            if (engine() % 40 == 0)
              for (int i = 0; i < n; ++i)
                direction[k][i] = random(1e-5) + (i < 3 ? 2e-6 : 0.);
            strain[k] =
              engine() % 500 == 0 ? 200. * direction[k] : direction[k];
            lanes.put(y[k], strain[k], k);
          }
        take_single_substeps(model.constants(), lanes);
        for (int k = 0; k < 4; ++k)
          {
            const State<n>         before = y[k];
            const SubloadingReport report = model.integrate(y[k], strain[k]);
            State<n>               other;
            lanes.take(k, other);
            if (!lanes.is_done[k])
              {
                ++n_left;
                n_changed +=
                  !(other.stress == before.stress && other.a == before.a &&
                    other.beta == before.beta && other.pcb == before.pcb &&
                    other.Rb == before.Rb);
                continue;
              }
            ++(lanes.plastic_strain[k] > 0. ? n_plastic : n_elastic);
            n_more += report.substeps != 1;
            stress.add((other.stress - y[k].stress).norm(), 0., 100.);
            others.add((other.a - y[k].a).norm(), 0., 100.);
            others.add((other.beta - y[k].beta).norm(), 0., 1.);
            others.add(other.pcb, y[k].pcb);
            others.add(other.Rb, y[k].Rb);
            plastic.add(lanes.plastic_strain[k], report.plastic_strain, 1e-5);
          }
      }
    std::cout << name << ", " << n << " components" << std::endl;
    print("  some are plastic", n_plastic > 1000);
    print("  some are elastic", n_elastic > 1000);
    print("  some are left to the model", n_left > 0 && n_left < 4000);
    print("  those are as they were", n_changed == 0);
    print("  one substep does for the others", n_more == 0);
    stress.print_within("stress/100 kPa", 1e-12);
    others.print_within("the rest of the state", 1e-12);
    plastic.print_within("plastic strain/1e-5", 1e-9);
  }

  void
  test()
  {
    SubloadingConstants all = all_features(1e-4);
    compare<4>("all features", all);
    compare<6>("all features", all);
    all.rotates_with_ph = true;
    all.k               = 1.;
    compare<4>("rotation with ph, a round cone", all);
    compare<6>("rotation with ph, a round cone", all);
    SubloadingConstants plain = cam_clay(1e-4);
    plain.cR                  = 50.;
    compare<4>("subloading surface alone", plain);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_single_substeps_01
