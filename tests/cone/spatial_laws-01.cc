// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, laws of all principal stresses would leave their strength, return to
// another point than the law says, or give Newton's method another matrix than their
// derivative. Associated laws return to the point of their strength that is nearest in
// elastic energy: (s* - s):S(t - s) <= 0 for the trial stress t and all admissible s*.
// The natural map vanishes at the stress that is returned, associated or not, and at no
// other. In plane strain Drucker-Prager matched to it flows at the strength of the plane cone.

#include <geocone/cone/second_order_cone.h>

#include <array>
#include <sstream>

#include "../test.h"
#include "cone_tests.h"
#include "spatial_point.h"

namespace cone_spatial_laws_01
{
  using namespace cone_tests;
  using namespace geocone;

  using V = SpatialMandel;
  using M = SpatialMandelMatrix;

  struct Law : SpatialPoint
  {
    Law(const std::string &type, const std::string &parameters)
      : SpatialPoint(type,
                     "set Young modulus = 100\nset Poisson ratio = 0.2\n" +
                       parameters)
    {}

    /** From the stress 0, where the strain increment is that of a trial stress. */
    Answer
    operator()(const V &trial) const
    {
      return step(law->elasticity().strain(trial),
                  V::Zero(),
                  std::vector<double>(law->n_history(), 0.));
    }
  };

  void
  check(const std::string &type,
        const std::string &parameters,
        const bool         associated)
  {
    const Law        law(type, parameters);
    const Elasticity elastic = law.law->elasticity();
    Random           random;
    Largest          beyond, nearer, differences, natural, dual, complementary;
    unsigned int     other_stresses = 0;
    unsigned int     counts[3]      = {};
    std::vector<V>   admissible;
    const std::vector<double> none(law.law->n_history(), 0.);
    for (unsigned int i = 0; i < 400; ++i)
      {
        V trial = random.vector<V>(6.);
        if (i % 3 == 0) // beyond the apex
          trial += V(12., 12., 0., 12.);
        const Law::Answer answer = law(trial);
        ++counts[static_cast<int>(answer.mode)];
        beyond.add(*law.law->yield_function(answer.stress, nullptr));
        admissible.push_back(answer.stress);
        if (answer.mode == Mode::elastic)
          beyond.add((answer.stress - trial).norm());
        const V    z        = elastic.strain(V(answer.stress - trial));
        const auto check_of = [&](const V &stress) {
          return *law.law->check_flow(
            {elastic.strain(trial), V::Zero(), stress, none.data()}, {});
        };
        const FlowCheck check = check_of(answer.stress);
        natural.add(check.natural_map);
        dual.add(check.dual);
        complementary.add(check.complementary);
        // Another admissible stress does not obey the law.
        other_stresses += check_of(answer.stress / 2.).natural_map < 1e-3 &&
                          answer.stress.norm() > 1.;
        if (associated)
          for (const V &other : admissible)
            nearer.add(-(other - answer.stress).dot(z));
        // Differences where no edge is near.
        M    slopes;
        bool smooth = true;
        for (int j = 0; j < 4; ++j)
          {
            V step                  = V::Zero();
            step[j]                 = 1e-5;
            const Law::Answer plus  = law(trial + elastic.stress(step)),
                              minus = law(trial - elastic.stress(step));
            const V curved =
              plus.stress + minus.stress - 2. * answer.stress; // 0 where smooth
            smooth = smooth && curved.norm() < 1e-6 && plus.mode == minus.mode;
            slopes.col(j) = (plus.stress - minus.stress) / 2e-5;
          }
        if (smooth)
          differences.add((slopes - answer.tangent).norm() / 100.);
      }
    std::cout << type << (associated ? ", associated" : "") << ": all modes "
              << (counts[0] > 10 && counts[1] > 10 &&
                      (counts[2] > 10 ||
                       parameters.find("angle") == std::string::npos)
                    ? "met"
                    : "not met")
              << std::endl;
    print_below("beyond the strength", beyond, "1e-12");
    if (associated)
      print_below("nearer admissible stresses", nearer, "1e-12");
    print_below("natural map", natural, "1e-12");
    print_below("flow beyond all normals", dual, "1e-12");
    print_below("complementarity", complementary, "1e-12");
    print("other stresses do not obey the law", other_stresses == 0);
    print_below("tangent against differences", differences, "1e-5");
  }

  /** Shear of plane strain until the stress stands, under a mean stress that is held. */
  void
  check_match()
  {
    const double c = 2., phi = 25.;
    const Law    law("Drucker-Prager",
                  "set Cohesion = 2\nset Friction angle = 25\n"
                     "set Dilatancy angle = 25\nset Match = plane strain\n");
    // Associated flow dilates: the volume is let go so that the mean stress stays.
    V            stress = V::Zero();
    const double K      = law.law->elasticity().normal_stiffness();
    for (unsigned int step = 0; step < 4000; ++step)
      {
        V e;
        e << 0., 0., 0.01, 0.;
        for (unsigned int k = 0; k < 20; ++k)
          {
            const V now = law(stress + law.law->elasticity().stress(e)).stress;
            e.head<2>().array() += (-5. - (now[0] + now[1]) / 2.) / K;
          }
        stress = law(stress + law.law->elasticity().stress(e)).stress;
      }
    const double strength =
      sqrt2 * (5. * std::sin(radians(phi)) + c * std::cos(radians(phi)));
    print("Drucker-Prager flows in plane strain at Mohr-Coulomb's strength",
          std::abs(to_cone_axes(Mandel(stress.head<3>())).tail<2>().norm() /
                     strength -
                   1.) < 1e-6);
  }

  void
  test()
  {
    const std::string c       = "set Cohesion = 2\n",
                      phi     = "set Friction angle = 30\n",
                      same    = "set Dilatancy angle = 30\n",
                      without = "set Dilatancy angle = 5\n";
    check("spatial Tresca", c, true);
    check("spatial Mohr-Coulomb", c + phi + same, true);
    check("spatial Mohr-Coulomb", c + phi + without, false);
    check("von Mises", c, true);
    check("Drucker-Prager", c + phi + same, true);
    check("Drucker-Prager", c + phi + without + "set Match = outer\n", false);
    check("Drucker-Prager", c + phi + same + "set Match = inner\n", true);
    check_match();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_spatial_laws_01
