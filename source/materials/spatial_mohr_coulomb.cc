// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/materials/spatial_mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace geocone
{
  namespace
  {
    /** Principal values in falling order, and the Mandel vectors of their directions:
     *  by columns first those n_i n_i, then sqrt(2) sym(n_i n_j) of each pair that can
     *  turn into each other. */
    template <int n>
    struct Spectrum
    {
      Eigen::Vector3d                            value;
      Eigen::Matrix<double, n, n>                directions;
      std::array<std::array<unsigned int, 2>, 3> pair = {};
    };

    /** Of (xx, yy, sqrt2 xy, zz), where z is a principal direction. */
    [[maybe_unused]] Spectrum<4>
    spectrum(const Eigen::Vector4d &s)
    {
      const double mean = (s[0] + s[1]) / 2., half = (s[0] - s[1]) / 2.,
                   shear = s[2] / sqrt2, radius = std::hypot(half, shear);
      const double angle = radius > 0. ? std::atan2(shear, half) / 2. : 0.;
      const std::array<double, 3> values = {
        {mean + radius, mean - radius, s[3]}};
      std::array<unsigned int, 3> order = {{0, 1, 2}}, place;
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const unsigned int i, const unsigned int j) {
                         return values[i] > values[j];
                       });
      Spectrum<4> result;
      for (unsigned int i = 0; i < 3; ++i)
        {
          result.value[i] = values[order[i]];
          place[order[i]] = i;
        }
      const double c = std::cos(angle), q = std::sin(angle);
      result.directions.col(place[0]) << c * c, q * q, sqrt2 * c * q, 0.;
      result.directions.col(place[1]) << q * q, c * c, -sqrt2 * c * q, 0.;
      result.directions.col(place[2]) << 0., 0., 0., 1.;
      result.directions.col(3) << -sqrt2 * c * q, sqrt2 * c * q, c * c - q * q,
        0.;
      result.pair[0] = {{place[0], place[1]}};
      return result;
    }

    /** Of any tensor. */
    [[maybe_unused]] Spectrum<6>
    spectrum(const Eigen::Matrix<double, 6, 1> &s)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
        spatial_tensor(s));
      Spectrum<6> result;
      result.value            = eigen.eigenvalues().reverse();
      const Eigen::Matrix3d n = eigen.eigenvectors().rowwise().reverse();
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3;
          result.directions.col(i) =
            spatial_mandel(n.col(i) * n.col(i).transpose());
          result.directions.col(3 + i) =
            spatial_mandel(sqrt2 * n.col(i) * n.col(j).transpose());
          result.pair[i] = {{i, j}};
        }
      return result;
    }
  } // namespace

  void
  SpatialMohrCoulomb::set_strength(const double F)
  {
    const FrictionalStrength strength = given.reduced(F);
    const double             cosine   = std::cos(radians(strength.phi));
    exact     = {std::sin(radians(strength.phi)), 2. * strength.c * cosine};
    sin_theta = std::sin(radians(strength.theta));
    size_per_cohesion = 2. * cosine / F;
  }

  double
  SpatialMohrCoulomb::non_associativity() const
  {
    return exact.sine > 0. ? (exact.sine - sin_theta) / exact.sine : 0.;
  }

  std::optional<double>
  SpatialMohrCoulomb::yield_function(const SpatialMandel &stress,
                                     const double        *history) const
  {
    return pyramid_with(grown_cohesion(history))
      .yield_function(spectrum(stress).value);
  }

  double
  SpatialMohrCoulomb::normal_stress(const SpatialMandel &stress) const
  {
    const Principal s = spectrum(stress).value;
    return -(s[0] + s[2]) / 2.;
  }

  SpatialMohrCoulomb::Pyramid
  SpatialMohrCoulomb::delayed(const OwnStrength &own) const
  {
    const Pyramid here = pyramid_with(own.cohesion);
    const double  part = own.part * (here.sine - sin_theta);
    if (part == 0.)
      return here;
    // Not beyond the apex.
    return {here.sine - part,
            here.size - 2. * part * std::min(-own.normal, here.apex())};
  }

  void
  SpatialMohrCoulomb::set_friction_memory(const double tau)
  {
    if (FrictionMemory::is_hard(non_associativity(), exact.sine - sin_theta))
      memory.set_automatic(tau);
  }

  double
  SpatialMohrCoulomb::power_beyond_strength(const SpatialMandel &plastic_strain,
                                            const SpatialMandel &stress,
                                            const double        *history) const
  {
    // The planes that flow have the same f, and g_ij = (1 + sin(theta), -1 + sin(theta)).
    const Principal e = spectrum(plastic_strain).value;
    const double    multipliers =
      std::max(e[0] / (1. + sin_theta), -e[2] / (1. - sin_theta));
    return std::max(multipliers, 0.) *
           std::abs(*yield_function(stress, history));
  }

  FlowCheck
  SpatialMohrCoulomb::check_plastic_strain(const SpatialMandel &plastic_strain,
                                           const SpatialMandel &stress,
                                           const OwnStrength   &own) const
  {
    const Pyramid exact_here = pyramid_with(own.cohesion),
                  solved     = delayed(own);
    const auto flow          = spectrum(plastic_strain);
    Principal  y;
    double     plus = 0., minus = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      if (const double e = flow.value[i]; e > 0.)
        plus += y[i] = e * (1. + solved.sine) / (1. + sin_theta);
      else
        minus -= y[i] = e * (1. - solved.sine) / (1. - sin_theta);
    const SpatialMandel normal = flow.directions.template leftCols<3>() * y;
    const Principal     s      = spectrum(stress).value;
    const double        two_G  = elasticity().two_G;

    FlowCheck here;
    here.stress     = stress.norm();
    here.size       = exact_here.size / sqrt2;
    here.flow       = y.norm();
    here.compliance = 1. / two_G;
    here.violation  = solved.yield_function(s);
    here.excess     = exact_here.yield_function(s);
    // Normals have (1 - sin(phi)) plus >= (1 + sin(phi)) minus, with more at the apex.
    here.dual =
      std::max(0., (1. + solved.sine) * minus - (1. - solved.sine) * plus);
    here.complementary =
      std::abs(stress.dot(normal) - (solved.sine > 0.
                                       ? solved.apex() * (plus - minus)
                                       : solved.size / 2. * (plus + minus)));

    const auto      at = spectrum(SpatialMandel(stress + two_G * normal));
    Principal       projected;
    PrincipalMatrix tangent;
    return_principal(
      Elasticity(1., 0.), solved, solved.sine, at.value, projected, tangent);
    here.natural_map =
      (stress - at.directions.template leftCols<3>() * projected).norm();
    return here;
  }

  Mode
  SpatialMohrCoulomb::return_principal(const Elasticity &elastic,
                                       const Pyramid    &strength,
                                       const double      flow,
                                       const Principal  &trial,
                                       Principal        &stress,
                                       PrincipalMatrix  &tangent)
  {
    PrincipalMatrix D = elastic.two_G * PrincipalMatrix::Identity();
    D.array() += elastic.lambda;
    // Gradients of f_ij, and of the same with theta.
    const auto gradient =
      [](const unsigned int i, const unsigned int j, const double sine) {
        Principal n = Principal::Zero();
        n[i]        = 1. + sine;
        n[j]        = -1. + sine;
        return n;
      };
    const Principal f_13 = gradient(0, 2, strength.sine),
                    g_13 = gradient(0, 2, flow);
    const double f       = f_13.dot(trial) - strength.size;
    if (f <= 0.)
      {
        stress  = trial;
        tangent = D;
        return Mode::elastic;
      }
    const auto in_order = [&](const Principal &s) {
      return s[0] >= s[1] && s[1] >= s[2];
    };
    const Principal Dg = D * g_13, Df = D * f_13;
    const double    H = f_13.dot(Dg);
    stress            = trial - (f / H) * Dg;
    if (in_order(stress))
      {
        tangent = D - Dg * Df.transpose() / H;
        return Mode::cone;
      }
    // The edge on the side of the trial stress: s_2 = s_3 or s_1 = s_2.
    const bool two_three =
      (1. - flow) * trial[0] - 2. * trial[1] + (1. + flow) * trial[2] > 0.;
    const unsigned int          i = two_three ? 0 : 1, j = two_three ? 1 : 2;
    Eigen::Matrix<double, 3, 2> F, G;
    F << f_13, gradient(i, j, strength.sine);
    G << g_13, gradient(i, j, flow);
    const Eigen::Matrix<double, 3, 2> DG      = D * G;
    const Eigen::Matrix2d             inverse = (F.transpose() * DG).inverse();
    const Eigen::Vector2d             over =
      F.transpose() * trial - Eigen::Vector2d::Constant(strength.size);
    const Eigen::Vector2d gamma = inverse * over;
    stress                      = trial - DG * gamma;
    // Equal to the last digit.
    const unsigned int a = two_three ? 1 : 0, b = a + 1;
    stress[a] = stress[b] = (stress[a] + stress[b]) / 2.;
    if (stress[0] + stress[2] <= 2. * strength.apex())
      {
        tangent = D - DG * inverse * (F.transpose() * D);
        return Mode::cone;
      }
    stress.setConstant(strength.apex());
    tangent.setZero();
    return Mode::apex;
  }

  Mode
  SpatialMohrCoulomb::return_to_strength(const SpatialMandel &trial,
                                         const OwnStrength   &own,
                                         SpatialMandel       &stress,
                                         SpatialMandelMatrix *tangent) const
  {
    const Pyramid strength = delayed(own);
    if (strength.holds_cone(trial))
      {
        stress = trial;
        if (tangent != nullptr)
          *tangent = elasticity().stiffness<n_spatial>();
        return Mode::elastic;
      }
    const auto      at = spectrum(trial);
    Principal       s;
    PrincipalMatrix C;
    const Mode      mode =
      return_principal(elasticity(), strength, sin_theta, at.value, s, C);
    // An elastic point keeps its trial stress to the last digit.
    if (mode == Mode::elastic)
      stress = trial;
    else
      stress = at.directions.template leftCols<3>() * s;
    if (tangent == nullptr)
      return mode;
    SpatialMandelMatrix along   = SpatialMandelMatrix::Zero();
    along.topLeftCorner<3, 3>() = C;
    for (unsigned int k = 3; k < n_spatial; ++k)
      {
        // Shear turns the directions: (s_a - s_b)/(e_a - e_b).
        const auto [a, b]  = at.pair[k - 3];
        const double apart = at.value[a] - at.value[b];
        along(k, k)        = std::abs(apart) > 1e-12 * (std::abs(at.value[a]) +
                                                 std::abs(at.value[b]))
                               ? elasticity().two_G * (s[a] - s[b]) / apart
                               : C(a, a) - C(a, b);
      }
    *tangent = at.directions * (along * at.directions.transpose());
    return mode;
  }
} // namespace geocone
