// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_frictional_strength_h
#define geocone_materials_frictional_strength_h

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>

namespace geocone
{
  /** Strength parameters of a constitutive law: cohesion, friction angle,
   *  dilatancy angle and tensile strength. */
  struct FrictionalStrength
  {
    double c     = 2000.; ///< cohesion (Pa)
    double phi   = 25.;   ///< friction angle (degrees)
    double theta = 25.;   ///< dilatancy angle (degrees)

    /** Tensile strength: upper limit of the in-plane principal stresses
     *  (Pa). */
    double tension = std::numeric_limits<double>::infinity();

    double gradient = 0.; ///< increase of cohesion with depth (Pa/m)
    double level    = 0.; ///< y at which the cohesion is c (m)

    /** Difference (Pa) between the cohesion at the coordinate y and the
     *  parameter 'Cohesion'. */
    double
    growth(const double y) const
    {
      return gradient * (level - y);
    }

    /** Strength parameters of undrained clay, with phi = theta = 0. */
    static FrictionalStrength
    without_friction()
    {
      FrictionalStrength clay;
      clay.phi = clay.theta = 0.;
      return clay;
    }

    /** Declares the parameters for cohesion, friction angle and dilatancy angle
     *  in the section of a law. */
    void
    declare(dealii::ParameterAcceptor &law);

    /** Declares only the cohesion parameter. */
    void
    declare_cohesion(dealii::ParameterAcceptor &law,
                     const std::string         &documentation);

    /** Declares the parameters for the variation of the cohesion with depth. */
    void
    declare_growth(dealii::ParameterAcceptor &law);

    /** Declares the parameter for the tensile strength. */
    void
    declare_tension(dealii::ParameterAcceptor &law);

    /** Parses the parameter for the tensile strength.
     *  @throws InputError @param section of the law */
    void
    prepare(const std::string &section);

    /** Strength parameters after strength reduction: c and tan(phi) are divided
     *  by F. For associated flow theta remains equal to phi; otherwise theta is
     *  unchanged but limited to the reduced phi. F = 1 returns the given values
     *  exactly. */
    FrictionalStrength
    reduced(const double F) const;

  private:
    std::string tension_text = "none";
  };
} // namespace geocone

#endif
