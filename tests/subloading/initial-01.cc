// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a point would start with another state than its parameters
// say, constants that the model cannot have would be taken, or a stress outside
// of the yield surface would pass in silence. Compared with the closed form
// R0 = (1 - chi)/(OCR - chi).

#include <geocone/base/exceptions.h>
#include <geocone/laws/material_library.h>
#include <geocone/laws/subloading.h>

#include "../test.h"
#include "subloading_tests.h"

#include <sstream>

namespace subloading_initial_01
{
  using namespace subloading_tests;

  const char *all_parameters = R"(
  set Yield slope M                   = 0.8
  set Critical state slope Mc         = 1.2
  set Strength ratio k                = 0.714285714285714
  set Potential ratio alpha           = 0.9
  set Apex ratio xi                   = 0.02
  set Elastic cohesion pe             = 2000
  set Subloading rate cR              = 60
  set Rotational hardening rate cbeta = 20
  set Structure loss rate cb          = 15
  set Similarity centre rate ca       = 30
  set Initial structure ratio         = 2
  set Initial centre ratio chi        = 0.5
  set Initial anisotropy              = -0.1, 0.2, -0.1, 0
)";

  /** The law with all features and some other parameters, "NAME = VALUE". */
  std::unique_ptr<ConstitutiveLaw>
  law(const std::vector<std::string> &parameters)
  {
    dealii::ParameterAcceptor::clear();
    auto               made = make_material("subloading", "Materials/soil");
    std::ostringstream text;
    text << "subsection Materials\nsubsection soil\n" << all_parameters;
    for (const std::string &parameter : parameters)
      text << "set " << parameter << "\n";
    text << "end\nend\n";
    dealii::ParameterAcceptor::prm.parse_input_from_string(text.str());
    dealii::ParameterAcceptor::parse_all_parameters();
    return made;
  }

  /** Initialises a point with this stress and shows R0. */
  void
  start(const std::string              &what,
        const std::vector<std::string> &parameters,
        const ConstitutiveLaw::Stress  &stress,
        const double                    expected_R)
  {
    std::cout << what << std::endl;
    try
      {
        const auto made = law(parameters);
        made->prepare();
        std::vector<double> history(made->n_history()),
          shown(made->output_quantities().size());
        const std::string changed =
          made->initialise(stress, 0., history.data());
        made->output(
          {{stress[0], stress[1], stress[3]}}, history.data(), shown.data());
        if (!changed.empty())
          std::cout << "  " << changed << std::endl;
        Comparison R, p;
        R.add(shown[3], expected_R);
        R.print_within("R", 1e-8);
        p.add(shown[1], -(stress[0] + stress[1] + stress[2]) / 3., 1e3);
        p.add(shown[0], stress[2], 1e3);
        p.print_within("pressure and stress_zz", 1e-12);
      }
    catch (const InputError &error)
      {
        std::cout << "  refused: " << error.what() << std::endl;
      }
  }

  void
  test()
  {
    const ConstitutiveLaw::Stress stress = {{-60e3, -100e3, -60e3, 0.}};
    start("size given", {"Initial size pcb = 260e3"}, stress, .186457907);
    for (const double ocr : {1., 1.5, 4.})
      start("overconsolidation ratio " + std::to_string(ocr),
            {"Overconsolidation ratio = " + std::to_string(ocr)},
            stress,
            .5 / (ocr - .5));
    start("the same with ph in (24)",
          {"Overconsolidation ratio = 2", "Pressure of rotation = ph"},
          {{-60e3, -100e3, -60e3, 20e3}},
          .5 / 1.5);
    // beta = zeta s/p leaves sh = (1 - zeta) s.
    start("anisotropy by the stress",
          {"Overconsolidation ratio = 2",
           "Initial anisotropy = 0, 0, 0, 0",
           "Initial anisotropy by stress = 0.5"},
          stress,
          .5 / 1.5);
    start("outside, refused", {"Overconsolidation ratio = 0.8"}, stress, 1.);
    start("outside, size given", {"Initial size pcb = 70e3"}, stress, 1.);
    start("outside, raised",
          {"Overconsolidation ratio = 0.8", "Stress outside = raise size"},
          stress,
          1.);
    start(
      "almost without stress: the smallest size",
      {"Smallest size pcb = 1e4", "Initial centre ratio chi = 0"},
      {{-100., -100., -100., 0.}},
      // a = 0, isotropic: A = dp^2 + 1.5 dp^2 |beta|^2/M^2, |beta|^2 = 0.06,
      // B = dp (2 xi - 1) pcb, C = -xi (1 - xi) pcb^2, dp = 100
      2. * (1. + .09 / .64) * 1e4 /
        (.96 * 1e6 + std::sqrt(std::pow(.96 * 1e6, 2) +
                               4. * .0196 * 1e8 * (1. + .09 / .64) * 1e4)));
    start("no pressure, no stiffness",
          {"Elastic cohesion pe = 0"},
          {{0., 0., 0., 0.}},
          1.);
    start("tension without an apex",
          {"Apex ratio xi = 0"},
          {{500., 500., 500., 0.}},
          1.);

    std::cout << "constants:" << std::endl;
    for (const std::string parameter : {"Density = 0",
                                        "Swelling index kappa = 0",
                                        "Swelling index kappa = 0.08",
                                        "Poisson ratio = 0.5",
                                        "Poisson ratio = -1",
                                        "Elastic cohesion pe = -1",
                                        "Apex ratio xi = 0.5",
                                        "Apex ratio xi = -0.1",
                                        "Yield slope M = 0",
                                        "Yield slope M = 0.86",
                                        "Critical state slope Mc = 0",
                                        "Strength ratio k = 0.5",
                                        "Strength ratio k = 1.01",
                                        "Potential ratio alpha = 0",
                                        "Potential ratio alpha = 1.4143",
                                        "Subloading rate cR = 0",
                                        "Rotational hardening rate cbeta = -1",
                                        "Structure loss rate cb = -1",
                                        "Final structure ratio Rbf = 0.9",
                                        "Final structure ratio Rbf = 2.1",
                                        "Similarity centre rate ca = -1",
                                        "Atmospheric pressure = 0",
                                        "Elastic ratio Rmin = 0",
                                        "Elastic ratio Rmin = 1",
                                        "Centre margin delta = 0",
                                        "Centre margin delta = 1",
                                        "Error tolerance = 0",
                                        "Error tolerance = 0.2",
                                        "Smallest substep = 0",
                                        "Lowest pressure = 0",
                                        "Overconsolidation ratio = 0",
                                        "Initial size pcb = -1",
                                        "Smallest size pcb = 0",
                                        "Initial centre ratio chi = 1",
                                        "Initial anisotropy = 0.1, 0, 0, 0",
                                        "Initial anisotropy = 0, 0, 0",
                                        "Initial structure ratio = 0.5"})
      try
        {
          law({parameter})->prepare();
          std::cout << "TAKEN: " << parameter << std::endl;
        }
      catch (const InputError &error)
        {
          std::cout << error.what() << std::endl;
        }
    // Without rotational hardening M is free.
    law({"Yield slope M = 1.5", "Rotational hardening rate cbeta = 0"})
      ->prepare();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_initial_01
