// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_spatial_law_h
#define geocone_materials_spatial_law_h

#include <geocone/materials/frictional.h>
#include <geocone/materials/material.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * A law of the whole stress, for plane strain, axisymmetric scenes and three
   * dimensions: laws answer four or six components.
   * In plane strain flow along z is balanced by elastic strain, so that s_zz moves to
   * where the flow rule wants it; the result then depends on it.
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
     * s at t_{n+1}.
     * @param history_n of the point
     * @param[out] history what follows Material's in it, or null
     * @param[out] tangent ds/de, or null
     */
    virtual Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepLaw       &step,
            SpatialMandel       &stress,
            double              *history,
            SpatialMandelMatrix *tangent) const = 0;
  };

  /** A spatial law of linear elasticity without internal variables. */
  class SpatialReturnMap : public SpatialLaw
  {
  public:
    using SpatialLaw::SpatialLaw;

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to) const override
    {
      return elasticity().strain(SpatialMandel(to - from));
    }

  protected:
    /** What of its strength is a point's own: how much the cohesion has grown, and the
     *  part lambda that is what it would be with the stress p; the other one is that
     *  with the stress at the end of the step. */
    struct OwnStrength
    {
      double cohesion = 0.; ///< more than that of the law (Pa)
      double part     = 0.; ///< lambda
      double normal = 0.; ///< p (Pa), as FrictionalSpatialLaw::normal_stress()
    };

    virtual OwnStrength
    own_strength(const SpatialMandel & /*stress_n*/,
                 const double * /*history_n*/,
                 const StepLaw & /*step*/) const
    {
      return {};
    }

    /** Changes the history of a point by a step. */
    virtual void
    remember(const SpatialMandel & /*stress*/,
             const StepLaw & /*step*/,
             double * /*history*/) const
    {}

    /** s at t_{n+1} from the trial stress s_n + D e. @param[out] tangent ds/de, or
     *  null */
    virtual Mode
    return_to_strength(const SpatialMandel &trial,
                       const OwnStrength   &own,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const = 0;

    Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepLaw       &step,
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
   * A spatial law with cohesion, friction and dilatancy. Friction may remember the stress
   * on which it depends (FrictionMemory), and the cohesion may grow with depth.
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

    /** Jaky's 1 - sin(phi). */
    double
    earth_pressure_at_rest() const override;

    std::optional<FlowCheck>
    check_flow(const PointStep &point, const StepLaw &step) const override;

  protected:
    /** The stress (Pa), positive in compression, on which strength depends. */
    virtual double
    normal_stress(const SpatialMandel &stress) const = 0;

    /** check_flow() by a plastic strain increment. */
    virtual FlowCheck
    check_plastic_strain(const SpatialMandel &plastic_strain,
                         const SpatialMandel &stress,
                         const OwnStrength   &own) const = 0;

    OwnStrength
    own_strength(const SpatialMandel &stress_n,
                 const double        *history_n,
                 const StepLaw       &step) const override;

    void
    remember(const SpatialMandel &stress,
             const StepLaw       &step,
             double              *history) const override;

    using Frictional::Frictional;

    /** Takes what the file gives, reduced by the factor F. */
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
