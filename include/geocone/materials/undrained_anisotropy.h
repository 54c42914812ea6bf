// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_undrained_anisotropy_h
#define geocone_materials_undrained_anisotropy_h

#include <geocone/base/constants.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/cone/strength_ellipse.h>
#include <geocone/materials/frictional_strength.h>

#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <string>

namespace geocone
{
  /**
   * Undrained strengths of clay by the direction of loading, as parts of the strength s_uA in
   * active compression, the cohesion: s_uP in passive compression, s_uD in direct simple shear.
   * The yield condition is that of NGI-ADP in plane strain at failure (Grimstad, Andresen and
   * Jostad 2012),
   *   ((s_xx - s_yy)/2 - (s_uA - s_uP)/2)^2 + (s_xy (s_uA + s_uP)/(2 s_uD))^2
   *     = ((s_uA + s_uP)/2)^2,
   * which is an ellipse (Davis and Christian 1971).
   */
  struct UndrainedAnisotropy
  {
    double passive      = 1.; ///< s_uP/s_uA (-)
    double simple_shear = 1.; ///< s_uD/s_uA (-)
    double angle        = 0.; ///< of the axis to the vertical (degrees)

    bool
    acts() const
    {
      return passive != 1. || simple_shear != 1.;
    }

    /** Declares the parameters in the section of a law. */
    void
    declare(dealii::ParameterAcceptor &law)
    {
      const std::string bounds =
        " Where it is not 1: phi = 0, 'Analysis/Kind' = limit load or strength "
        "reduction.";
      law.add_parameter("Passive strength ratio",
                        passive,
                        "Undrained strength in passive compression (largest "
                        "compressive stress horizontal) over that in active "
                        "compression, which is the cohesion [-], > 0." +
                          bounds);
      law.add_parameter("Simple shear strength ratio",
                        simple_shear,
                        "Undrained strength in direct simple shear along the "
                        "horizontal over that in active compression [-], > 0." +
                          bounds);
      law.add_parameter("Anisotropy angle",
                        angle,
                        "Angle by which the axes of the strength ratios are "
                        "turned, counterclockwise [degrees].");
    }

    /** Checks the parameters. @throws InputError
     *  @param section of the law @param given its other strengths */
    void
    prepare(const std::string &section, const FrictionalStrength &given) const
    {
      for (const auto &[name, value] :
           {std::pair<const char *, double>("Passive strength ratio", passive),
            {"Simple shear strength ratio", simple_shear}})
        {
          const std::string parameter = section + "/" + name;
          if (!(value > 0. && std::isfinite(value)))
            throw InputError(parameter,
                             value,
                             "> 0",
                             "clays have 0.3 to 1; 1 is the strength in active "
                             "compression");
          if (value == 1.)
            continue;
          if (given.phi > 0.)
            throw InputError(parameter,
                             value,
                             "1 where phi > 0",
                             "strengths by direction are undrained ones: set "
                             "the friction angle to 0, or leave it out");
          if (std::isfinite(given.tension))
            throw InputError(parameter,
                             value,
                             "1 beside a 'Tensile strength'",
                             "leave one of them out");
          const std::string kind = ParameterFile::value("Analysis/Kind");
          if (kind != "limit load" && kind != "strength reduction")
            throw InputError(parameter,
                             value,
                             "1 with " + (kind.empty() ? "steps" : kind),
                             "strengths by direction are those of "
                             "'Analysis/Kind' = limit load or strength "
                             "reduction: take a mean strength here");
        }
      if (!std::isfinite(angle))
        throw InputError(section + "/Anisotropy angle",
                         angle,
                         "a finite angle in degrees",
                         "0: active compression is vertical");
    }

    StrengthEllipse
    ellipse() const
    {
      if (!acts())
        return {};
      const double twice = 2. * radians(angle);
      return {(1. + passive) / 2.,
              simple_shear,
              (1. - passive) / 2.,
              std::cos(twice),
              std::sin(twice)};
    }
  };
} // namespace geocone

#endif
