// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, Newton's method would take wrong step lengths, spend more
// residuals than it counts on, or go on from a state (that of the last
// evaluation) which does not belong to the length returned.

#include <geocone/newton/line_search.h>

#include "../test.h"
#include "cone_tests.h"
#include <functional>
#include <limits>
#include <vector>

namespace cone_line_search_01
{
  using namespace cone_tests;

  struct Search
  {
    double              length, G0, G;
    std::vector<double> trials;

    bool
    state_is_at_length() const
    {
      return !trials.empty() && trials.back() == length;
    }
  };

  Search
  search(const std::function<double(double)> &G,
         const unsigned int                   max_evaluations = 6)
  {
    Search s;
    s.G0     = G(0.);
    s.length = geocone::line_search(
      s.G0,
      [&](const double x) {
        s.trials.push_back(x);
        return G(x);
      },
      0.5,
      max_evaluations);
    s.G = G(s.length);
    return s;
  }

  void
  print_search(const std::string                   &name,
               const std::function<double(double)> &G,
               const unsigned int                   max_evaluations = 6)
  {
    const Search s = search(G, max_evaluations);
    std::cout << name << ": length " << s.length << ", G " << s.G << ", "
              << s.trials.size() << " evaluations, the last at the length: "
              << (s.state_is_at_length() ? "yes" : "no") << std::endl;
  }

  void
  test()
  {
    const double nan      = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    std::cout.precision(10);

    // G is the derivative along the direction; Newton's step ends at its root.
    print_search("quadratic, exact step", [](double x) { return x - 1.; });
    print_search("quadratic, short step", [](double x) { return x / 2. - 1.; });
    print_search("quadratic, 1.5 times too long",
                 [](double x) { return 1.5 * x - 1.; });
    print_search("quadratic, twice too long",
                 [](double x) { return 2. * x - 1.; });
    // Regula falsi meets the root of a straight line at once, here 1/8.
    print_search("quadratic, 8 times too long",
                 [](double x) { return 8. * x - 1.; });

    // 1/1000 is not within the inner 80 % of [0, 1], nor 1/100 of [0, 0.1].
    print_search("quadratic, 1000 times too long",
                 [](double x) { return 1000. * x - 1.; });
    // Like a point that starts to yield: bracketed and met within 6 evaluations.
    for (const double slope : {10., 40., 80.})
      print_search("kink at 0.1, slopes 1/2 and " +
                     std::to_string(static_cast<int>(slope)),
                   [slope](double x) {
                     return -1. + 0.5 * x + slope * std::fmax(0., x - 0.1);
                   });

    print_search("no descent direction", [](double x) { return 1. + 5. * x; });
    print_search("at a minimum", [](double x) { return 7. * x; });

    // Not finite means too far: 1, 1/2, 1/4.
    print_search("not a number beyond 0.3",
                 [&](double x) { return x > 0.3 ? nan : 3. * x - 1.; });
    print_search("infinite beyond 0.3",
                 [&](double x) { return x > 0.3 ? infinity : 3. * x - 1.; });
    const Search lost = search([&](double x) { return x > 0. ? nan : -1.; });
    std::cout << "nowhere a number: length " << lost.length << ", "
              << lost.trials.size() << " evaluations, the last at the length: "
              << (lost.state_is_at_length() ? "yes" : "no") << std::endl;

    // The bound, with a root that is out of reach.
    for (const unsigned int n : {1, 2, 4, 6, 10})
      print_search(
        "root at 1e-12, at most " + std::to_string(n),
        [](double x) { return x > 1e-12 ? 1. : -1.; },
        n);

    // Convex functions with kinks, as the points of a cone law make them.
    Random       random;
    unsigned int n_cut = 0, most = 0, not_halved = 0, larger = 0,
                 wrong_state = 0, outside = 0;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        double slope[4], kink[4];
        for (unsigned int j = 0; j < 4; ++j)
          {
            kink[j]  = j == 0 ? 0. : random(0.01, 1.);
            slope[j] = std::pow(10., random(-2., 1.));
          }
        const Search s = search([&](double x) {
          double G = -1.;
          for (unsigned int j = 0; j < 4; ++j)
            G += slope[j] * std::fmax(0., x - kink[j]);
          return G;
        });
        n_cut += s.length < 1.;
        most = std::max<unsigned int>(most, s.trials.size());
        not_halved += !(s.G <= 0.5 && (s.length == 1. || s.G >= -0.5));
        larger += !(s.G <= 1. && s.G >= -1.);
        wrong_state += !s.state_is_at_length();
        outside += !(s.length > 0. && s.length <= 1.);
      }
    std::cout << "2000 kinked functions: " << n_cut << " steps cut, at most "
              << most << " evaluations, larger residual " << larger
              << ", state elsewhere " << wrong_state
              << ", length outside (0, 1] " << outside << std::endl;
    print("halved in at least 99 % of them", not_halved <= 20);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_line_search_01
