// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_parameter_intervals_h
#define geocone_limit_analysis_parameter_intervals_h

#include <geocone/scene/scene.h>

#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Parameter of the parameter file that has the intervals, for messages. */
  const std::string interval_parameter = "Analysis/Parameter intervals";

  /** Interval of a strength, a unit weight or a traction. */
  struct ParameterInterval
  {
    enum class Kind
    {
      cohesion,
      friction_angle,
      tensile_strength,
      unit_weight,
      traction
    };

    std::string  name;  ///< as in the parameter file, e.g. "clay/Cohesion"
    Kind         kind;  ///< a density counts as unit weight
    unsigned int index; ///< of the material or traction

    /** Limits: Pa, degrees, or for loads multiples of the given ones. */
    std::array<double, 2> range = {{0., 0.}};

    double unit = 1.; ///< value in the parameter file of a load's multiple 1

    bool
    is_load() const
    {
      return kind == Kind::unit_weight || kind == Kind::traction;
    }
  };

  /** Reads intervals, "NAME/PARAMETER: LEAST .. LARGEST; ...". @throws InputError for
   *  intervals for which nothing is proven */
  std::vector<ParameterInterval>
  parameter_intervals(const std::string &text, const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
