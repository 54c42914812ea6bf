// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What the tests of this folder share: random numbers that are the same on
// every machine, and verdicts instead of last digits.

#ifndef geocone_tests_cone_tests_h
#define geocone_tests_cone_tests_h

#include <Eigen/Core>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

namespace cone_tests
{
  using Vector3 = Eigen::Matrix<double, 3, 1>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  template <typename V>
  using MatrixOf =
    Eigen::Matrix<double, V::RowsAtCompileTime, V::RowsAtCompileTime>;

  /** Uniform numbers; the distributions of the standard library may differ. */
  class Random
  {
  public:
    double
    operator()(const double begin, const double end)
    {
      return begin + (end - begin) * (engine() / 4294967296.);
    }

    /** Each component between -size and size. */
    template <typename V>
    V
    vector(const double size)
    {
      V x;
      for (int i = 0; i < x.size(); ++i)
        x[i] = (*this)(-size, size);
      return x;
    }

  private:
    std::mt19937 engine{20261121};
  };

  /** Largest of the numbers given; not a number if one of them is not. */
  class Largest
  {
  public:
    void
    add(const double x)
    {
      if (!std::isnan(value) && !(x <= value))
        value = x;
    }

    double value = 0.;
  };

  inline void
  print(const std::string &statement, const bool holds)
  {
    std::cout << statement << ": " << (holds ? "yes" : "no") << std::endl;
  }

  /** The number itself is printed only where it is too large. */
  inline void
  print_below(const std::string &what,
              const Largest     &largest,
              const std::string &tolerance)
  {
    std::cout << what << " below " << tolerance << ": ";
    if (largest.value < std::stod(tolerance))
      std::cout << "yes" << std::endl;
    else
      std::cout << "no, " << largest.value << std::endl;
  }

  /** A point of C = {|s_t| <= a s_n + k}; one of three on the surface. */
  template <typename V>
  V
  feasible_point(const double a, const double k, Random &random)
  {
    V c                 = random.vector<V>(1.);
    c[0]                = 0.;
    const double T      = c.norm();
    c[0]                = a > 0. ? -k / a + random(0., 6.) : random(-4., 4.);
    const double r      = random(0., 1.5);
    const double radius = a > 0. ? a * (c[0] + k / a) : k;
    c.template tail<V::RowsAtCompileTime - 1>() *=
      std::fmin(r, 1.) * radius / T;
    return c;
  }

  /** A point anywhere, such that all parts of the return map are met. */
  template <typename V>
  V
  any_point(const double a, const double k, Random &random)
  {
    V x  = random.vector<V>(3.);
    x[0] = random(a > 0. ? -k / a - 3. : -4., 4.);
    return x;
  }
} // namespace cone_tests

#endif
