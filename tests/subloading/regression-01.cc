// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a path would not end where the equations lead: the moving
// centre, anisotropy, and all features together, with reversals, in 3D and in
// plane strain, compared with reference numbers.

#include "../test.h"
#include "subloading_tests.h"

namespace subloading_regression_01
{
  using namespace subloading_tests;

  /** S1: the centre moves (ca = 50, cR = 100); isotropic, then undrained. */
  void
  check_centre(const Accuracy &accuracy)
  {
    SubloadingConstants c = cam_clay(accuracy.tolerance);
    c.cR                  = 100.;
    c.ca                  = 50.;
    const SubloadingModel<6> model(c);
    auto                     y = isotropic_state<6>(40., .5, 100.);
    Comparison               compared;
    // eps_v, p, R, pcb, a
    const double rows[][5] = {
      {.01, 69.352385815, .502818057, 106.634812490, 31.6473211},
      {-.005, 42.064348321, .138916865, 106.634812490, 31.6473211},
      {.01, 74.274689581, .444691682, 113.413783392, 42.9320482}};
    compared.add(model.ratio(y), .25);
    for (const auto &row : rows)
      {
        model.integrate(y, axial<6>(row[0] / 3., row[0] / 3., 0));
        compared.add(pressure(y.stress), row[1]);
        compared.add(model.ratio(y), row[2]);
        compared.add(y.pcb, row[3]);
        compared.add(y.a[0], row[4]);
        compared.add(y.a[1], row[4]);
      }
    model.integrate(y, .02 * axial<6>(1., -.5, 0));
    compared.add(pressure(y.stress), 58.683057800);
    compared.add(deviatoric(y.stress), 68.226808675);
    compared.add(model.ratio(y), .928731481);
    compared.add(y.pcb, 117.296253242);
    compared.add(y.a[0], 82.5955696);
    compared.add(y.a[1], 42.3898587);
    compared.print_within("S1, moving centre", accuracy.bound);
  }

  /** S3: anisotropy from an isotropic start, undrained compression. */
  void
  check_anisotropy(const Accuracy &accuracy)
  {
    SubloadingConstants c = cam_clay(accuracy.tolerance);
    c.M                   = .8;
    c.k                   = 5. / 7.;
    c.cbeta               = 30.;
    c.cR                  = 1000.;
    const SubloadingModel<6> model(c);
    auto                     y = isotropic_state<6>(100., 0., 100.);
    Comparison               compared;
    // eps_a, p, q, pcb, beta_xx
    const double rows[][5] = {
      {.02, 69.461695196, 61.679388015, 105.343514459, .208653495},
      {.2, 88.727354194, 106.330356335, 101.723279393, .594815177},
      {1.0, 88.766127243, 106.519352691, 101.716930671, .596284794}};
    double last = 0.;
    for (const auto &row : rows)
      {
        model.integrate(y, (row[0] - last) * axial<6>(1., -.5, 0));
        last = row[0];
        compared.add(pressure(y.stress), row[1]);
        compared.add(deviatoric(y.stress), row[2]);
        compared.add(y.pcb, row[3]);
        compared.add(y.beta[0], row[4]);
        compared.add(y.beta[1], -row[4] / 2.);
        compared.add(y.beta[2], -row[4] / 2.);
      }
    compared.print_within("S3, anisotropy", accuracy.bound);
  }

  /** F1, F7: all features, undrained triaxial compression along x. */
  void
  check_compression(const Accuracy &accuracy, const bool with_ph)
  {
    SubloadingConstants c = all_features(accuracy.tolerance);
    c.rotates_with_ph     = with_ph;
    const SubloadingModel<6> model(c);
    auto                     y = structured_state<6>(0);
    Comparison               compared;
    compared.add(model.ratio(y), with_ph ? .185462507 : .186457907);
    // eps_a, sigma axial and lateral, R, pcb, Rb, a axial and lateral, beta axial
    const double rows[][9]         = {{.001,
                                       105.633491,
                                       56.2038619,
                                       .222861210,
                                       259.602157425,
                                       1.994418976,
                                       52.818537,
                                       31.3880603,
                                       .202337857},
                                      {.01,
                                       152.391202,
                                       53.7607814,
                                       .584690806,
                                       240.897084113,
                                       1.897311250,
                                       80.4841175,
                                       36.6442622,
                                       .245980389},
                                      {.05,
                                       253.445535,
                                       95.1609887,
                                       .978851014,
                                       170.818934406,
                                       1.452093762,
                                       193.239767,
                                       65.893398,
                                       .521405534},
                                      {.10,
                                       225.762941,
                                       76.9764511,
                                       .999503183,
                                       141.838941059,
                                       1.179122946,
                                       215.466321,
                                       72.0903188,
                                       .614692947}};
    const double rows_with_ph[][9] = {{.05,
                                       255.277648,
                                       94.3496248,
                                       .978589860,
                                       170.959725401,
                                       1.453388904,
                                       194.612868,
                                       64.9895933,
                                       .52073353}};
    double       last              = 0.;
    const auto   check             = [&](const double(&row)[9]) {
      model.integrate(y, (row[0] - last) * axial<6>(1., -.5, 0));
      last = row[0];
      compared.add(y.stress[0], row[1]);
      compared.add(y.stress[1], row[2]);
      compared.add(y.stress[2], row[2]);
      compared.add(model.ratio(y), row[3]);
      compared.add(y.pcb, row[4]);
      compared.add(y.Rb, row[5]);
      compared.add(y.a[0], row[6]);
      compared.add(y.a[1], row[7]);
      compared.add(y.beta[0], row[8]);
      compared.add(y.beta[1], -row[8] / 2.);
    };
    if (with_ph)
      for (const auto &row : rows_with_ph)
        check(row);
    else
      for (const auto &row : rows)
        check(row);
    compared.print_within(with_ph ? "F7, all features, (24) with ph"
                                  : "F1, all features",
                          accuracy.bound);
  }

  /** F3: all features, oedometric along y with unloading. */
  template <int n>
  void
  check_oedometer(const Accuracy &accuracy)
  {
    const SubloadingModel<n> model(all_features(accuracy.tolerance));
    auto                     y = structured_state<n>(1);
    Comparison               compared;
    // eps_yy increment, sigma yy and xx, R, pcb, Rb, a yy and xx, beta yy
    const double rows[][9] = {{.05,
                               518.276798,
                               223.236039,
                               .947767703,
                               339.200593841,
                               1.563263016,
                               382.505701,
                               160.980995,
                               .537578918},
                              {-.01,
                               201.421298,
                               95.2470798,
                               .388483244,
                               329.405939557,
                               1.541990476,
                               345.156446,
                               146.753814,
                               .5450071},
                              {.02,
                               536.727806,
                               217.631238,
                               .674875665,
                               364.536577915,
                               1.456115797,
                               445.210848,
                               179.907188,
                               .582658078}};
    for (const auto &row : rows)
      {
        model.integrate(y, axial<n>(row[0], 0., 1));
        compared.add(y.stress[1], row[1]);
        compared.add(y.stress[0], row[2]);
        compared.add(y.stress[2], row[2]);
        compared.add(model.ratio(y), row[3]);
        compared.add(y.pcb, row[4]);
        compared.add(y.Rb, row[5]);
        compared.add(y.a[1], row[6]);
        compared.add(y.a[0], row[7]);
        compared.add(y.beta[1], row[8]);
      }
    compared.print_within("F3, oedometric, n = " + std::to_string(n),
                          accuracy.bound);
  }

  /**
   * F4: all features, cyclic simple shear at constant volume.
   * @param n_calls increments that each leg is cut into: the tables do not depend
   * on it
   */
  template <int n>
  void
  check_shear(const Accuracy &accuracy, const int n_calls)
  {
    const SubloadingModel<n> model(all_features(accuracy.tolerance));
    auto                     y = structured_state<n>(1);
    Comparison               compared;
    // eps_xy, sigma xx, yy, xy, R, pcb, Rb, a xx, yy, xy, beta xx, yy, xy
    const double rows[][13] = {{.01,
                                67.5304052,
                                97.1060491,
                                41.0334344,
                                .604961978,
                                243.671346944,
                                1.888711603,
                                42.3833846,
                                67.2228543,
                                13.3006626,
                                -.105532482,
                                .211064965,
                                .0403384836},
                               {-.01,
                                74.0924123,
                                103.813148,
                                -44.4978609,
                                .766590461,
                                217.347200708,
                                1.704340342,
                                53.4700374,
                                79.8126583,
                                -14.4338909,
                                -.114525033,
                                .229050066,
                                -.0425810621},
                               {.01,
                                74.4118989,
                                106.819599,
                                41.6638007,
                                .778944425,
                                197.511373185,
                                1.551953927,
                                59.7805102,
                                88.5421929,
                                13.7518838,
                                -.126424525,
                                .25284905,
                                .0449612968},
                               {.05,
                                106.546634,
                                140.807978,
                                61.0948087,
                                .992643582,
                                151.196989305,
                                1.244332585,
                                84.4040778,
                                111.525002,
                                52.6982521,
                                -.0954594523,
                                .190918905,
                                .281841679}};
    double       last       = 0.;
    for (const auto &row : rows)
      {
        typename SubloadingModel<n>::Vector strain =
          SubloadingModel<n>::Vector::Zero();
        strain[3] = sqrt2 * (row[0] - last) / n_calls;
        last      = row[0];
        for (int i = 0; i < n_calls; ++i)
          model.integrate(y, strain);
        compared.add(y.stress[0], row[1]);
        compared.add(y.stress[2], row[1]);
        compared.add(y.stress[1], row[2]);
        compared.add(y.stress[3] / sqrt2, row[3]);
        compared.add(model.ratio(y), row[4]);
        compared.add(y.pcb, row[5]);
        compared.add(y.Rb, row[6]);
        compared.add(y.a[0], row[7]);
        compared.add(y.a[1], row[8]);
        compared.add(y.a[3] / sqrt2, row[9]);
        compared.add(y.beta[0], row[10], .2);
        compared.add(y.beta[1], row[11], .2);
        compared.add(y.beta[3] / sqrt2, row[12], .2);
      }
    compared.print_within("F4, cyclic shear, n = " + std::to_string(n) + ", " +
                            std::to_string(n_calls) + " increments per leg",
                          accuracy.bound);
  }

  void
  test()
  {
    for (const Accuracy &accuracy : accuracies)
      {
        std::cout << "STOL " << accuracy.tolerance << std::endl;
        check_centre(accuracy);
        check_anisotropy(accuracy);
        check_compression(accuracy, false);
        check_compression(accuracy, true);
        check_oedometer<6>(accuracy);
        check_oedometer<4>(accuracy);
        check_shear<6>(accuracy, 1);
        check_shear<4>(accuracy, 1);
        check_shear<4>(accuracy, 37);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_regression_01
