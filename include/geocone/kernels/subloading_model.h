// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_model_h
#define geocone_kernels_subloading_model_h

#include <geocone/kernels/subloading_constants.h>

#include <Eigen/Core>

namespace geocone
{
  /**
   * State variables of the subloading model at a material point. Vectors have n
   * components: xx, yy, zz, sqrt2 xy, for n = 6 also sqrt2 yz, sqrt2 zx, so
   * that scalar products are double contractions.
   */
  template <int n>
  struct SubloadingState
  {
    using Vector = Eigen::Matrix<double, n, 1>;

    Vector stress = Vector::Zero(); ///< sigma (Pa)
    Vector a      = Vector::Zero(); ///< similarity centre (Pa)
    Vector beta   = Vector::Zero(); ///< anisotropy, deviatoric (-)
    double pcb    = 0.;             ///< size of the structured surface (Pa)
    double Rb     = 1.;             ///< structure ratio (-)
  };

  /**
   * Plastic rates of the subloading model for a strain increment de. The rate
   * h_x of a state variable x is dx/dLambda; the plastic multiplier Lambda is
   * scaled by m = d gbar/d sy. Numbers in parentheses are equations of the
   * report (SubloadingConstants).
   */
  template <int n>
  struct SubloadingRates
  {
    using Vector = Eigen::Matrix<double, n, 1>;

    double K = 0., G = 0.;            ///< elastic moduli (25), (26) (Pa)
    double p_y = 0.;                  ///< p that multiplies beta in (24) (Pa)
    Vector sy, st;                    ///< sy of (20), tilde sy of (38) (Pa)
    Vector sh;                        ///< sh of (21) at sy (Pa)
    Vector N, m;                      ///< gradients of fbar and gbar at sy (Pa)
    double trace_m = 0., norm_m = 0.; ///< (Pa)
    double U     = 0.;                ///< U of (31) (-)
    double lode  = 1.;                ///< Willam and Warnke's h, Mcs = Mc h (-)
    double eta_b = 0.;                ///< eta_beta,cs (-)
    Vector h_a, h_beta;               ///< rates of (38), (32)
    double h_pc = 0., h_Rb = 0.;      ///< rates of (37), (36)
    double H              = 0.;       ///< plastic modulus H
    double N_D_m          = 0.;       ///< N:D:m
    double N_D_strain     = 0.;       ///< N:D:de
    double d_lambda       = 0.;       ///< N:D:de/(N:D:m + H), 0 if negative
    double stable         = 1.;       ///< 1 if N:D:m + H > 0, otherwise 0
    double plastic_strain = 0.;       ///< ||d eps_p|| for de (-)
    /** Increments of the state variables for the strain increment de. */
    SubloadingState<n> increment;

    static constexpr bool has_all = true; ///< rates() computes all members
  };

  /** Statistics of the integration over one strain increment. */
  struct SubloadingReport
  {
    unsigned int substeps       = 0;     ///< plastic substeps and elastic parts
    unsigned int forced         = 0;     ///< substeps above the tolerance
    bool         limited        = false; ///< limit of p or pcb reached
    double       plastic_strain = 0.;    ///< integral of ||d eps_p|| (-)
  };

  /**
   * Subloading model at a material point, with rotational hardening, structure
   * and non-associated flow. The similarity centre moves. Stresses have n = 4
   * (plane strain) or n = 6 components, compression positive. See
   * doc/theory/subloading.md.
   */
  template <int n>
  class SubloadingModel
  {
  public:
    using Vector = Eigen::Matrix<double, n, 1>;
    using State  = SubloadingState<n>;

    SubloadingModel() = default;
    explicit SubloadingModel(const SubloadingConstants &constants)
      : c(constants)
    {}

    const DerivedSubloadingConstants &
    constants() const
    {
      return c;
    }

    /**
     * Similarity ratio R of the subloading surface that passes through the
     * current stress. R is the positive root of fbar(a + (sigma - a)/R) = 0,
     * equations (20) and (21).
     */
    double
    ratio(const State &state) const;

    /** Yield function fbar(S; beta, pcb) of the subloading model (Pa^2),
     *  negative inside the yield surface; equation (21) of Pereira et al.
     *  (2016). */
    double
    yield_function(const Vector &S, const Vector &beta, const double pcb) const;

    /**
     * Size pc (Pa) of the yield surface with rotation tensor beta that passes
     * through a given stress. The size is not positive if no such surface
     * exists.
     */
    double
    size_through(const Vector &stress, const Vector &beta) const;

    /** Computes the plastic rates of the state variables for a strain increment
     *  at a given state and similarity ratio R. */
    SubloadingRates<n>
    rates(const State &state, const double R, const Vector &strain) const;

    /** Integrates the constitutive equations over a strain increment
     *  (compression positive) and updates the state. */
    SubloadingReport
    integrate(State &state, const Vector &strain) const;

    /** P-wave modulus K + 4G/3 at the pressure p (Pa). */
    double
    wave_modulus(const double p) const
    {
      return (1. + 4. / 3. * c.shear_ratio) * (p + c.pe) / c.kappa;
    }

    /** Ratio of shear to bulk modulus (-), G/K = 3(1-2nu)/(2(1+nu)); equation
     *  (25) of Pereira et al. (2016). */
    double
    g_over_k() const
    {
      return c.shear_ratio;
    }

  private:
    DerivedSubloadingConstants c;
  };

  extern template class SubloadingModel<4>;
  extern template class SubloadingModel<6>;
} // namespace geocone

#endif
