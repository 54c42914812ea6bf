// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/pyramid_body.h>
#include <geocone/kernels/pyramid_kernel.h>
#include <geocone/laws/spatial_mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Principal values in decreasing order, and the Mandel vectors of their
     *  directions: first the columns n_i n_i, then sqrt(2) sym(n_i n_j) of each
     *  pair that can rotate into each other. */
    template <int n>
    struct Spectrum
    {
      Eigen::Vector3d                            value;
      Eigen::Matrix<double, n, n>                directions;
      std::array<std::array<unsigned int, 2>, 3> pair = {};
    };

    /** Spectrum of (xx, yy, sqrt2 xy, zz), where z is a principal direction. */
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

    /** Spectrum of a general tensor. */
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

    /**
     * Derivative of an isotropic tensor function y(x), times a factor: of the
     * returned stress with respect to strain, through the trial stress x.
     * @param at x
     * @param y,C principal values of y there, and their derivatives, with the
     * factor
     * @param scale the factor, for shear components
     */
    template <int n>
    Eigen::Matrix<double, n, n, Eigen::RowMajor>
    slope_in_axes(const Spectrum<n>     &at,
                  const Eigen::Vector3d &y,
                  const Eigen::Matrix3d &C,
                  const double           scale)
    {
      using Matrix = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
      Matrix along = Matrix::Zero();
      along.template topLeftCorner<3, 3>() = C;
      for (int k = 3; k < n; ++k)
        {
          // Shear rotates the directions: (y_a - y_b)/(x_a - x_b).
          const auto [a, b]  = at.pair[k - 3];
          const double apart = at.value[a] - at.value[b];
          along(k, k) = std::abs(apart) > 1e-12 * (std::abs(at.value[a]) +
                                                   std::abs(at.value[b]))
                          ? scale * (y[a] - y[b]) / apart
                          : C(a, a) - C(a, b);
        }
      return at.directions * (along * at.directions.transpose());
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

  void
  SpatialMohrCoulomb::advance(const PointBlock &block, LawCounts &counts) const
  {
    counts.updates += block.n_points;
    PyramidConstants pyramid;
    pyramid.flow   = sin_theta;
    pyramid.size   = exact.size;
    pyramid.lambda = elasticity().lambda;
    pyramid.two_G  = elasticity().two_G;
    if (memory.time() > 0.)
      {
        pyramid.memory        = index_of_memory();
        pyramid.memory_factor = memory.remembered(block.step);
        pyramid.delayed_sine = pyramid.memory_factor * (exact.sine - sin_theta);
      }
    pyramid.sine = exact.sine - pyramid.delayed_sine;
    if (cohesion_grows())
      {
        pyramid.growth            = index_of_growth();
        pyramid.size_per_cohesion = size_per_cohesion;
      }
    advance_pyramid(pyramid, block);
  }

  std::optional<double>
  SpatialMohrCoulomb::yield_function(const SpatialMandel &stress,
                                     const double        *history) const
  {
    return pyramid_with(cohesion_increase(history))
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
  SpatialMohrCoulomb::excess_work_density(const SpatialMandel &plastic_strain,
                                          const SpatialMandel &stress,
                                          const double        *history) const
  {
    // Active planes have the same f, and g_ij = (1 + sin(theta),
    // -1 + sin(theta)).
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
    const Normal    y        = normal_of(plastic_strain, solved, nullptr);
    const Principal s        = spectrum(stress).value;
    const double    two_G    = elasticity().two_G;

    FlowCheck here;
    here.stress     = stress.norm();
    here.size       = exact_here.size / sqrt2;
    here.flow       = y.whole.norm();
    here.compliance = 1. / two_G;
    here.violation  = solved.yield_function(s);
    here.excess     = exact_here.yield_function(s);
    // Normals satisfy (1 - sin(phi)) plus >= (1 + sin(phi)) minus, with
    // inequality at the apex.
    here.dual =
      std::max(0., (1. + solved.sine) * y.minus - (1. - solved.sine) * y.plus);
    here.complementary =
      std::abs(stress.dot(y.whole) -
               (solved.sine > 0. ? solved.apex() * (y.plus - y.minus)
                                 : solved.size / 2. * (y.plus + y.minus)));
    SpatialMandel projected;
    project(solved, stress + two_G * y.whole, projected, nullptr);
    here.natural_map = (stress - projected).norm();
    project(exact_here,
            stress +
              two_G * normal_of(plastic_strain, exact_here, nullptr).whole,
            projected,
            nullptr);
    here.exact_map = (stress - projected).norm();
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
    const PyramidReturn<double> returns(
      strength.sine, flow, elastic.lambda, elastic.two_G);
    const double f = returns.yield_function(trial, 0, 2, strength.size);
    if (f <= 0.)
      {
        stress  = trial;
        tangent = D;
        return Mode::elastic;
      }
    // D g_ij and, with sin(phi) for sin(theta), D f_ij.
    const PyramidReturn<double> normal(
      strength.sine, strength.sine, elastic.lambda, elastic.two_G);
    const auto stiff = [](const auto &of, const int i, const int j) {
      return Principal(
        of.stiff_flow(i, j, 0), of.stiff_flow(i, j, 1), of.stiff_flow(i, j, 2));
    };
    const Principal Dg = stiff(returns, 0, 2), Df = stiff(normal, 0, 2);
    returns.to_plane(trial, f, stress);
    if (stress[0] >= stress[1] && stress[1] >= stress[2])
      {
        tangent = D - returns.per_H * Dg * Df.transpose();
        return Mode::cone;
      }
    const int e = returns.edge_indicator(trial) > 0. ? 0 : 1;
    returns.to_edge(e, trial, f, strength.size, stress);
    if (stress[0] + stress[2] <= 2. * strength.apex())
      {
        const double    own = returns.own[e], other = returns.other[e];
        const Principal Dg_e = stiff(returns, e, e + 1);
        tangent =
          D - (own * Dg + other * Dg_e) * Df.transpose() -
          (other * Dg + own * Dg_e) * stiff(normal, e, e + 1).transpose();
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
    return return_to(
      elasticity(), delayed(own), sin_theta, trial, stress, tangent);
  }

  SpatialMohrCoulomb::Normal
  SpatialMohrCoulomb::normal_of(const SpatialMandel &plastic_strain,
                                const Pyramid       &pyramid,
                                SpatialMandelMatrix *slope) const
  {
    const auto      at = spectrum(plastic_strain);
    Normal          result;
    Principal       y;
    PrincipalMatrix factors = PrincipalMatrix::Zero();
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double sign = at.value[i] > 0. ? 1. : -1.;
        factors(i, i) = (1. + sign * pyramid.sine) / (1. + sign * sin_theta);
        y[i]          = factors(i, i) * at.value[i];
        (sign > 0. ? result.plus : result.minus) += std::abs(y[i]);
      }
    result.whole = at.directions.template leftCols<3>() * y;
    if (slope != nullptr)
      *slope = slope_in_axes(at, y, factors, 1.);
    return result;
  }

  std::optional<Material::Projection>
  SpatialMohrCoulomb::project_natural_map(const Mandel   &s,
                                          const Mandel   &z,
                                          const double    rho,
                                          const Mandel   &stress_n,
                                          const double   *history_n,
                                          const StepData &step) const
  {
    if (dim == 2)
      return std::nullopt;
    const Pyramid pyramid =
      delayed(own_strength(extended(stress_n, 0.), history_n, step));
    SpatialMandelMatrix psi_slope, slope;
    SpatialMandel       projected;
    // Psi is odd, and z is the negative plastic strain.
    const Normal y = normal_of(-extended(z, 0.), pyramid, &psi_slope);
    Projection   result;
    result.mode =
      project(pyramid, extended(s, 0.) + rho * y.whole, projected, &slope);
    result.stress    = projected.head<n_mandel>();
    result.slope     = slope.topLeftCorner<n_mandel, n_mandel>();
    result.psi_slope = psi_slope.topLeftCorner<n_mandel, n_mandel>();
    return result;
  }

  Mode
  SpatialMohrCoulomb::return_to(const Elasticity    &elastic,
                                const Pyramid       &pyramid,
                                const double         flow,
                                const SpatialMandel &trial,
                                SpatialMandel       &stress,
                                SpatialMandelMatrix *tangent)
  {
    if (pyramid.holds_cone(trial))
      {
        stress = trial;
        if (tangent != nullptr)
          *tangent = elastic.stiffness<n_spatial>();
        return Mode::elastic;
      }
    const auto      at = spectrum(trial);
    Principal       s;
    PrincipalMatrix C;
    const Mode mode = return_principal(elastic, pyramid, flow, at.value, s, C);
    // Elastic points keep their trial stress exactly.
    if (mode == Mode::elastic)
      stress = trial;
    else
      stress = at.directions.template leftCols<3>() * s;
    if (tangent == nullptr)
      return mode;
    *tangent = slope_in_axes(at, s, C, elastic.two_G);
    return mode;
  }
} // namespace geocone::GEOCONE_DIM
