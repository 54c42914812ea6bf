// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, the response would depend on the axes, or plane strain would
// not be what three dimensions give for it, or an explicit step would not turn
// the history with the stress.

#include <geocone/laws/material_library.h>
#include <geocone/laws/subloading.h>

#include "../test.h"
#include "subloading_tests.h"

#include <Eigen/Geometry>

namespace subloading_invariance_01
{
  using namespace subloading_tests;
  using Tensor = Eigen::Matrix3d;

  Tensor
  tensor_of(const Vector6 &x)
  {
    Tensor t;
    t << x[0], x[3] / sqrt2, x[5] / sqrt2, //
      x[3] / sqrt2, x[1], x[4] / sqrt2,    //
      x[5] / sqrt2, x[4] / sqrt2, x[2];
    return t;
  }

  Vector6
  turned(const Vector6 &x, const Tensor &Q)
  {
    const Tensor t = Q * tensor_of(x) * Q.transpose();
    Vector6      y;
    y << t(0, 0), t(1, 1), t(2, 2), sqrt2 * t(0, 1), sqrt2 * t(1, 2),
      sqrt2 * t(2, 0);
    return y;
  }

  Vector6
  in_space(const Vector4 &x)
  {
    Vector6 y;
    y << x, 0., 0.;
    return y;
  }

  template <int n>
  void
  compare(const std::string        &what,
          const SubloadingState<n> &x,
          const SubloadingState<n> &y,
          const double              bound)
  {
    Comparison c;
    c.add((x.stress - y.stress).norm(), 0., y.stress.norm());
    c.add((x.a - y.a).norm(), 0., y.stress.norm());
    c.add((x.beta - y.beta).norm(), 0., 1.);
    c.add(x.pcb, y.pcb);
    c.add(x.Rb, y.Rb);
    c.print_within(what, bound);
  }

  /** Two legs of a general path, in increments as explicit steps have them. */
  template <int n>
  void
  drive(const SubloadingModel<n>                  &model,
        SubloadingState<n>                        &y,
        const typename SubloadingModel<n>::Vector &strain)
  {
    for (int i = 0; i < 100; ++i)
      model.integrate(y, strain);
    for (int i = 0; i < 150; ++i)
      model.integrate(y, -strain);
  }

  void
  test()
  {
    const SubloadingModel<6> six(all_features(1e-4));
    const SubloadingModel<4> four(all_features(1e-4));
    Vector6                  strain;
    strain << 1e-4, 2e-4, -1e-4, 1e-4, -2e-4, 3e-4;

    // All axes turned, by an axis in space.
    {
      const Tensor Q =
        Eigen::AngleAxisd(.7, Eigen::Vector3d(1., -2., .5).normalized())
          .toRotationMatrix();
      SubloadingState<6> y = structured_state<6>(1), z = y;
      z.stress = turned(y.stress, Q);
      z.a      = turned(y.a, Q);
      z.beta   = turned(y.beta, Q);
      drive(six, y, strain);
      drive(six, z, turned(strain, Q));
      y.stress = turned(y.stress, Q);
      y.a      = turned(y.a, Q);
      y.beta   = turned(y.beta, Q);
      compare("rotation", z, y, 1e-12);
    }

    // Plane strain in both.
    {
      const Vector4      plane(1e-4, -2e-4, 0., 2e-4);
      SubloadingState<4> y = structured_state<4>(1);
      SubloadingState<6> z = structured_state<6>(1), w;
      drive(four, y, plane);
      drive(six, z, in_space(plane));
      w.stress = in_space(y.stress);
      w.a      = in_space(y.a);
      w.beta   = in_space(y.beta);
      w.pcb    = y.pcb;
      w.Rb     = y.Rb;
      compare("n = 4 against n = 6", w, z, 1e-12);
    }

    // Steps of the law with a spin only, through 30 degrees in all, against the
    // turned state; then the same strains in turned axes.
    const auto law = make_material("subloading", "Materials/soil");
    dealii::ParameterAcceptor::prm.parse_input_from_string(R"(
    subsection Materials
      subsection soil
        set Yield slope M                  = 0.8
        set Critical state slope Mc        = 1.2
        set Strength ratio k               = 0.714285714285714
        set Potential ratio alpha          = 0.9
        set Apex ratio xi                  = 0.02
        set Elastic cohesion pe            = 2000
        set Subloading rate cR             = 60
        set Rotational hardening rate cbeta = 20
        set Structure loss rate cb         = 15
        set Similarity centre rate ca      = 30
        set Initial size pcb               = 260e3
        set Initial structure ratio        = 2
        set Initial centre ratio chi       = 0.5
        set Initial anisotropy             = -0.1, 0.2, -0.1, 0
      end
    end)");
    dealii::ParameterAcceptor::parse_all_parameters();
    law->prepare();
    struct Point
    {
      double  stress[3], history[11], plastic = 0., work = 0., modulus = 0.;
      double *arrays[11];
    };
    LawCounts  counts;
    const auto step = [&](Point &x, const Eigen::Matrix2d &l) {
      PointBlock block;
      block.n_points       = 1;
      block.l              = {{&l(0, 0), &l(0, 1), &l(1, 0), &l(1, 1)}};
      block.s              = {{x.stress, x.stress + 1, x.stress + 2}};
      block.history        = x.arrays;
      block.plastic_strain = &x.plastic;
      block.work           = &x.work;
      block.wave_modulus   = &x.modulus;
      law->advance(block, counts);
    };
    const auto start = [&](Point &x) {
      x.stress[0] = -60e3;
      x.stress[1] = -100e3;
      x.stress[2] = 0.;
      law->initialise({{-60e3, -100e3, -60e3, 0.}}, 0., x.history);
      for (int k = 0; k < 11; ++k)
        x.arrays[k] = x.history + k;
    };
    const auto tensor = [](const double xx, const double yy, const double xy) {
      Eigen::Matrix2d t;
      t << xx, xy, xy, yy;
      return t;
    };
    Point turned_first, turned_last;
    start(turned_first);
    start(turned_last);
    const double angle = pi / 6.;
    const int    n     = 50;
    // The Cayley transform of the spin w turns by 2 atan(w/2).
    const double    w = 2. * std::tan(angle / n / 2.);
    Eigen::Matrix2d spin, Q;
    spin << 0., -w, w, 0.;
    Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Eigen::Matrix2d push = tensor(1e-5, -3e-5, 2e-5);
    for (int i = 0; i < n; ++i)
      step(turned_first, spin);
    print("a spin does no work and no plastic strain",
          turned_first.work == 0. && turned_first.plastic == 0.);
    for (int i = 0; i < 200; ++i)
      {
        step(turned_first, Q * push * Q.transpose());
        step(turned_last, push);
      }
    print("the path yields", turned_last.plastic > 1e-3);
    for (int i = 0; i < n; ++i)
      step(turned_last, spin);
    Comparison same;
    for (int i = 0; i < 3; ++i)
      same.add(turned_first.stress[i], turned_last.stress[i], 1e5);
    for (int k = 0; k < 11; ++k)
      same.add(turned_first.history[k],
               turned_last.history[k],
               k == 0 || k == 9 ? 1e5
               : k < 5          ? 1e5
                                : 1.);
    same.add(turned_first.plastic, turned_last.plastic);
    same.print_within("turned before and after", 1e-12);

    // The point after: elastic modulus of the wave, 3(1-nu)/(1+nu) (p+pe)/kappa.
    const double p = -(turned_last.stress[0] + turned_last.stress[1] +
                       turned_last.history[0]) /
                     3.;
    Comparison modulus;
    modulus.add(turned_last.modulus, 3. * .75 / 1.25 * (p + 2e3) / .01);
    modulus.print_within("wave modulus", 1e-12);

    // The work of one more step: strain increment times mean stress.
    const Point before = turned_last;
    step(turned_last, push);
    Comparison work;
    work.add(turned_last.work,
             .5 *
               (push(0, 0) * (before.stress[0] + turned_last.stress[0]) +
                push(1, 1) * (before.stress[1] + turned_last.stress[1]) +
                2. * push(0, 1) * (before.stress[2] + turned_last.stress[2])));
    work.print_within("work", 1e-12);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_invariance_01
