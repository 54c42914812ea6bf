// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a step of Modified Cam-Clay would end outside of the yield surface of
// its end, flow in another direction than its normal, harden by another volume than that
// of its flow, or give Newton's method another matrix than its derivative; or strain
// increments of up to 100 % would have no answer. States are on and within the surface,
// on both sides of the critical state, isotropic ones among them; soil that is torn open
// keeps 1 Pa. Isotropic compression, which is exact in one step, and elastic steps are
// compared with their closed forms.

#include "../test.h"
#include "cone_tests.h"
#include "spatial_point.h"

namespace cone_modified_cam_clay_01
{
  using namespace cone_tests;
  using namespace geocone;

  using V = SpatialMandel;
  using T = SpatialMandelMatrix;

  constexpr double kappa = 0.01, lambda = 0.08, M = 1.2, nu = 0.25;

  struct State
  {
    V      stress = V::Zero();
    double pc     = 0.;
  };

  struct Answer
  {
    State state;
    T     tangent;
    Mode  mode;
  };

  struct Law : SpatialPoint
  {
    explicit Law(const double attraction)
      : SpatialPoint(
          "modified Cam-Clay",
          "set Swelling index kappa = 0.01\nset Compression index lambda = "
          "0.08\n"
          "set Critical state slope M = 1.2\nset Poisson ratio = 0.25\n"
          "set Attraction = " +
            std::to_string(attraction) + "\n")
    {}

    /** Of the history s_zz is there beyond nu (s_xx + s_yy), and pc. */
    cone_modified_cam_clay_01::Answer
    operator()(const State &state, const V &e) const
    {
      const V                   &s = state.stress;
      const SpatialPoint::Answer end =
        step(e, s, {s[3] - nu * (s[0] + s[1]), state.pc});
      return {{end.stress, end.history[1]}, end.tangent, end.mode};
    }
  };

  double
  pressure(const V &s)
  {
    return -trace(s) / 3.;
  }

  V
  deviator(const V &s)
  {
    return s - (trace(s) / 3.) * unit_tensor<4>();
  }

  void
  check(const double attraction, const double largest_strain)
  {
    const Law    law(attraction);
    Random       random;
    Largest      yield, direction, size, elastic, opened, differences;
    unsigned int contracting = 0, dilating = 0, within = 0, open = 0,
                 failed = 0;
    for (unsigned int i = 0; i < 600; ++i)
      {
        // At the angle phi of the yield surface, or nearer to its centre.
        State        state;
        const double phi =
          i % 4 == 0 ? 0. : pi / 2. * (1. + 0.98 * random(-1., 1.));
        const double near = i % 3 == 0 ? std::abs(random(-1., 1.)) : 1.;
        state.pc          = 1e5;
        const double Pc   = state.pc + attraction;
        const V      n    = deviator(random.vector<V>(1.));
        const double p    = Pc / 2. * (1. + near * std::cos(phi)) - attraction,
                     q    = near * M * Pc / 2. * std::sin(phi);
        state.stress      = -p * unit_tensor<4>();
        if (phi > 0.)
          state.stress += std::sqrt(2. / 3.) * q / n.norm() * n;
        // Of all sizes, and some without shear.
        V e = std::pow(10., -2. * std::abs(random(-1., 1.))) * largest_strain *
              random.vector<V>(1.);
        if (i % 8 == 0)
          e = -std::abs(e[0]) * unit_tensor<4>();
        const Answer answer = law(state, e);
        if (!answer.state.stress.allFinite())
          {
            ++failed;
            continue;
          }
        const V plastic = e - law.law->elastic_strain(
                                state.stress, answer.state.stress, nullptr);
        const double P      = pressure(answer.state.stress) + attraction,
                     Pc_end = answer.state.pc + attraction;
        const V s           = deviator(answer.state.stress);
        if (answer.mode == Mode::apex)
          {
            ++open;
            opened.add(
              std::abs(P - 1.) +
              std::max(0., P + 1.5 * s.squaredNorm() / (M * M * P) - Pc_end));
          }
        else if (answer.mode == Mode::elastic)
          {
            ++within;
            elastic.add(plastic.norm() / e.norm());
            elastic.add(answer.state.pc - state.pc);
          }
        else
          {
            ++(P > Pc_end / 2. ? contracting : dilating);
            yield.add(
              std::abs(1.5 * s.squaredNorm() / (M * M) + P * (P - Pc_end)) /
              (Pc_end * Pc_end));
            // The normal of f, tension positive, and the plastic strain along it.
            const V normal =
              3. / (M * M) * s - (2. * P - Pc_end) / 3. * unit_tensor<4>();
            direction.add(
              (plastic - normal * (plastic.dot(normal) / normal.squaredNorm()))
                .norm() /
              e.norm());
            direction.add(-plastic.dot(normal) / (normal.norm() * e.norm()));
            size.add(std::abs(std::log(Pc_end / Pc) +
                              trace(plastic) / (lambda - kappa)) /
                     (1. + e.norm() / kappa));
          }
        T            slopes;
        bool         smooth = true;
        const double d      = 1e-5 * e.norm();
        for (int j = 0; j < 4; ++j)
          {
            V step             = V::Zero();
            step[j]            = d;
            const Answer plus  = law(state, e + step),
                         minus = law(state, e - step);
            smooth =
              smooth && plus.mode == answer.mode && minus.mode == answer.mode;
            slopes.col(j) = (plus.state.stress - minus.state.stress) / (2. * d);
          }
        if (smooth)
          // That of open soil is next to nothing, and a difference is rounding.
          differences.add((slopes - answer.tangent).norm() /
                          std::max(answer.tangent.norm(), 1. / kappa));
      }
    std::cout << "attraction " << attraction << " Pa, strains up to "
              << largest_strain << ": "
              << (contracting > 50 && dilating > 50 && within > 5 &&
                      (open > 5 || largest_strain < 0.1)
                    ? "all sides met"
                    : "sides not met")
              << ", " << failed << " failed" << std::endl;
    print_below("yield function", yield, "1e-11");
    print_below("plastic strain beside the normal", direction, "1e-10");
    print_below("size of the yield surface", size, "1e-10");
    print_below("elastic steps", elastic, "1e-10");
    print_below("opened soil (Pa)", opened, "1e-8");
    print_below("tangent against differences", differences, "1e-5");
  }

  void
  test()
  {
    check(0., 0.01);
    check(0., 1.);
    check(2000., 0.01);
    check(2000., 1.);

    // From p = pc = 100 kPa, volume strain 5 % in one step, and back to 3 %:
    // p = 100 exp(0.05/lambda) kPa, then times exp(-0.02/kappa).
    const Law law(0.);
    State     state;
    state.stress      = -1e5 * unit_tensor<4>();
    state.pc          = 1e5;
    const State there = law(state, V(-0.05 / 3. * unit_tensor<4>())).state,
                back  = law(there, V(0.02 / 3. * unit_tensor<4>())).state;
    print("isotropic compression by 5 % in one step is exact to 1e-12",
          std::abs(pressure(there.stress) / (1e5 * std::exp(0.05 / lambda)) -
                   1.) < 1e-12 &&
            std::abs(there.pc / pressure(there.stress) - 1.) < 1e-12);
    print("unloading is exact to 1e-12",
          std::abs(pressure(back.stress) /
                     (1e5 * std::exp(0.05 / lambda - 0.02 / kappa)) -
                   1.) < 1e-12);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_modified_cam_clay_01
