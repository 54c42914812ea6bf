// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_mohr_coulomb_h
#define geocone_laws_mohr_coulomb_h

#include <geocone/laws/frictional.h>
#include <geocone/laws/with_stiffness_formula.h>
#include <geocone/materials/undrained_anisotropy.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Perfectly plastic Mohr-Coulomb law in plane strain. The yield surface is
   * the in-plane cone of Guillet et al. 2025 (appendix A),
   *   |s_t| <= sin(phi) s_n + sqrt2 c cos(phi),  flow aperture sin(theta),
   * with friction angle phi, dilatancy angle theta <= phi and cohesion c. phi =
   * 0 is Tresca's cylinder, |s_t| <= sqrt2 c. Yielding depends on the in-plane
   * stresses: the out-of-plane stress is assumed intermediate. theta = phi is
   * associated flow, theta = 0 flow without dilatancy. A tensile strength T is
   * Rankine's cut-off, sigma_1 <= T in the plane: |s_t| <= s_n + sqrt2 T.
   *
   * Friction with memory (doc/theory/friction_memory.md; Prakash and Clifton
   * 1993 and Cochard and Rice 2000 for sliding): the strength follows the
   * normal stress with the relaxation time tau, by the second history variable
   * p (Pa),
   *   |s_t| <= b s_n + mu p + sqrt2 c cos(phi),   dp/dt = (s_n - p)/tau,
   * with the apertures a and b and mu = a - b. A step h has p = lambda p_n + (1
   * - lambda) s_n with lambda = tau/(h + tau): the cone with the aperture a -
   * lambda mu and the same flow, FlowCone::delayed(lambda, p_n). In a steady
   * state p = s_n, the exact strength; tau = 0 is the exact law. The plastic
   * work is never negative, since p >= -k/a at all times.
   */
  class MohrCoulomb : public Frictional<WithStiffnessFormula<Material>>
  {
  public:
    explicit MohrCoulomb(const std::string &section)
      : Frictional(section)
    {
      given.declare_tension(*this);
      anisotropy.declare(*this);
    }

    void
    prepare() override;

    void
    update(const Increment &increment, const Response &response) const override;

    /** Yield cone of the exact law (without friction memory). */
    std::optional<FlowCone>
    flow_cone(const double *history) const override;

    /** Returns true if the natural map s - P_C(s - rho Psi(z)) is implemented
     *  for the law. The map exists only without tension cut-off, because it
     *  projects onto the cone alone. */
    bool
    has_natural_map() const override
    {
      return !cone.is_cut();
    }

    StrengthGradient
    growth() const override
    {
      return {k_per_cohesion * given.gradient, given.level};
    }

    std::optional<FlowCone>
    step_cone(const Mandel   &stress_n,
              const double   *history_n,
              const StepData &step) const override;

    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    void
    set_friction_memory(const double tau) override;

    void
    reduce_strength(const double F) override;

    std::optional<FrictionalStrength>
    plane_strain_strength() const override
    {
      return given;
    }

    /** Undrained strengths by direction, of bounds alone. */
    const UndrainedAnisotropy &
    undrained_anisotropy() const
    {
      return anisotropy;
    }

    double
    cohesion() const
    {
      return given.c;
    }

    /** Friction angle (degrees). */
    double
    friction_angle() const
    {
      return given.phi;
    }

    /** Dilatancy angle (degrees). */
    double
    dilatancy_angle() const
    {
      return given.theta;
    }

    /** Increase of the cohesion with depth (Pa/m). */
    double
    cohesion_gradient() const
    {
      return given.gradient;
    }

  protected:
    /** Returns true if the yield cone depends nonlinearly on the plastic shear
     *  of the step (see end_cone()). */
    virtual bool
    varies() const
    {
      return false;
    }

    /** Updates the history variables of hardening laws after a step.
     *  @param slip |z_t| of the step (-) */
    virtual void
    add_to_history(const double /*slip*/, double * /*history*/) const
    {}

    /** Yield cone for given cohesion (Pa), friction angle and dilatancy angle
     *  (degrees). */
    static FlowCone
    cone_of(const double cohesion, const double phi, const double theta);

    /** Yield cone of a step with friction memory; see step_cone().
     *  @param exact cone without memory */
    FlowCone
    with_memory(const FlowCone &exact,
                const Mandel   &stress_n,
                const double   *history_n,
                const StepData &step) const;

    std::optional<FlowCone>
    strength(const double *history) const override;

    double
    remembered_stress(const Stress &stress) const override
    {
      return -(stress[0] + stress[1]) / sqrt2;
    }

    using Frictional::Frictional;

    UndrainedAnisotropy anisotropy;

  private:
    FlowCone cone;
    double   k_per_cohesion = 0.; ///< dk/dc after reduction (-)

    /**
     * Return mapping of one material point, in cone axes.
     * @param elastic of the point
     * @param trial s_n + D e @param[out] slip |z_t| of the step (-)
     * @param[out] tangent ds/de, or null
     */
    Mode
    return_to_cone(const Elasticity &elastic,
                   const Mandel     &trial,
                   const Mandel     &stress_n,
                   const double     *history_n,
                   const StepData   &step,
                   Mandel           &stress,
                   double           &slip,
                   MandelMatrix     *tangent) const;

    void
    set_cone(const double F);
  };

  /** Tresca law in plane strain, |s1 - s2| <= 2c: the Mohr-Coulomb law with phi
   *  = theta = 0. */
  class Tresca : public MohrCoulomb
  {
  public:
    explicit Tresca(const std::string &section)
      : MohrCoulomb(section,
                    "Undrained shear strength c [Pa], > 0; that in active "
                    "compression beside strength ratios.")
    {
      given.declare_tension(*this);
      anisotropy.declare(*this);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
