// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_modified_cam_clay_h
#define geocone_laws_modified_cam_clay_h

#include <geocone/base/choice.h>
#include <geocone/base/units.h>
#include <geocone/laws/spatial_law.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Modified Cam-Clay law (Roscoe and Burland 1968), available for all
   * numerical methods. With P = p + a and Pc = pc + a, p the mean pressure and
   * a the attraction, the yield surface, with associated flow, is the ellipse
   *   f = q^2/M^2 + P (P - Pc) = 0,  q = sqrt(3/2) |dev s|,
   * elasticity has the bulk modulus K = P/kappa and a constant Poisson ratio,
   * and Pc increases with the compressive plastic volumetric strain w: dPc = Pc
   * dw/(lambda - kappa). kappa and lambda are slopes of ln v over ln p, so that
   *   P = P_n exp(de/kappa),  Pc = Pc_n exp(dw/(lambda - kappa))
   * are exact for any elastic volume strain de and any dw. Shear is integrated
   * with the secant modulus of the step, G = g (P - P_n)/de (Borja 1991), which
   * is exact for a fixed direction of the elastic strain. The flow direction is
   * evaluated at the end of the step (backward Euler); isotropic compression is
   * exact in one step.
   *
   * On the yield surface P = Pc cos^2(phi/2) and q = M Pc sin(phi)/2. An angle
   * phi determines dw in closed form, and the step is one equation in phi that
   * changes sign between two known bounds: it has a root for each strain
   * increment, which is found by Newton's method with bisection. The tangent is
   * exact for this root. It is not symmetric, because the shear modulus depends
   * on the pressure.
   *
   * Soil in tension retains P = 1 Pa at any opening strain, and a yield surface
   * that contains its stress (mode apex); it carries load as soon as the strain
   * reverses.
   *
   * The history variables are those of Material, then pc (Pa).
   */
  class ModifiedCamClay : public SpatialLaw
  {
  public:
    explicit ModifiedCamClay(const std::string &section);

    void
    prepare() override;

    /** Earth pressure coefficient at rest by Jaky's formula 1 - sin(phi), with
     *  sin(phi) = 3 M/(6 + M) in triaxial compression. */
    double
    earth_pressure_at_rest() const override
    {
      return 1. - 3. * M / (6. + M);
    }

    std::vector<YieldCurve>
    yield_curves(const Components   &stress,
                 const double       *history,
                 const SectionPlane &plane) const override;

    double
    wave_modulus(const Stress &stress, const double *history) const override;

    unsigned int
    n_history() const override
    {
      return SpatialLaw::n_history() + 1;
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override;

    std::vector<OutputQuantity>
    output_quantities() const override;

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override;

    std::optional<double>
    overstress(const Mandel &stress, const double *history) const override;

    /** Rejects strength reduction. @throws InputError always: M and pc are not
     *  cohesion and friction angle */
    void
    reduce_strength(const double F) override;

    bool
    has_symmetric_tangent() const override
    {
      return false;
    }

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double        *history) const override;

    /** Elastic energy density (J/m^3) of isotropic compression followed by
     *  shear at constant pressure: kappa (p - a ln(1 + p/a)) + q^2/(6G). An
     *  exact elastic energy does not exist for constant nu. */
    double
    elastic_energy(const Mandel &stress, const double *history) const override;

    /** @name Parameters of the yield surface: M (-), a and pc (Pa) */
    /** @{ */
    double
    critical_slope() const
    {
      return M;
    }
    double
    attraction() const
    {
      return a;
    }
    double
    preconsolidation(const double *history) const
    {
      return history[index_of_pc()];
    }
    /** @} */

    Elasticity
    elasticity_at(const Mandel &stress, const double *history) const override;

    bool
    has_constant_stiffness() const override
    {
      return false;
    }

  protected:
    Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepData      &step,
            SpatialMandel       &stress,
            double              *history,
            SpatialMandelMatrix *tangent) const override;

  private:
    /** Trial state at the end of a step for a given angle phi on the yield
     *  ellipse. */
    struct Trial;

    /** Pressure and tangent moduli after an elastic volumetric strain increment
     *  x from the pressure P_n, compression positive. */
    struct Elastic
    {
      double P;     ///< P_n exp(x/kappa) (Pa)
      double G;     ///< secant shear modulus (Pa)
      double slope; ///< dG/dx (Pa)
    };
    Elastic
    elastic(const double P_n, const double x) const;

    /** Elastic tangent moduli at the pressure P (Pa). */
    Elasticity
    elasticity_of(const double P) const
    {
      return {3. * P / kappa * (1. - 2. * poisson()), poisson()};
    }

    /** Mean pressure plus attraction, P = p + a, of a stress tensor (Pa). */
    double
    pressure(const SpatialMandel &stress) const
    {
      return a - trace(stress) / 3.;
    }

    /** Size Pc = P + q^2/(M^2 P) of the yield ellipse through a stress with
     *  pressure P and deviatoric stress q (Pa). */
    double
    size_through(const SpatialMandel &stress) const;

    unsigned int
    index_of_pc() const
    {
      return SpatialLaw::n_history();
    }

    /** Lower limit of the pressure P: 1 Pa, converted to the selected system of
     *  units. */
    static double
    lowest()
    {
      return 1. / mass_unit();
    }

    double kappa    = 0.01;
    double lambda   = 0.08;
    double M        = 1.2;
    double a        = 0.; ///< attraction (Pa)
    double ratio    = 1.; ///< initial overconsolidation ratio (-)
    double given_pc = 0.; ///< initial pc if given (Pa)
    double g_over_k = 0.; ///< G/K (-)

    enum class Outside
    {
      refuse,
      raise_size
    };
    Choice<Outside> if_outside = {
      {{"refuse", Outside::refuse}, {"raise size", Outside::raise_size}}};
  };
} // namespace geocone::GEOCONE_DIM

#endif
