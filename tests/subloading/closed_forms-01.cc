// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, the model would not be Modified Cam Clay where its features
// are off, or subloading, structure and the tensile apex would not follow their
// closed forms. Formulas stand beside the numbers.

#include "../test.h"
#include "subloading_tests.h"

#include <utility>

namespace subloading_closed_forms_01
{
  using namespace subloading_tests;

  /**
   * Triaxial compression along x at a constant lateral stress: the lateral strain
   * that keeps it is solved for in each of many increments.
   */
  void
  drained(const SubloadingModel<6> &model,
          SubloadingState<6>       &y,
          const double              axial_strain,
          const int                 n)
  {
    const double lateral = y.stress[1];
    double       e_r     = 0.;
    for (int i = 0; i < n; ++i)
      {
        const auto state = [&](const double e) {
          SubloadingState<6> z = y;
          model.integrate(z, axial<6>(axial_strain / n, e, 0));
          return z;
        };
        for (int j = 0; j < 20; ++j)
          {
            const double step = 1e-3 * axial_strain / n;
            const double f    = state(e_r).stress[1] - lateral;
            if (std::abs(f) < 1e-9 * lateral)
              break;
            e_r -= f * step / (state(e_r + step).stress[1] - lateral - f);
          }
        y = state(e_r);
      }
  }

  void
  check_cam_clay(const Accuracy &accuracy)
  {
    const SubloadingModel<6> model(cam_clay(accuracy.tolerance));

    // p = pc = 100 exp(.05/.08); swelling by .02: p exp(-.02/.01)
    Comparison isotropic;
    auto       y = isotropic_state<6>(100., 0., 100.);
    model.integrate(y, axial<6>(.05 / 3., .05 / 3., 0));
    isotropic.add(pressure(y.stress), 186.8245957432);
    isotropic.add(y.pcb, 186.8245957432);
    model.integrate(y, axial<6>(-.02 / 3., -.02 / 3., 0));
    isotropic.add(pressure(y.stress), 25.2839595804746);
    isotropic.print_within("isotropic", accuracy.bound);

    // p = p0 (M^2/(M^2 + eta^2))^L, L = 1 - kappa/lambda;
    // eps_q = (kappa L/M)(ln((M+eta)/(M-eta)) - 2 atan(eta/M))
    //         + kappa/(3 G/K) (eta - 2 L (eta - M atan(eta/M)))
    Comparison   undrained;
    const double rows[][4] = {
      {.001, 98.1421583349, 17.3340967571, 100.2682615098},
      {.005, 78.5165561075, 53.1646567298, 103.5155363768},
      {.01, 64.9533158970, 62.2311792101, 106.3582637388},
      {.02, 56.8764992039, 64.9575509795, 108.3950853841},
      {.05, 54.5623400595, 65.4241119124, 109.0402192317},
      {.10, 54.5254254804, 65.4304573004, 109.0507621674}};
    y           = isotropic_state<6>(100., 0., 100.);
    double last = 0.;
    for (const auto &row : rows)
      {
        model.integrate(y, (row[0] - last) * axial<6>(1., -.5, 0));
        last = row[0];
        undrained.add(pressure(y.stress), row[1]);
        undrained.add(deviatoric(y.stress), row[2]);
        undrained.add(y.pcb, row[3]);
      }
    undrained.print_within("undrained", accuracy.bound);

    // eps_v = (lambda-kappa)(ln(3/(3-eta)) + ln(1+eta^2/M^2))
    //         + kappa ln(3/(3-eta)), eps_q by quadrature; pc = p (1+eta^2/M^2)
    Comparison   drained_rows;
    const double states[][5] = {
      {.008812729190,
       .012672564780,
       111.1111111111,
       33.3333333333,
       118.0555555556},
      {.032670840468, .033471532697, 125., 75., 156.25},
      {.089074818882,
       .059774092699,
       142.8571428571,
       128.5714285714,
       223.2142857143},
      {.190784230081,
       .079234829048,
       157.8947368421,
       173.6842105263,
       290.5701754386},
      {.412819382347,
       .088359811571,
       165.7458563536,
       197.2375690608,
       328.7407918969}};
    y    = isotropic_state<6>(100., 0., 100.);
    last = 0.;
    for (const auto &row : states)
      {
        drained(model, y, row[0] - last, 2000);
        last = row[0];
        drained_rows.add(pressure(y.stress), row[2]);
        drained_rows.add(deviatoric(y.stress), row[3]);
        drained_rows.add(y.pcb, row[4]);
      }
    drained_rows.print_within("drained", accuracy.bound);
  }

  void
  check_subloading(const Accuracy &accuracy)
  {
    // eps_v^p = -(sqrt3/cR)(1-Rmin)(li(x) - li(x0)), x = (R-Rmin)/(1-Rmin),
    // pc = pc0 exp(eps_v^p/(lambda-kappa)), p = R pc; li: logarithmic integral
    SubloadingConstants c = cam_clay(accuracy.tolerance);
    c.cR                  = 200.;
    const SubloadingModel<4> model(c);
    Comparison               compared;
    const double             rows[][4] = {
                  {.005, 66.2283807400, 103.1767568599, .641892445117},
                  {.01, 81.7457274891, 107.5332507309, .760190238215},
                  {.02, 107.8230864511, 119.2358203723, .904284351082},
                  {.04, 149.4630371530, 151.4365091297, .986968320994}};
    auto   y    = isotropic_state<4>(50., 0., 100.);
    double last = 0.;
    for (const auto &row : rows)
      {
        const double e = (row[0] - last) / 3.;
        last           = row[0];
        model.integrate(y, axial<4>(e, e, 0));
        compared.add(pressure(y.stress), row[1]);
        compared.add(y.pcb, row[2]);
        compared.add(model.ratio(y), row[3]);
      }
    compared.print_within("subloading", accuracy.bound);
  }

  void
  check_compression_line(const Accuracy &accuracy)
  {
    // p = (1-xi) pc stays on the line p + pe = (p0 + pe) exp(eps_v/lambda).
    SubloadingConstants c = cam_clay(accuracy.tolerance);
    c.xi                  = 0.1;
    c.pe                  = 5.;
    const SubloadingModel<6> model(c);
    auto                     y = isotropic_state<6>(90., 0., 100.);
    model.integrate(y, axial<6>(.01, .01, 0));
    Comparison compared;
    compared.add(pressure(y.stress) + c.pe, 95. * std::exp(.03 / c.lambda));
    compared.add(y.pcb, pressure(y.stress) / (1. - c.xi));
    compared.print_within("compression line with xi and pe", accuracy.bound);
  }

  void
  check_structure(const Accuracy &accuracy)
  {
    // Rb = Rbf + (Rb0 - Rbf) exp(-cb times the integral of ||d eps_p||), and
    // pcb = Rb pc with ln pc = ln pc0 + eps_v^p/(lambda - kappa); on the
    // isotropic line eps_v^p = sqrt3 times that integral.
    SubloadingConstants c = cam_clay(accuracy.tolerance);
    c.cb                  = 15.;
    c.Rbf                 = 1.2;
    const SubloadingModel<6> model(c);
    auto                     y = isotropic_state<6>(100., 0., 100.);
    y.Rb                       = 2.;
    const auto   report        = model.integrate(y, axial<6>(.02, .02, 0));
    const double norm          = report.plastic_strain;
    Comparison   compared;
    compared.add(y.Rb, 1.2 + .8 * std::exp(-15. * norm));
    compared.add(y.pcb,
                 y.Rb * 50. * std::exp(std::sqrt(3.) * norm / (.08 - .01)));
    // The rest of the strain is elastic: p = 100 exp(eps_v^e/kappa).
    compared.add(pressure(y.stress),
                 100. * std::exp((.06 - std::sqrt(3.) * norm) / .01));
    compared.print_within("loss of structure", accuracy.bound);
  }

  void
  test()
  {
    for (const Accuracy &accuracy : accuracies)
      {
        std::cout << "STOL " << accuracy.tolerance << std::endl;
        check_cam_clay(accuracy);
        check_subloading(accuracy);
        check_compression_line(accuracy);
        check_structure(accuracy);
      }

    // Overconsolidated, undrained: the critical state is p = p0 (pc0/(2 p0))^L
    // and q = M p, which it tends to with strain.
    for (const double p0 : {60., 30.})
      {
        SubloadingConstants c = cam_clay(1e-4);
        c.cR                  = 1000.;
        const SubloadingModel<6> model(c);
        auto                     y = isotropic_state<6>(p0, 0., 100.);
        model.integrate(y, .5 * axial<6>(1., -.5, 0));
        Comparison   compared;
        const double p = p0 * std::pow(100. / (2. * p0), 7. / 8.);
        compared.add(pressure(y.stress), p);
        compared.add(deviatoric(y.stress), 1.2 * p);
        compared.print_within(p0 > 50. ? "overconsolidated, wet side"
                                       : "overconsolidated, dry side",
                              p0 > 50. ? 5e-4 : 2e-3);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_closed_forms_01
