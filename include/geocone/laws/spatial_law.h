// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_spatial_law_h
#define geocone_laws_spatial_law_h

#include <geocone/laws/frictional.h>
#include <geocone/materials/material.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Base class of three-dimensional ("spatial") laws, which depend on the full
   * stress tensor. Stresses have four components in plane strain and
   * axisymmetry, and six in three dimensions. In plane strain the plastic
   * strain along z is balanced by elastic strain, so that s_zz follows from the
   * flow rule and affects the result.
   */
  class SpatialLaw : public Material
  {
  public:
    using Material::Material;

    bool
    is_spatial() const override
    {
      return true;
    }

    void
    update(const Increment &increment, const Response &response) const override;

    std::optional<double>
    overstress(const Mandel &stress, const double *history) const override;

  protected:
    /**
     * Stress update of one point: computes the stress s at t_{n+1}.
     * @param history_n of the point
     * @param[out] history history variables after those of Material, or null
     * @param[out] tangent ds/de, or null
     */
    virtual Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepData      &step,
            SpatialMandel       &stress,
            double              *history,
            SpatialMandelMatrix *tangent) const = 0;
  };

  /** Base class of three-dimensional laws with linear elasticity and without
   *  internal variables. */
  class SpatialReturnMap : public SpatialLaw
  {
  public:
    using SpatialLaw::SpatialLaw;

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double * /*history*/) const override
    {
      return elasticity().strain(SpatialMandel(to - from));
    }

  protected:
    /** Strength variables of a point in a step: cohesion increase, and delayed
     *  normal stress p of friction with memory. In the strength, p has the
     *  weight lambda, and the normal stress at the end of the step has the
     *  weight 1 - lambda. */
    struct OwnStrength
    {
      double cohesion = 0.; ///< increase above the law's cohesion (Pa)
      double part     = 0.; ///< weight lambda (-)
      double normal = 0.; ///< p (Pa), as FrictionalSpatialLaw::normal_stress()
    };

    virtual OwnStrength
    own_strength(const SpatialMandel & /*stress_n*/,
                 const double * /*history_n*/,
                 const StepData & /*step*/) const
    {
      return {};
    }

    /** Updates the history variables of a point after a step. */
    virtual void
    remember(const SpatialMandel & /*stress*/,
             const StepData & /*step*/,
             double * /*history*/) const
    {}

    /** Return mapping: computes the stress at t_{n+1} from the trial stress s_n
     *  + D e (elastic stiffness D, strain increment e).
     *  @param[out] tangent ds/de, or null */
    virtual Mode
    return_to_strength(const SpatialMandel &trial,
                       const OwnStrength   &own,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const = 0;

    Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepData      &step,
            SpatialMandel       &stress,
            double              *history,
            SpatialMandelMatrix *tangent) const override
    {
      const Mode mode =
        return_to_strength(stress_n + elasticity().stress(strain),
                           own_strength(stress_n, history_n, step),
                           stress,
                           tangent);
      if (history != nullptr)
        remember(stress, step, history);
      return mode;
    }
  };

  /**
   * Base class of three-dimensional laws with cohesion, friction and dilatancy.
   * Options are friction memory (FrictionMemory) and a cohesion that varies in
   * space.
   */
  class FrictionalSpatialLaw : public Frictional<SpatialReturnMap>
  {
  public:
    void
    prepare() override;

    void
    reduce_strength(const double F) override
    {
      set_strength(F);
    }

    /** Earth pressure coefficient at rest by Jaky's formula, 1 - sin(phi). */
    double
    earth_pressure_at_rest() const override;

    std::optional<FlowCheck>
    check_flow(const PointStep &point, const StepData &step) const override;

  protected:
    /** Normal stress on which the strength depends (Pa), compression
     *  positive. */
    virtual double
    normal_stress(const SpatialMandel &stress) const = 0;

    /** Checks yield condition and flow rule for a given plastic strain
     *  increment, see check_flow(). */
    virtual FlowCheck
    check_plastic_strain(const SpatialMandel &plastic_strain,
                         const SpatialMandel &stress,
                         const OwnStrength   &own) const = 0;

    OwnStrength
    own_strength(const SpatialMandel &stress_n,
                 const double        *history_n,
                 const StepData      &step) const override;

    void
    remember(const SpatialMandel &stress,
             const StepData      &step,
             double              *history) const override;

    using Frictional::Frictional;

    /** Sets the strength parameters to the input values after strength
     *  reduction by the factor F. */
    virtual void
    set_strength(const double F) = 0;

    double
    remembered_stress(const Stress &stress) const override
    {
      return normal_stress(spatial_of(stress));
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
