// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_hardening_mohr_coulomb_h
#define geocone_materials_hardening_mohr_coulomb_h

#include <geocone/materials/mohr_coulomb.h>
#include <geocone/materials/strain_curve.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * MohrCoulomb whose parameters change with the plastic shear strain kappa, the
   * integral of |e_1 - e_2| = sqrt2 |z_t| over the plastic strain increments in the
   * plane (-), which is a history variable:
   *   c(kappa), phi(kappa), theta(kappa),
   * either c = c_0 + H kappa, which the return map has in closed form (in cone axes k =
   * k_n + h |z_t| with h = 2 H cos(phi)), or by a StrainCurve each, whose step is one
   * scalar equation (return_map_varying()). The tip of the cone moves with
   * them; opening there does not change them. The work that hardening stores counts as
   * dissipated.
   *
   * Softening has no size of its own: all of it goes into one row of cells. Curves that
   * fall therefore belong to a shear band of the thickness L, Softening length, and a
   * point in a cell of the size l has
   *   d kappa = sqrt2 |dz_t| l/L,
   * so that a band of one cell takes the same slip and energy on all meshes (Bazant and
   * Oh 1983); l/L is the last history variable. Cells that are too large would have to
   * soften faster than they are unloaded elastically: l |dc/dkappa| cos(phi) < L G.
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
      return MohrCoulomb::n_history() + 1 + (length > 0.);
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override;

    double
    size(const double *history) const override
    {
      return length > 0. ? length * history[plastic_shear() + 1] : 0.;
    }

    std::vector<Shown>
    shown() const override;

    void
    show(const Components &stress,
         const double     *history,
         double           *values) const override;

    bool
    hardens() const override
    {
      return has_curves || slope != 0.;
    }

    std::optional<FlowCone>
    flow_cone(const double *history) const override;

    std::optional<FlowCone>
    end_cone(const Mandel  &stress_n,
             const double  *history_n,
             const StepLaw &step,
             const double   slip) const override;

    std::optional<FlowCone>
    exact_end_cone(const double *history_n, const double slip) const override;

    /** That of the curves where it is largest. */
    double
    non_associativity() const override;

    /** Not at the tip of a cone, which shear moves and tension does not; nor where soil
     *  softens, as its tangent is not positive definite. */
    bool
    has_symmetric_tangent() const override;

  protected:
    bool
    varies() const override
    {
      return has_curves;
    }

    void
    add_to_history(const double slip, double *history) const override;

  private:
    /** Place of kappa in the history; l/L is the next. */
    unsigned int
    plastic_shear() const
    {
      return MohrCoulomb::n_history();
    }

    /** kappa after a step. */
    double
    sheared(const double *history_n, const double slip) const
    {
      return history_n[plastic_shear()] +
             sqrt2 * slip * (length > 0. ? history_n[plastic_shear() + 1] : 1.);
    }

    FlowCone
    cone_at(const double kappa) const;

    double
    cohesion_at(const double kappa) const;

    /** @throws InputError where the strength, as it changes, is none of a soil */
    void
    check_curves() const;

    /** Strains at which the parameters are checked: all that are given. */
    std::vector<double>
    places() const;

    std::string cohesion_text = "constant", friction_text = "constant",
                dilatancy_text = "constant";
    StrainCurve cohesion_curve, friction_curve, dilatancy_curve;
    bool        has_curves = false; ///< whether one of them is no constant
    bool        softens    = false;
    double      modulus    = 0.;
    double      slope      = 0.; ///< h = dk/d|z_t| (Pa)
    double      length     = 0.; ///< L (m)
  };
} // namespace geocone::GEOCONE_DIM

#endif
