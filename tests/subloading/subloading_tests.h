// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What the tests of this folder share: the two sets of constants, states, and
// verdicts. Stresses are in kPa and compression is positive, as in the tables.
//
// "Reference" numbers were computed by another program with an adaptive
// Runge-Kutta method of order 8 at a tolerance of 1e-12; "closed form" numbers
// by the formula beside them.

#ifndef geocone_tests_subloading_tests_h
#define geocone_tests_subloading_tests_h

#include <geocone/base/types.h>
#include <geocone/kernels/subloading_model.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace subloading_tests
{
  using namespace geocone;
  using Vector4 = SubloadingModel<4>::Vector;
  using Vector6 = SubloadingModel<6>::Vector;

  /** Modified Cam Clay: what is not set here has no effect. */
  inline SubloadingConstants
  cam_clay(const double tolerance)
  {
    SubloadingConstants c;
    c.kappa            = 0.01;
    c.lambda           = 0.08;
    c.nu               = 0.25;
    c.M                = 1.2;
    c.Mc               = 1.2;
    c.patm             = 100.;
    c.Rmin             = 0.01;
    c.delta            = 0.01;
    c.tolerance        = tolerance;
    c.smallest_substep = 1e-9;
    c.lowest_pressure  = 1e-3;
    c.smallest_size    = 1e-3;
    return c;
  }

  /** All features. */
  inline SubloadingConstants
  all_features(const double tolerance)
  {
    SubloadingConstants c = cam_clay(tolerance);
    c.k                   = 5. / 7.;
    c.M                   = 0.8;
    c.alpha               = 0.9;
    c.xi                  = 0.02;
    c.pe                  = 2.;
    c.cR                  = 60.;
    c.cbeta               = 20.;
    c.cb                  = 15.;
    c.Rbf                 = 1.;
    c.ca                  = 30.;
    return c;
  }

  template <int n>
  typename SubloadingModel<n>::Vector
  axial(const double value, const double others, const int axis)
  {
    typename SubloadingModel<n>::Vector x = SubloadingModel<n>::Vector::Zero();
    x.template head<3>().setConstant(others);
    x[axis] = value;
    return x;
  }

  /** The state that all paths with all features start from. */
  template <int n>
  SubloadingState<n>
  structured_state(const int axis)
  {
    SubloadingState<n> y;
    y.stress = axial<n>(100., 60., axis);
    y.a      = 0.5 * y.stress;
    y.beta   = axial<n>(0.2, -0.1, axis);
    y.pcb    = 260.;
    y.Rb     = 2.;
    return y;
  }

  /** sigma = p I, the centre chi p I. */
  template <int n>
  SubloadingState<n>
  isotropic_state(const double p, const double chi, const double size)
  {
    SubloadingState<n> y;
    y.stress = axial<n>(p, p, 0);
    y.a      = chi * y.stress;
    y.pcb    = size;
    return y;
  }

  template <typename V>
  double
  pressure(const V &x)
  {
    return (x[0] + x[1] + x[2]) / 3.;
  }

  /** q = sqrt(3/2) ||s||. */
  template <typename V>
  double
  deviatoric(const V &x)
  {
    V s = x;
    s.template head<3>().array() -= pressure(x);
    return std::sqrt(1.5) * s.norm();
  }

  inline void
  print(const std::string &what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  /** The largest relative difference of a table's rows. */
  class Comparison
  {
  public:
    /** @param scale what differences are relative to; 0: the expected value */
    void
    add(const double value, const double expected, const double scale = 0.)
    {
      const double error =
        std::abs(value - expected) / (scale > 0. ? scale : std::abs(expected));
      if (!(error <= largest))
        largest = error;
    }

    /** Prints the verdict, and the number if it fails. */
    void
    print_within(const std::string &what, const double bound) const
    {
      const bool holds = largest <= bound;
      std::cout << "  " << what << ", within " << bound << ": "
                << (holds ? "yes" : "NO");
      if (!holds)
        std::cout << " " << largest;
      std::cout << std::endl;
    }

    double largest = 0.;
  };

  /** The tolerances of the integrator and what errors they must keep. */
  struct Accuracy
  {
    double tolerance, bound;
  };
  constexpr Accuracy accuracies[] = {{1e-7, 1e-6}, {1e-4, 5e-4}};
} // namespace subloading_tests

#endif
