// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_drucker_prager_h
#define geocone_laws_drucker_prager_h

#include <geocone/base/choice.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/laws/spatial_law.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Drucker-Prager law (Drucker and Prager 1952). The yield surface is a
   * circular cone in three-dimensional stress space,
   *   sqrt(J_2) + alpha I_1 <= kappa,  I_1 = tr s,
   * and the plastic potential is the same cone for the dilatancy angle. In
   * components along and across the axis n = -(1, 1, 0, 1)/sqrt3 it is the
   * FlowCone
   *   |s_t| <= a s_n + k,   a = sqrt6 alpha,  k = sqrt2 kappa,
   * with D = diag(3 lambda + 2G, 2G, 2G, 2G): return mapping, change of
   * variable and natural map are those of MohrCoulomb's in-plane cone with more
   * components.
   *
   * The size of the cone is matched to the Mohr-Coulomb pyramid (s = sin, t =
   * tan of the angle):
   *   outer (compression edges)        alpha = 2 s/(sqrt3 (3 - s)),
   *                                    kappa = 6 c cos/(sqrt3 (3 - s))
   *   inner (extension edges)          alpha = 2 s/(sqrt3 (3 + s)),
   *                                    kappa = 6 c cos/(sqrt3 (3 + s))
   *   plane strain (associated flow)   alpha = t/sqrt(9 + 12 t^2),
   *                                    kappa = 3 c/sqrt(9 + 12 t^2).
   */
  class DruckerPrager : public FrictionalSpatialLaw
  {
  public:
    explicit DruckerPrager(const std::string &section);

    std::optional<FrictionalStrength>
    plane_strain_strength() const override
    {
      return match == Match::plane_strain ? std::optional(given) : std::nullopt;
    }

    double
    non_associativity() const override
    {
      return cone.a > 0. ? (cone.a - cone.b) / cone.a : 0.;
    }
    bool
    dilates() const override
    {
      return cone.b > 0.;
    }

    /** Yield cone of the exact law (without friction memory) in three
     *  dimensions. No value in plane problems, where the law also determines
     *  s_zz. */
    std::optional<FlowCone>
    flow_cone(const double *history) const override
    {
      return dim == 3 ? std::optional(cone_with(cohesion_increase(history)))
                      : std::nullopt;
    }

    /** Returns true if the cohesion does not vary in space. */
    bool
    has_constant_cohesion() const
    {
      return !cohesion_grows();
    }

    /** Initial yield cone of the exact law in the space of all stress components. */
    const FlowCone &
    spatial_cone() const
    {
      return cone;
    }

    std::optional<FlowCone>
    step_cone(const Mandel   &stress_n,
              const double   *history_n,
              const StepData &step) const override;

    bool
    has_natural_map() const override
    {
      return dim == 3;
    }

    double
    excess_work_density(const SpatialMandel &plastic_strain,
                        const SpatialMandel &stress,
                        const double        *history) const override;

    std::optional<double>
    yield_function(const SpatialMandel &stress,
                   const double        *history) const override;

  protected:
    using FrictionalSpatialLaw::FrictionalSpatialLaw;

    void
    set_strength(const double F) override;

    FlowCheck
    check_plastic_strain(const SpatialMandel &plastic_strain,
                         const SpatialMandel &stress,
                         const OwnStrength   &own) const override;

    /** Normal stress s_n, the stress component along the cone axis (Pa). */
    double
    normal_stress(const SpatialMandel &stress) const override
    {
      return spatial_axes().row(0).dot(stress);
    }

    Mode
    return_to_strength(const SpatialMandel &trial,
                       const OwnStrength   &own,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const override;

  private:
    enum class Match
    {
      plane_strain,
      outer,
      inner
    };
    Choice<Match> match = {{{"plane strain", Match::plane_strain},
                            {"outer", Match::outer},
                            {"inner", Match::inner}}};

    /** Yield cone of a step, in which the strength includes the delayed part of
     *  the normal stress (friction with memory). */
    FlowCone
    cone_of(const OwnStrength &own) const
    {
      return cone_with(own.cohesion).delayed(own.part, own.normal);
    }

    /** Yield cone after an increase of the cohesion by @p cohesion (Pa). */
    FlowCone
    cone_with(const double cohesion) const
    {
      FlowCone here = cone;
      here.k += k_per_cohesion * cohesion;
      return here;
    }

    FlowCone cone;
    double   k_per_cohesion = 0.; ///< dk/dc (-)
  };

  /** Von Mises law, sqrt(J_2) <= c: the Drucker-Prager law with phi = theta =
   *  0. */
  class VonMises : public DruckerPrager
  {
  public:
    explicit VonMises(const std::string &section)
      : DruckerPrager(section, "Strength c (Pa) in pure shear, > 0.")
    {}
  };
} // namespace geocone::GEOCONE_DIM

#endif
