// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_hardening_mohr_coulomb_h
#define geocone_materials_hardening_mohr_coulomb_h

#include <geocone/materials/mohr_coulomb.h>

namespace geocone
{
  /**
   * MohrCoulomb with linear isotropic hardening of the cohesion,
   *   c = c_0 + H gamma_p,
   * where gamma_p, the last history variable, is the plastic shear strain, the
   * integral of |e_1 - e_2| = sqrt2 |z_t| over the plastic strain increments in
   * the plane (-). In cone axes k = k_n + h |z_t| with h = 2 H cos(phi): the
   * return map has it in closed form. H = 0 is perfect plasticity. The tip of the
   * cone moves with the cohesion; opening there does not harden. The work that
   * hardening stores counts as dissipated.
   */
  class HardeningMohrCoulomb : public MohrCoulomb
  {
  public:
    explicit HardeningMohrCoulomb(const std::string &section);

    void
    prepare() override;

    unsigned int
    n_history() const override
    {
      return MohrCoulomb::n_history() + 1;
    }

    std::string
    initialise(const Stress &stress, double *history) const override;

    std::vector<Shown>
    shown() const override;

    void
    show(const std::array<double, 3> &in_plane,
         const double                *history,
         double                      *values) const override;

    std::optional<FlowCone>
    flow_cone(const double *history) const override;

    /** Not at the tip of a cone, which shear moves and tension does not. */
    bool
    has_symmetric_tangent() const override;

  protected:
    void
    add_to_history(const double slip, double *history) const override;

  private:
    /** Place of gamma_p in the history. */
    unsigned int
    plastic_shear() const
    {
      return MohrCoulomb::n_history();
    }

    double modulus = 0.;
    double slope   = 0.; ///< h = dk/d|z_t| (Pa)
  };
} // namespace geocone

#endif
