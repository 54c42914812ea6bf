// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, the integrator would not be of second order, its error would
// not follow its tolerance, or its guards would let a wild step pass.

#include "../test.h"
#include "subloading_tests.h"

namespace subloading_order_01
{
  using namespace subloading_tests;

  /** Relative distance of two states. */
  double
  distance(const SubloadingState<6> &x, const SubloadingState<6> &y)
  {
    return std::max({(x.stress - y.stress).norm() / y.stress.norm(),
                     (x.a - y.a).norm() / y.stress.norm(),
                     (x.beta - y.beta).norm(),
                     std::abs(x.pcb / y.pcb - 1.),
                     std::abs(x.Rb / y.Rb - 1.)});
  }

  void
  test()
  {
    // One plastic segment: undrained compression from 1 % to 5 %.
    SubloadingState<6> start = structured_state<6>(0);
    SubloadingModel<6>(all_features(1e-9))
      .integrate(start, .01 * axial<6>(1., -.5, 0));
    const Vector6      strain    = .04 * axial<6>(1., -.5, 0);
    SubloadingState<6> reference = start;
    SubloadingModel<6>(all_features(1e-9)).integrate(reference, strain);

    // Steps of one size: nothing is ever rejected with this tolerance.
    const SubloadingModel<6> single(all_features(1e3));
    double                   last = 0.;
    for (const int n : {25, 50, 100, 200, 400, 800})
      {
        SubloadingState<6> y        = start;
        unsigned int       substeps = 0;
        for (int i = 0; i < n; ++i)
          substeps += single.integrate(y, strain / n).substeps;
        const double error = distance(y, reference);
        if (n > 100)
          {
            const double order = std::log2(last / error);
            print("order between 1.95 and 2.1 with " + std::to_string(n) +
                    " substeps",
                  substeps == static_cast<unsigned int>(n) && order > 1.95 &&
                    order < 2.1);
            if (!(order > 1.95 && order < 2.1))
              std::cout << order << " " << error << std::endl;
          }
        last = error;
      }

    // The error follows the tolerance.
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6})
      {
        SubloadingState<6> y = start;
        SubloadingModel<6>(all_features(tolerance)).integrate(y, strain);
        const double error = distance(y, reference);
        print("error below STOL/2", error < tolerance / 2.);
        if (!(error < tolerance / 2.))
          std::cout << error << std::endl;
      }

    // 10 % in one call with a stiff rate of R: trial stages are far out, but
    // nothing that is accepted is, and no substep is forced. For large cR the
    // path is that of the yield surface itself, R = 1.
    for (const double cR : {60., 1e3, 1e4})
      {
        SubloadingConstants c = all_features(1e-3);
        c.cR                  = cR;
        const SubloadingModel<6> model(c);
        SubloadingState<6>       y     = structured_state<6>(1);
        Vector6                  shear = Vector6::Zero();
        shear[3]                       = sqrt2 * .1;
        const SubloadingReport report  = model.integrate(y, shear);
        const double           R       = model.ratio(y);
        print("10 % in one call, cR = " + std::to_string(static_cast<int>(cR)) +
                ", R in its bounds",
              report.forced == 0 && report.substeps < 2000 &&
                R > .999 - 1. / cR && R < 1.002);
        if (!(report.forced == 0 && report.substeps < 2000 &&
              R > .999 - 1. / cR && R < 1.002))
          std::cout << report.substeps << " " << R << std::endl;
      }

    // A smallest substep that is too large is told.
    {
      SubloadingConstants c    = all_features(1e-6);
      c.smallest_substep       = .1;
      SubloadingState<6>     y = start;
      const SubloadingReport report =
        SubloadingModel<6>(c).integrate(y, strain);
      print("forced substeps are counted",
            report.forced > 0 && report.forced <= report.substeps &&
              report.substeps <= 11);
    }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_order_01
