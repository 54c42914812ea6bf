// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_subloading_constants_h
#define geocone_kernels_subloading_constants_h

namespace geocone
{
  /**
   * Material constants of the subloading soil model of Pereira et al. (2016).
   * Numbers such as "(21)" refer to equations of the report. Any consistent
   * unit of stress can be used; defaults are in Pa. Compression is positive
   * here.
   */
  struct SubloadingConstants
  {
    double kappa  = 0.01; ///< slope of swelling lines, ln v over ln p (-)
    double lambda = 0.08; ///< slope of compression lines, ln v over ln p (-)
    double nu     = 0.25; ///< Poisson ratio (-)
    double pe     = 0.;   ///< pressure offset, K = (p + pe)/kappa (26) (Pa)
    double xi     = 0.;   ///< tensile strength, apex at p = -xi pcb (21) (-)
    double M      = 1.2;  ///< slope of the yield ellipsoid (21) (-)
    double Mc     = 1.2;  ///< critical state slope q/p in compression (-)
    double k      = 1.;   ///< strength in extension / compression (-)
    double alpha  = 1.;   ///< slope of the plastic potential / M (28) (-)
    double cR     = 100.; ///< rate of the subloading ratio R (31) (-)
    double cbeta  = 0.;   ///< rate of rotational hardening (32) (-)
    double cb     = 0.;   ///< rate of loss of structure (36) (-)
    double Rbf    = 1.;   ///< residual structure ratio (36) (-)
    double ca     = 0.;   ///< rate of the similarity centre (38) (-)

    double patm  = 1e5;  ///< reference pressure of (32) (Pa)
    double Rmin  = 0.01; ///< elastic range, R below Rmin (31) (-)
    double delta = 0.01; ///< margin of the similarity centre (38) (-)

    /** True if the rotation of the surfaces uses sh = s - ph beta instead of sh
     *  = s - p beta, in equation (24) of Pereira et al. (2016)
     *  (SubloadingConstants). */
    bool rotates_with_ph = false;

    double tolerance        = 1e-4; ///< error tolerance per substep (STOL) (-)
    double smallest_substep = 1e-4; ///< fraction of the strain increment
    double lowest_pressure  = 1.;   ///< lower limit of p + pe (Pa)
    double smallest_size    = 1e3;  ///< lower limit of pcb (Pa)
  };

  /** Material constants of the subloading model, with derived constants. */
  struct DerivedSubloadingConstants : SubloadingConstants
  {
    DerivedSubloadingConstants() = default;
    explicit DerivedSubloadingConstants(const SubloadingConstants &c)
      : SubloadingConstants(c)
      , shear_ratio(3. * (1. - 2. * c.nu) / (2. * (1. + c.nu)))
      , slope(1.5 / (c.M * c.M))
      , phi_slope(slope / (c.alpha * c.alpha))
    {}

    double shear_ratio = 0.6; ///< G/K (25)
    double slope       = 0.;  ///< 3/(2 M^2)
    double phi_slope   = 0.;  ///< 3/(2 (alpha M)^2)
  };
} // namespace geocone

#endif
