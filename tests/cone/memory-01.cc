// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Friction with memory. If this failed, a step would not fulfil the law
// |s_t| <= b s_n + mu p + k with p at its end, its tangent would be wrong, plastic
// work could be negative, a state at rest would not have the exact strength, the
// memory would not relax like exp(-t/tau), or explicit steps would have another law.

#include <geocone/laws/hardening_mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <sstream>
#include <vector>

#include "../test.h"
#include "cone_tests.h"

namespace cone_memory_01
{
  using namespace cone_tests;
  using namespace geocone;

  constexpr double E = 1e6, nu = 0.3, tau = 0.02;

  template <typename Law>
  void
  prepare(Law               &law,
          const std::string &name,
          const double       phi,
          const double       theta,
          const double       c,
          const std::string &more = "")
  {
    std::ostringstream text;
    text << "subsection Materials\nsubsection " << name
         << "\nset Cohesion = " << c << "\nset Friction angle = " << phi
         << "\nset Dilatancy angle = " << theta << "\nset Young modulus = " << E
         << "\nset Poisson ratio = " << nu << "\nset Friction memory = " << tau
         << "\n"
         << more << "end\nend\n";
    auto &prm = dealii::ParameterAcceptor::prm;
    prm.parse_input_from_string(text.str());
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    law.prepare();
  }

  /** A point under a law, in implicit steps. */
  struct Point
  {
    const Material     &law;
    Mandel              stress = Mandel::Zero();
    std::vector<double> history;
    Mode                mode    = Mode::elastic;
    MandelMatrix        tangent = MandelMatrix::Zero();

    Point(const Material &law, const Mandel &start)
      : law(law)
      , stress(start)
      , history(law.n_history())
    {
      law.initialise(stress_of(extended(start, 0.)), 0., history.data());
    }

    void
    step(const Mandel &strain, const double h)
    {
      const Mandel              stress_n  = stress;
      const std::vector<double> history_n = history;
      Increment                 increment;
      Response                  response;
      increment.strain    = dealii::ArrayView<const Mandel>(&strain, 1);
      increment.stress_n  = dealii::ArrayView<const Mandel>(&stress_n, 1);
      increment.history_n = history_n.data();
      increment.n_history = history.size();
      increment.step.size = h;
      response.stress     = dealii::ArrayView<Mandel>(&stress, 1);
      response.mode       = dealii::ArrayView<Mode>(&mode, 1);
      response.tangent    = dealii::ArrayView<MandelMatrix>(&tangent, 1);
      response.history    = history.data();
      law.update(increment, response);
    }

    double
    memory() const
    {
      return history[1];
    }
  };

  /** Random paths: the law, its tangent, its work; and explicit steps. */
  void
  paths(const std::string &name,
        const double       phi,
        const double       theta,
        const double       c)
  {
    MohrCoulomb law("Materials/" + name);
    prepare(law, name, phi, theta, c);
    const FlowCone exact = *law.flow_cone(nullptr);
    const double   mu = exact.a - exact.b, scale = 1e4;
    Random         random;
    Largest        violation, on_cone, work, least_p, tangent, both;
    unsigned int   n_cone = 0, n_apex = 0, n_above = 0;
    for (unsigned int path = 0; path < 200; ++path)
      {
        Point point(law, -scale * Mandel(1., 1., 0.));
        for (unsigned int n = 0; n < 60; ++n)
          {
            const double h = random(0., 1.) * tau;
            const Mandel strain =
              random.vector<Mandel>(n % 7 == 0 ? 0.03 : 0.005);
            const Point before = point;
            point.step(strain, h);
            const Mandel s = to_cone_axes(point.stress);
            const double T = FlowCone::tangential_norm(s);
            const double strength =
              exact.b * s[0] + mu * point.memory() + exact.k;
            const double lambda = tau / (h + tau);
            violation.add(std::abs(point.memory() - lambda * before.memory() -
                                   (1. - lambda) * s[0]) /
                          scale);
            violation.add((T - strength) / scale);
            if (point.mode == Mode::cone)
              on_cone.add(std::abs(T - strength) / scale);
            n_cone += point.mode == Mode::cone;
            n_apex += point.mode == Mode::apex;
            n_above += exact.yield_function(s) > 1e-3 * scale;
            const Mandel plastic =
              strain -
              law.elasticity().strain(Mandel(point.stress - before.stress));
            work.add(-point.stress.dot(plastic) / scale);
            least_p.add((-exact.k / exact.a - point.memory()) / scale);

            // Differences where both sides are in the same mode.
            MandelMatrix differences;
            bool         smooth = true;
            for (int j = 0; j < n_mandel; ++j)
              {
                Point        up = before, down = before;
                const Mandel change = 1e-8 * Mandel::Unit(j);
                up.step(strain + change, h);
                down.step(strain - change, h);
                differences.col(j) = (up.stress - down.stress) / 2e-8;
                smooth =
                  smooth && up.mode == point.mode && down.mode == point.mode;
              }
            // The edge of the disc at the cut-off is a kink, too.
            if (smooth && point.mode != Mode::apex)
              tangent.add((differences - point.tangent).norm() / E);

            // Four lanes of an explicit step, by the kernel and without it.
            for (const bool kernel : {true, false})
              {
                using Lanes      = std::array<double, PointBlock::lanes>;
                const auto lanes = [](const double value) {
                  Lanes all;
                  all.fill(value);
                  return all;
                };
                const Lanes xx = lanes(strain[0]), yy = lanes(strain[1]),
                            xy = lanes(strain[2] / sqrt2);
                Lanes s_xx     = lanes(before.stress[0]),
                      s_yy     = lanes(before.stress[1]),
                      s_xy     = lanes(before.stress[2] / sqrt2), work, wave,
                      plastic  = lanes(0.);
                Lanes   histories[2] = {lanes(before.history[0]),
                                        lanes(before.history[1])};
                double *arrays[2] = {histories[0].data(), histories[1].data()};
                const PointBlock block = {
                  PointBlock::lanes,
                  {{xx.data(), xy.data(), xy.data(), yy.data()}},
                  {{s_xx.data(), s_yy.data(), s_xy.data()}},
                  arrays,
                  plastic.data(),
                  work.data(),
                  wave.data(),
                  h};
                LawCounts counts;
                if (kernel)
                  law.advance(block, counts);
                else
                  law.Material::advance(block, counts);
                both.add(std::abs(s_xx[3] - point.stress[0]) / scale);
                both.add(std::abs(s_yy[3] - point.stress[1]) / scale);
                both.add(std::abs(s_xy[3] - point.stress[2] / sqrt2) / scale);
                both.add(std::abs(histories[1][3] - point.memory()) / scale);
                both.add(std::abs(
                  plastic[3] - (point.mode == Mode::elastic
                                  ? 0.
                                  : (strain - law.elasticity().strain(Mandel(
                                                point.stress - before.stress)))
                                      .norm())));
              }
          }
      }
    std::cout << name << std::endl;
    print("  points flow, and some end at the cut-off",
          n_cone > 1000 && n_apex > 100);
    print("  some are above the exact strength", n_above > 100);
    print_below("  violation of the law/10 kPa", violation, "1e-12");
    print_below("  distance from the yield surface/10 kPa", on_cone, "1e-12");
    print_below("  negative plastic work/10 kPa", work, "1e-12");
    print_below("  p below the tip of the cone/10 kPa", least_p, "1e-12");
    print_below("  tangent against differences/E", tangent, "1e-6");
    print_below("  explicit against implicit", both, "1e-11");
  }

  /** Shear under a pressure that grows by r = 1 MPa/s: p lags by tau (1 - exp(-t/tau)),
   *  and without dilatancy s_n follows the volume. */
  double
  error_of_lag(const Material &law, const unsigned int n_steps)
  {
    const FlowCone exact = *law.flow_cone(nullptr);
    const double   rate = 1e6, end = 2. * tau, h = end / n_steps, start = 1e4;
    // s_n = sqrt2 times the pressure.
    Point point(law, -start / sqrt2 * Mandel(1., 1., 0.));
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        const double e_n = rate * h / law.elasticity().normal_stiffness();
        Mandel       strain(-e_n / sqrt2, -e_n / sqrt2, 20. * h);
        point.step(strain, h);
      }
    const double p = start + rate * (end - tau * (1. - std::exp(-end / tau)));
    const double strength = exact.a * p + exact.k;
    return std::abs(
      FlowCone::tangential_norm(to_cone_axes(point.stress)) / strength - 1.);
  }

  void
  test()
  {
    paths("without dilatancy", 25., 0., 1000.);
    paths("little dilatancy", 40., 10., 500.);
    paths("without cohesion", 30., 0., 0.);

    MohrCoulomb law("Materials/soil");
    prepare(law, "soil", 25., 0., 1000.);
    const double coarse = error_of_lag(law, 100), fine = error_of_lag(law, 200);
    std::cout << "lag behind a growing pressure" << std::endl;
    Largest error;
    error.add(fine);
    print_below("  error of 200 steps", error, "2e-3");
    print("  first order in the step", std::abs(coarse / fine - 2.) < 0.1);

    // Sheared on at rest of the pressure: the exact strength.
    Point        point(law, -1e4 * Mandel(1., 1., 0.));
    const Mandel shear(0., 0., 1e-3);
    point.step(-0.02 * Mandel(1., 1., 0.), tau);
    for (unsigned int n = 0; n < 200; ++n)
      point.step(shear, tau);
    Largest off;
    off.add(std::abs(
      law.flow_cone(nullptr)->yield_function(to_cone_axes(point.stress)) /
      1e4));
    print_below("  excess at rest/10 kPa", off, "1e-12");

    // With hardening: both histories, side by side.
    HardeningMohrCoulomb hardening("Materials/hardening");
    prepare(
      hardening, "hardening", 25., 0., 1000., "set Hardening modulus = 1e5\n");
    Point both(hardening, -1e4 * Mandel(1., 1., 0.));
    for (unsigned int n = 0; n < 100; ++n)
      both.step(shear, tau);
    const Mandel s = to_cone_axes(both.stress);
    Largest      difference;
    difference.add(std::abs(FlowCone::tangential_norm(s) -
                            hardening.flow_cone(both.history.data())->k -
                            law.flow_cone(nullptr)->a * both.memory()) /
                   1e4);
    std::cout << "hardening with memory" << std::endl;
    print_below(
      "  distance from the yield surface/10 kPa", difference, "1e-12");
    print("  it has hardened", both.history[2] > 0.05);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_memory_01
