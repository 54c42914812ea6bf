// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/laws/hardening_mohr_coulomb.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    constexpr const char *curve_parameter[] = {"Cohesion with strain",
                                               "Friction angle with strain",
                                               "Dilatancy angle with strain"};
  } // namespace

  HardeningMohrCoulomb::HardeningMohrCoulomb(const std::string &section)
    : MohrCoulomb(section)
  {
    const std::string forms =
      " as a function of the plastic shear strain gamma_p: constant; 'strain: "
      "value, strain: value, ...', linear from the initial value at strain 0 "
      "through these values and constant beyond the last; or 'exponential "
      "VALUE, STRAIN', which approaches VALUE as exp(-gamma_p/STRAIN).";
    add_parameter("Hardening modulus",
                  modulus,
                  "Hardening modulus H [Pa], >= 0: the cohesion is c + H "
                  "gamma_p with the plastic shear strain gamma_p.");
    add_parameter(curve_parameter[0], cohesion_text, "Cohesion [Pa]" + forms);
    add_parameter(
      curve_parameter[1], friction_text, "Friction angle [degrees]" + forms);
    add_parameter(
      curve_parameter[2], dilatancy_text, "Dilatancy angle [degrees]" + forms);
    add_parameter(
      "Softening length",
      length,
      "Thickness of the physical shear band [m] to which the strains of these "
      "curves refer; > 0 if strength decreases. Strains in the mesh, where a "
      "shear band is one row of cells wide, are scaled to the same slip. 0: "
      "strains of the mesh, only if strength does not decrease.");
  }

  void
  HardeningMohrCoulomb::check_curves() const
  {
    if (!(cohesion_curve.range().first >= 0.))
      throw InputError(parameter(curve_parameter[0]),
                       cohesion_text,
                       "values >= 0 Pa",
                       "give a cohesion that is not negative");
    if (!(friction_curve.range().first >= 0. &&
          friction_curve.range().second < 90.))
      throw InputError(parameter(curve_parameter[1]),
                       friction_text,
                       "0 <= phi < 90 degrees",
                       "give the angle in degrees; soils have 0 to 45");
    for (const double kappa : places())
      {
        const double phi   = friction_curve(kappa),
                     theta = dilatancy_curve(kappa);
        if (!(theta >= 0. && theta <= phi * (1. + 1e-12)))
          throw InputError(
            parameter(curve_parameter[2]),
            dilatancy_text,
            format("0 <= theta <= phi, which is %g degrees at the "
                   "strain %g",
                   phi,
                   kappa),
            "let the dilatancy fall at least as early as the "
            "friction; more of it would create energy");
        if (!(phi > 0. || cohesion_at(kappa) > 0.))
          throw InputError(
            parameter(curve_parameter[0]),
            cohesion_text,
            format("> 0 Pa at the strain %g, where phi = 0", kappa),
            "a material without cohesion and friction has no "
            "strength at all: leave it a little");
      }
  }

  void
  HardeningMohrCoulomb::prepare()
  {
    MohrCoulomb::prepare();
    if (cohesion_grows())
      {
        const std::string growth =
          parameter(strength_formula().empty() ? "Cohesion gradient"
                                               : strength_formula());
        throw InputError(growth,
                         ParameterFile::value(growth),
                         "none for a law that hardens",
                         "take Mohr-Coulomb, or layers of several materials");
      }
    if (!(modulus >= 0.))
      throw InputError(
        parameter("Hardening modulus"),
        modulus,
        "H >= 0 Pa",
        "0 is perfect plasticity; for softening give 'Cohesion with "
        "strain' and a 'Softening length'");
    slope = 2. * modulus * std::cos(radians(friction_angle()));

    cohesion_curve.read(
      parameter(curve_parameter[0]), cohesion_text, cohesion());
    friction_curve.read(
      parameter(curve_parameter[1]), friction_text, friction_angle());
    dilatancy_curve.read(
      parameter(curve_parameter[2]), dilatancy_text, dilatancy_angle());
    has_curves =
      !(cohesion_curve.is_constant() && friction_curve.is_constant() &&
        dilatancy_curve.is_constant());
    if (has_curves && modulus > 0.)
      throw InputError(
        parameter("Hardening modulus"),
        modulus,
        "0 beside curves",
        "write it as a curve, e.g. 'Cohesion with strain' = 1: c + "
        "H");
    check_curves();

    if (!(length >= 0.))
      throw InputError(parameter("Softening length"),
                       length,
                       "L > 0 m, or 0",
                       "shear bands in sand are 10 to 20 grains thick");
    softens =
      cohesion_curve.least_slope() < 0. || friction_curve.least_slope() < 0.;
    if (softens && length == 0.)
      throw InputError(
        parameter("Softening length"),
        length,
        "> 0 m where the strength falls",
        "give the thickness of the shear band to which the strains of "
        "the curves belong: without it the result would depend on the "
        "cells");
  }

  std::vector<double>
  HardeningMohrCoulomb::places() const
  {
    std::vector<double> all;
    for (const StrainCurve *curve :
         {&cohesion_curve, &friction_curve, &dilatancy_curve})
      for (const double place : curve->places())
        all.push_back(place);
    return all;
  }

  double
  HardeningMohrCoulomb::cohesion_at(const double kappa) const
  {
    return cohesion_curve(kappa) + modulus * kappa;
  }

  FlowCone
  HardeningMohrCoulomb::cone_at(const double kappa) const
  {
    return cone_of(
      cohesion_at(kappa), friction_curve(kappa), dilatancy_curve(kappa));
  }

  std::string
  HardeningMohrCoulomb::initialise(const Stress &stress,
                                   const double  size,
                                   double       *history) const
  {
    history[plastic_shear()] = 0.;
    if (length > 0.)
      {
        const double G       = elasticity().two_G / 2.;
        const double steep   = -cohesion_curve.least_slope();
        const double largest = steep > 0. ? length * G / steep : 0.;
        if (steep > 0. && size > 0.9 * largest)
          throw InputError(
            parameter("Softening length"),
            length,
            format(
              "cells below %g m, for a cell of %g m is unloaded by more than "
              "its band can take",
              0.9 * largest,
              size),
            "take smaller cells, or curves that fall less steeply");
        history[plastic_shear() + 1] = size > 0. ? size / length : 1.;
      }
    return MohrCoulomb::initialise(stress, size, history);
  }

  std::vector<ConstitutiveLaw::OutputQuantity>
  HardeningMohrCoulomb::output_quantities() const
  {
    std::vector<OutputQuantity> all = MohrCoulomb::output_quantities();
    all.push_back({"cohesion", "cohesion (Pa)"});
    if (!friction_curve.is_constant())
      all.push_back({"friction_angle", "friction angle (degrees)"});
    return all;
  }

  void
  HardeningMohrCoulomb::output(const Components &stress,
                               const double     *history,
                               double           *values) const
  {
    MohrCoulomb::output(stress, history, values);
    const unsigned int first = MohrCoulomb::output_quantities().size();
    const double       kappa = history[plastic_shear()];
    values[first]            = cohesion_at(kappa);
    if (!friction_curve.is_constant())
      values[first + 1] = friction_curve(kappa);
  }

  std::optional<FlowCone>
  HardeningMohrCoulomb::flow_cone(const double *history) const
  {
    FlowCone cone  = cone_at(history[plastic_shear()]);
    cone.hardening = slope;
    return cone;
  }

  std::optional<FlowCone>
  HardeningMohrCoulomb::exact_end_cone(const double *history_n,
                                       const double  slip) const
  {
    return has_curves ? cone_at(sheared(history_n, slip))
                      : MohrCoulomb::exact_end_cone(history_n, slip);
  }

  std::optional<FlowCone>
  HardeningMohrCoulomb::end_cone(const Mandel   &stress_n,
                                 const double   *history_n,
                                 const StepData &step,
                                 const double    slip) const
  {
    return has_curves
             ? with_memory(
                 cone_at(sheared(history_n, slip)), stress_n, history_n, step)
             : MohrCoulomb::end_cone(stress_n, history_n, step, slip);
  }

  double
  HardeningMohrCoulomb::non_associativity() const
  {
    double most = 0.;
    for (const double kappa : places())
      if (const FlowCone cone = cone_at(kappa); cone.a > 0.)
        most = std::max(most, (cone.a - cone.b) / cone.a);
    return most;
  }

  void
  HardeningMohrCoulomb::set_friction_memory(const double tau)
  {
    // A delayed strength has fallen before it is reached: peak loads would be too
    // low (footing_softening.prm: by 4.5 %).
    if (!softens)
      MohrCoulomb::set_friction_memory(tau);
  }

  bool
  HardeningMohrCoulomb::has_symmetric_tangent() const
  {
    return MohrCoulomb::has_symmetric_tangent() && !softens &&
           (!hardens() || friction_curve.range().second == 0.);
  }

  void
  HardeningMohrCoulomb::add_to_history(const double slip, double *history) const
  {
    history[plastic_shear()] = sheared(history, slip);
  }
} // namespace geocone::GEOCONE_DIM
