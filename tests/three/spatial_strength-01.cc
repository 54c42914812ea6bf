// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, bounds in three dimensions would be those of another law. For random
// stresses of each law, the cones of the solver, the ratio to the strength of the
// certificate, and the yield condition in principal stresses must agree on what is
// admissible. The dissipation of random rates must be reached by an admissible stress and
// exceeded by none, and a jump must dissipate as the strain of a thin layer.

#include <geocone/base/types.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/conic/strength_law.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

namespace three_spatial_strength_01
{
  using namespace geocone;
  using namespace geocone::dim3;

  constexpr double k = 1.3;

  Eigen::Vector3d
  principal(const Mandel &s)
  {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
             SemidefiniteCone::matrix(s))
      .eigenvalues()
      .reverse();
  }

  /** Yield function over k, from principal stresses. */
  double
  yield_function(const SpatialStrength &law, const Eigen::Vector3d &s)
  {
    if (law.is_circular)
      {
        const double p = s.mean();
        return ((s.array() - p).matrix().norm() + law.a * std::sqrt(3.) * p) /
                 k -
               1.;
      }
    return std::max(((1. + law.a) * s[0] - (1. - law.a) * s[2]) / k - 1.,
                    law.is_cut() ? (s[0] - law.tension) / k : -1.);
  }

  /** How much X = k o - A (s, t) is outside of its cones, for the best t. */
  double
  excess_of_cones(const SpatialStrength &law, const Mandel &s)
  {
    if (law.is_circular)
      {
        const CircularCone cone = circular_cone(law.a);
        return SecondOrderCone<6>::excess(k * cone.o - cone.A * s);
      }
    // Between what both matrices ask of t.
    const Eigen::Vector3d       l = principal(s);
    Eigen::Matrix<double, 7, 1> y;
    y << s, ((1. + law.a) * l[0] - k + (1. - law.a) * l[2]) / 2.;
    if (law.is_cut())
      {
        const CutMohrCoulombCones cones =
          cut_mohr_coulomb_cones(law.a, law.tension / k);
        return CutMohrCoulombCones::Cone::excess(k * cones.o - cones.A * y);
      }
    const MohrCoulombCones cones = mohr_coulomb_cones(law.a);
    return MohrCoulombCones::Cone::excess(k * cones.o - cones.A * y);
  }

  void
  check(const std::string &name, const SpatialStrength &law)
  {
    std::mt19937                     random(1);
    std::normal_distribution<double> normal;
    const auto                       tensor = [&]() {
      Mandel s;
      for (unsigned int i = 0; i < 6; ++i)
        s[i] = normal(random);
      return s;
    };
    constexpr unsigned int n      = 2000;
    unsigned int           inside = 0, outside = 0, wrong = 0;
    std::vector<Mandel>    admissible;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Mandel s = 0.4 * tensor();
        const double f = yield_function(law, principal(s));
        if (std::abs(f) < 1e-9)
          continue; // of rounding
        ++(f < 0. ? inside : outside);
        wrong +=
          (law.utilisation(k, SemidefiniteCone::matrix(s)) <= 1.) != (f < 0.);
        wrong += (excess_of_cones(law, s) <= 0.) != (f < 0.);
        if (f < 0.)
          admissible.push_back(s);
      }
    std::cout << name << ": inside and outside " << (inside > 50) << ' '
              << (outside > 50) << ", disagreements " << wrong;

    // Rates: admissible ones are made by an expansion, or by its removal for phi = 0.
    double       beyond = 0., missed = 0., jump = 0.;
    unsigned int n_rates           = 0;
    const bool   is_incompressible = law.a == 0. && !law.is_cut();
    for (unsigned int i = 0; i < n; ++i)
      {
        Eigen::Matrix3d e = SemidefiniteCone::matrix(tensor());
        const double    expansion =
          is_incompressible ? 0. : std::abs(normal(random)) * e.norm();
        e += (expansion - e.trace() / 3.) * Eigen::Matrix3d::Identity();
        const SpatialStrength::Flow flow = law.flow(k, e);
        const Mandel    rate = SemidefiniteCone::vector(e);
        if (flow.miss > 0.)
          continue; // some ray of admissible stresses has a growing power
        ++n_rates;
        for (unsigned int j = 0; j < 20; ++j)
          beyond =
            std::max(beyond,
                     admissible[(20 * i + j) % admissible.size()].dot(rate) -
                       flow.dissipation);
        // The best admissible stress: at the apex, on the cone, or at the cut-off.
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(e);
        Eigen::Matrix3d                                      best;
        if (law.is_circular)
          best = law.a > 0.
                   ? k / (law.a * std::sqrt(3.)) * Eigen::Matrix3d::Identity()
                   : Eigen::Matrix3d(k * e / e.norm());
        else
          {
            const double    largest = law.is_cut()
                                        ? law.tension
                                        : (law.a > 0. ? k / (2. * law.a) : k / 2.);
            const double    least = ((1. + law.a) * largest - k) / (1. - law.a);
            Eigen::Vector3d l     = solver.eigenvalues();
            for (unsigned int d = 0; d < 3; ++d)
              l[d] = l[d] > 0. ? largest : least;
            best = solver.eigenvectors() * l.asDiagonal() *
                   solver.eigenvectors().transpose();
          }
        const Mandel s = SemidefiniteCone::vector(best);
        missed         = std::max({missed,
                                   std::abs(s.dot(rate) - flow.dissipation),
                                   yield_function(law, principal(s))});
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        const double u_t  = std::abs(normal(random)),
                     u_n  = is_incompressible ? 0. : 2. * u_t * normal(random);
        Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
        e(0, 0)           = u_n;
        e(0, 1) = e(1, 0)      = u_t / 2.;
        const SpatialStrength::Flow layer  = law.flow(k, e),
                                    across = law.flow_of_jump(
                                      law.face_cohesion_per_k() * k, u_n, u_t);
        if ((layer.miss > 0.) != (across.miss > 0.))
          jump = 1.;
        if (layer.miss <= 0.)
          jump =
            std::max(jump, std::abs(layer.dissipation - across.dissipation));
      }
    std::cout << "; rates " << (n_rates > 100) << ", power beyond "
              << (beyond > 1e-9) << ", not reached " << (missed > 1e-9)
              << ", jumps differ " << (jump > 1e-9) << "\n";
  }

  void
  test()
  {
    SpatialStrength law;
    law.k = k;
    for (const double phi : {0., 20., 40.})
      {
        law.a = std::sin(phi * M_PI / 180.);
        check("Mohr-Coulomb " + std::to_string(int(phi)), law);
        law.tension = 0.3;
        check("Mohr-Coulomb " + std::to_string(int(phi)) + " with a cut-off",
              law);
        law.tension = std::numeric_limits<double>::infinity();
      }
    law.is_circular = true;
    for (const double a : {0., 0.4})
      {
        law.a = a;
        check("circular cone " + std::string(a > 0. ? "0.4" : "0"), law);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace three_spatial_strength_01
