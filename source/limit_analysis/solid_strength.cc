// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/types.h>
#include <geocone/limit_analysis/solid_strength.h>
#include <geocone/limit_analysis/symmetric_cones.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Error of computed eigenvalues of symmetric 3 x 3 matrices, relative to their norm:
     *  some ten units of the last place, by Weyl's theorem. */
    constexpr double of_eigenvalues = 1e-14;

    /** Eigenvalues in increasing order. */
    Eigen::Vector3d
    eigenvalues_of(const Eigen::Matrix3d &m)
    {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
               m, Eigen::EigenvaluesOnly)
        .eigenvalues();
    }
  } // namespace

  void
  SolidStrength::reduce(const double F)
  {
    double by = F; // of k = 2 c cos(phi)
    if (!is_circular)
      {
        const double cosine = std::sqrt(1. - a * a), sine = a;
        a = sine / std::hypot(F * cosine, sine);
        by *= cosine / std::sqrt(1. - a * a);
      }
    k /= by;
    growth.slope /= by;
    tension /= F;
  }

  double
  SolidStrength::face_friction() const
  {
    return is_circular ? std::sqrt(3. * a * a / (2. - 4. * a * a))
                       : a / std::sqrt(1. - a * a);
  }

  double
  SolidStrength::face_cohesion_per_k() const
  {
    if (!is_circular)
      return 1. / (2. * std::sqrt(1. - a * a));
    return a > 0. ? face_friction() / (a * std::sqrt(3.)) : 1. / std::sqrt(2.);
  }

  double
  SolidStrength::utilisation(const double k, const Mandel &s) const
  {
    const double guard = of_eigenvalues * s.norm();
    if (is_circular)
      {
        const double mean     = (s[0] + s[1] + s[3]) / 3.;
        Mandel       deviator = s;
        for (const int i : index_of_normal)
          deviator[i] -= mean;
        return (deviator.norm() + a * std::sqrt(3.) * mean + guard) / k;
      }
    const Eigen::Vector3d l = eigenvalues_of(SemidefiniteCone::matrix(s));
    return std::max(((1. + a) * l[2] - (1. - a) * l[0] + 4. * guard) / k,
                    (l[2] + guard) / tension);
  }

  SolidFlow
  SolidStrength::flow(const double k, const Eigen::Matrix3d &e) const
  {
    SolidFlow    flow;
    const double trace = e.trace(), guard = of_eigenvalues * e.norm();
    if (is_circular)
      {
        const double shear =
          (e - trace / 3. * Eigen::Matrix3d::Identity()).norm();
        const double expansion = trace / std::sqrt(3.);
        if (a > 0.)
          {
            flow.miss        = a * shear - expansion + guard;
            flow.dissipation = k / a * expansion;
          }
        else
          {
            flow.constrained = std::abs(trace);
            flow.dissipation = k * shear;
          }
        return flow;
      }
    const double sum = eigenvalues_of(e).cwiseAbs().sum();
    if (is_cut())
      {
        // s_1 = T and s_3 = ((1 + a) T - k)/(1 - a), by the signs of the rates.
        const double shortening = (sum - trace) / 2. / (1. - a);
        flow.miss               = a * sum - trace + 4. * guard;
        flow.dissipation =
          tension * ((sum + trace) / 2. - (1. + a) * shortening) +
          k * shortening + (tension + k) * 4. * guard;
      }
    else if (a > 0.)
      {
        flow.miss        = a * sum - trace + 4. * guard;
        flow.dissipation = k / (2. * a) * trace;
      }
    else
      {
        flow.constrained = std::abs(trace);
        flow.dissipation = k / 2. * sum;
      }
    return flow;
  }

  SolidFlow
  SolidStrength::flow_of_jump(const double c,
                              const double u_n,
                              const double u_t) const
  {
    if (is_cut())
      {
        // Strain of a thin layer, sym(u x n).
        Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
        e(0, 0)           = u_n;
        e(0, 1) = e(1, 0) = u_t / 2.;
        return flow(c / face_cohesion_per_k(), e);
      }
    SolidFlow    flow;
    const double mu = face_friction();
    if (mu > 0.)
      {
        flow.miss = mu * u_t - u_n + of_eigenvalues * std::hypot(u_n, u_t);
        flow.dissipation = c / mu * u_n;
      }
    else
      {
        flow.constrained = std::abs(u_n);
        flow.dissipation = c * u_t;
      }
    return flow;
  }
} // namespace geocone::GEOCONE_DIM
