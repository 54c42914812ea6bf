// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_hardening_mohr_coulomb_h
#define geocone_laws_hardening_mohr_coulomb_h

#include <geocone/laws/mohr_coulomb.h>
#include <geocone/laws/strain_curve.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Plane-strain Mohr-Coulomb law with hardening or softening. The strength
   * parameters depend on the plastic shear strain kappa, the integral of |e_1 -
   * e_2| = sqrt2 |z_t| over the plastic strain increments in the plane (-), a
   * history variable:
   *   c(kappa), phi(kappa), theta(kappa),
   * either c = c_0 + H kappa, with a closed-form return mapping (in cone axes k
   * = k_n + h |z_t| with h = 2 H cos(phi)), or one StrainCurve per parameter,
   * with one scalar equation per step (return_map_varying()). The apex of the
   * cone moves with the parameters; plastic opening at the apex does not change
   * them. The energy stored by hardening counts as dissipation.
   *
   * Softening without an internal length localises in one row of cells.
   * Softening curves therefore refer to a shear band of the thickness L,
   * Softening length, and a point in a cell of the size l has
   *   d kappa = sqrt2 |dz_t| l/L,
   * so that a band of one cell has the same slip and dissipation on all meshes
   * (Bazant and Oh 1983); l/L is the last history variable. Cells that are too
   * large would have to soften faster than they unload elastically: l
   * |dc/dkappa| cos(phi) < L G.
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

    std::vector<OutputQuantity>
    output_quantities() const override;

    void
    output(const Components &stress,
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
    end_cone(const Mandel   &stress_n,
             const double   *history_n,
             const StepData &step,
             const double    slip) const override;

    std::optional<FlowCone>
    exact_end_cone(const double *history_n, const double slip) const override;

    /** Maximum degree of non-associativity along the hardening curves, see
     *  Material::non_associativity(). */
    double
    non_associativity() const override;

    /** Sets the relaxation time tau (s) of friction with memory, see
     *  Material::set_friction_memory(). Without effect if the strength
     *  decreases. */
    void
    set_friction_memory(const double tau) override;

    /** Returns true if the tangent stiffness is symmetric. False for hardening
     *  with friction, where the apex of the cone depends on shear but not on
     *  opening, and for softening, where the tangent is not positive
     *  definite. */
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
    /** Index of the plastic shear strain kappa among the history variables. The
     *  next history variable is l/L. */
    unsigned int
    plastic_shear() const
    {
      return MohrCoulomb::n_history();
    }

    /** Plastic shear strain kappa at the end of a step (-). */
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

    /** Checks the strength parameters along the hardening curves.
     *  @throws InputError if a value is not admissible */
    void
    check_curves() const;

    /** Plastic shear strains (-) at which the strength parameters are checked:
     *  those of all points of the hardening curves. */
    std::vector<double>
    places() const;

    std::string cohesion_text = "constant", friction_text = "constant",
                dilatancy_text = "constant";
    StrainCurve cohesion_curve, friction_curve, dilatancy_curve;
    bool        has_curves = false; ///< whether any curve varies
    bool        softens    = false;
    double      modulus    = 0.;
    double      slope      = 0.; ///< h = dk/d|z_t| (Pa)
    double      length     = 0.; ///< softening length L (m)
  };
} // namespace geocone::GEOCONE_DIM

#endif
