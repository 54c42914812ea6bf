// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_mohr_coulomb_h
#define geocone_materials_mohr_coulomb_h

#include <geocone/materials/material.h>

namespace geocone
{
  /**
   * Perfectly plastic Mohr-Coulomb law in plane strain, the in-plane cone of
   * Guillet et al. 2025 (appendix A):
   *   |s_t| <= sin(phi) s_n + sqrt2 c cos(phi),  flow aperture sin(theta),
   * with friction angle phi, dilatancy angle theta <= phi and cohesion c.
   * phi = 0 is Tresca's cylinder, |s_t| <= sqrt2 c. Yielding is governed by the
   * in-plane stresses: the out-of-plane stress is assumed intermediate.
   * theta = phi is associated flow, theta = 0 flow without dilatancy.
   */
  class MohrCoulomb : public Material
  {
  public:
    explicit MohrCoulomb(const std::string &section);

    void
    prepare() override;

    void
    update(const Increment &increment, const Response &response) const override;

    std::optional<FlowCone>
    flow_cone(const double *) const override
    {
      return cone;
    }

    double
    cohesion() const
    {
      return c;
    }

    /** Friction angle (degrees). */
    double
    friction_angle() const
    {
      return phi;
    }

  protected:
    /** The history after a step, for laws that harden.
     *  @param slip |z_t| of the step (-) */
    virtual void
    add_to_history(const double /*slip*/, double * /*history*/) const
    {}

    /** For laws that fix phi = theta = 0 and do not declare the angles. */
    struct WithoutFriction
    {};
    MohrCoulomb(const std::string &section, const WithoutFriction &);

  private:
    double   c     = 2000.;
    double   phi   = 25.;
    double   theta = 25.;
    FlowCone cone;
  };

  /** Tresca's law |s1 - s2| <= 2c: MohrCoulomb with phi = theta = 0. */
  class Tresca : public MohrCoulomb
  {
  public:
    explicit Tresca(const std::string &section)
      : MohrCoulomb(section, WithoutFriction())
    {}
  };
} // namespace geocone

#endif
