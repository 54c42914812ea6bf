// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, one of the rate equations would be wrong: all intermediate
// results of one evaluation in a general state are compared with reference
// numbers (an implementation of the literal equations in another language), and
// the plastic modulus with its other form, from the derivatives of fbar.

#include "../test.h"
#include "subloading_tests.h"

namespace subloading_rates_01
{
  using namespace subloading_tests;

  /** A tensor xx, yy, zz, xy, yz, zx as Mandel vector. */
  Vector6
  tensor(const double xx,
         const double yy,
         const double zz,
         const double xy,
         const double yz,
         const double zx)
  {
    Vector6 x;
    x << xx, yy, zz, sqrt2 * xy, sqrt2 * yz, sqrt2 * zx;
    return x;
  }

  void
  compare(const std::string &what,
          const Vector6     &value,
          const Vector6     &expected,
          const double       bound = 1e-9)
  {
    Comparison c;
    c.add((value - expected).norm(), 0., expected.norm());
    c.print_within(what, bound);
  }

  void
  compare(const std::string &what,
          const double       value,
          const double       expected,
          const double       bound = 1e-9)
  {
    Comparison c;
    c.add(value, expected);
    c.print_within(what, bound);
  }

  /**
   * H from df = 0 as it stands:
   * H = (1-R) N:h_a + U ||m|| N:(sy-a) - R (fbar_beta:h_beta + fbar_pc h_pc),
   * fbar_beta = -(3/M^2) p_y sh, fbar_pc = xi (2 ph - pcb) - ph.
   */
  template <int n>
  double
  modulus(const SubloadingModel<n> &model,
          const SubloadingState<n> &y,
          const double              R,
          const SubloadingRates<n> &r)
  {
    const SubloadingConstants &c  = model.constants();
    const double               ph = pressure(r.sy) + c.xi * y.pcb;
    // With ph in (24), sh depends on pcb, too.
    const double sh_beta = 3. / (c.M * c.M) * r.sh.dot(y.beta);
    const double f_pc =
      c.xi * (2. * ph - y.pcb) - ph - (c.rotates_with_ph ? c.xi * sh_beta : 0.);
    const double f_beta_h = -3. / (c.M * c.M) * r.p_y * r.sh.dot(r.h_beta);
    return (1. - R) * r.N.dot(r.h_a) + r.U * r.norm_m * r.N.dot(r.sy - y.a) -
           R * (f_beta_h + f_pc * r.h_pc);
  }

  void
  test()
  {
    SubloadingState<6> y;
    y.stress             = tensor(60., 100., 60., 20., -10., 5.);
    y.a                  = tensor(30., 50., 32., 5., 0., 2.);
    y.beta               = tensor(-.1, .2, -.1, .05, .02, -.03);
    y.pcb                = 260.;
    y.Rb                 = 2.;
    const Vector6 strain = tensor(1e-4, 3e-4, -1e-4, 2e-4, -1e-4, 5e-5);

    SubloadingConstants      constants = all_features(1e-7);
    const SubloadingModel<6> model(constants);
    const double             R = model.ratio(y);
    const auto               r = model.rates(y, R, strain);
    std::cout << "one evaluation:" << std::endl;
    compare("R", R, .338965260754);
    compare("fbar(a)", model.yield_function(y.a, y.beta, y.pcb), -9055.568056);
    compare("h of Willam and Warnke", r.lode, .887544393701);
    compare("eta_beta,cs", r.eta_b, .774533500182);
    compare("K", r.K, 7533.333333);
    compare("G", r.G, 4520.);
    compare("U", r.U, 66.1051673011);
    compare("||m||", r.norm_m, 486.388623533);
    compare("tr m", r.trace_m, -17.971043426);
    compare("sy",
            r.sy,
            tensor(118.5046448,
                   197.5077413,
                   114.6043351,
                   49.2523224,
                   -29.50154826,
                   10.85046448));
    compare("st",
            r.st,
            tensor(118.4427983,
                   197.0302639,
                   114.5814918,
                   48.82219917,
                   -29.18157278,
                   10.70451983));
    compare("N",
            r.N,
            tensor(-52.54282862,
                   115.9325983,
                   -70.82553012,
                   197.2283299,
                   -151.74528,
                   71.04671106));
    compare("m",
            r.m,
            tensor(-67.79805373,
                   140.1963005,
                   -90.36929015,
                   243.4917653,
                   -187.3398519,
                   87.71198896));
    compare("h_a",
            r.h_a,
            tensor(1151093.321,
                   1994328.889,
                   1057749.788,
                   679781.997,
                   -467732.836,
                   145483.9608));
    compare("h_beta",
            r.h_beta,
            tensor(-593.9352619,
                   1187.870524,
                   -593.9352619,
                   1604.110546,
                   -1122.998717,
                   704.1408893));
    compare("h_pc", r.h_pc, -1016255.28001);
    compare("h_Rb", r.h_Rb, -7295.829353);
    compare("H", r.H, 1461385848.07);
    compare("N:D:m", r.N_D_m, 1732507065.07);
    compare("N:D:de", r.N_D_strain, 1372.61321138);
    compare("dLambda", r.d_lambda, 4.29761813782e-7);
    compare("dsigma",
            r.increment.stress,
            tensor(2.558307784,
                   3.558239984,
                   .8379980935,
                   .8620230973,
                   -.1761759086,
                   .1112348183));
    compare("da",
            r.increment.a,
            tensor(.4946959533,
                   .8570864006,
                   .4545804672,
                   .292144344,
                   -.201013712,
                   .06252345089));
    compare("dpcb", r.increment.pcb, -.436747712403);
    compare("dRb", r.increment.Rb, -.00313546885579);
    // (31) by the difference of R over a tiny increment: dR = .0138180462186.
    SubloadingState<6> z     = y;
    const double       small = 1e-6;
    z.stress += small * r.increment.stress;
    z.a += small * r.increment.a;
    z.beta += small * r.increment.beta;
    z.pcb += small * r.increment.pcb;
    compare("dR", (model.ratio(z) - R) / small, .0138180462186, 1e-6);
    // Elastic in the reverse direction: dR_e = -.0400566113709.
    z = y;
    model.integrate(z, -small * strain);
    compare("elastic dR", (model.ratio(z) - R) / small, -.0400566113709, 1e-5);
    print("  nothing plastic in the reverse direction",
          model.rates(y, R, -strain).d_lambda == 0. && z.pcb == y.pcb &&
            z.a == y.a && z.beta == y.beta && z.Rb == y.Rb);

    // Willam and Warnke's h in pure shear, at k = 0.6, 5/7, 0.8: closed form.
    std::cout << "h in pure shear:" << std::endl;
    const double shear[][2] = {
      {.6, .682803583013}, {5. / 7., .792823736882}, {.8, .866025403784}};
    // The same with principal deviators 2, -0.5, -1.5.
    const double skew[] = {.798352045547, .888704988758, .936749699760};
    for (int i = 0; i < 3; ++i)
      {
        constants   = all_features(1e-7);
        constants.k = shear[i][0];
        constants.M = 0.5;
        const SubloadingModel<6> six(constants);
        const SubloadingModel<4> four(constants);
        SubloadingState<6>       s = structured_state<6>(0);
        SubloadingState<4>       p = structured_state<4>(0);
        const auto               h = [&](const Vector6 &x) {
          s.stress = x;
          return six.rates(s, six.ratio(s), strain).lode;
        };
        compare(
          "pure shear, n = 6", h(tensor(60, 60, 60, 0, 20, 0)), shear[i][1]);
        compare("skew, n = 6", h(tensor(45, 80, 55, 0, 0, 0)), skew[i]);
        compare("compression, n = 6", h(tensor(60, 100, 60, 0, 0, 0)), 1.);
        compare(
          "extension, n = 6", h(tensor(60, 60, 40, 0, 0, 0)), shear[i][0]);
        p.stress << 60., 60., 60., 20.;
        compare("pure shear, n = 4",
                four.rates(p, four.ratio(p), Vector4::Zero()).lode,
                shear[i][1]);
      }

    // (32) on the axis, where s/||s|| is nothing: beta fades,
    // h_beta = -cbeta ||dev m|| (p/patm) beta; and where p < 0: it stays.
    std::cout << "rotation on the axis:" << std::endl;
    for (const double p : {60., -1.})
      {
        const SubloadingModel<6> m(all_features(1e-7));
        SubloadingState<6>       x = y;
        x.stress                   = tensor(p, p, p, 0., 0., 0.);
        x.a                        = tensor(10., 10., 10., 0., 0., 0.);
        const auto rates           = m.rates(x, m.ratio(x), strain);
        Vector6    dev_m           = rates.m;
        dev_m.head<3>().array() -= pressure(rates.m);
        compare("h_beta + I",
                tensor(1., 1., 1., 0., 0., 0.) + rates.h_beta,
                tensor(1., 1., 1., 0., 0., 0.) -
                  20. * dev_m.norm() * std::max(p, 0.) / 100. * x.beta,
                1e-12);
        print("  it turns", (rates.h_beta.norm() > 1.) == (p > 0.));
      }

    // Both forms of H, in states along a path with reversals.
    std::cout << "the two forms of H:" << std::endl;
    for (const bool with_ph : {false, true})
      {
        constants                 = all_features(1e-5);
        constants.rotates_with_ph = with_ph;
        const SubloadingModel<6> m(constants);
        SubloadingState<6>       x = y;
        Comparison               forms;
        for (int i = 0; i < 40; ++i)
          {
            const double ratio = m.ratio(x);
            const auto   rates = m.rates(x, ratio, strain);
            forms.add(rates.H, modulus(m, x, ratio, rates));
            m.integrate(x, (i % 8 < 5 ? 5. : -6.) * strain);
          }
        forms.print_within(with_ph ? "(24) with ph" : "(24) with p", 1e-13);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_rates_01
