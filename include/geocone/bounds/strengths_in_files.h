// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_strengths_in_files_h
#define geocone_bounds_strengths_in_files_h

#include <geocone/base/constants.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/folder/json.h>

#include <cmath>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Materials of the file of a certificate with their given strengths: cohesion c +
   *  gradient (level - y) and friction angle, or the strength k and the slope a of a
   *  circular cone |s_t| <= a s_n + k.
   *  @param unit of stress (Pa) */
  inline Json
  materials_with_strengths(const Scene                        &scene,
                           const std::vector<SpatialStrength> &strengths,
                           const double                        unit)
  {
    Json materials = Json::array();
    for (unsigned int m = 0; m < strengths.size(); ++m)
      {
        const SpatialStrength &one = strengths[m];
        Json                   law = {{"name", scene.materials.name(m)},
                                      {"is_circular", one.is_circular},
                                      {"is_reduced", scene.materials[m].is_reduced()}};
        if (one.is_circular)
          {
            law["slope"]    = one.a;
            law["strength"] = one.k * unit;
          }
        else
          {
            const double of_k = unit / (2. * std::sqrt(1. - one.a * one.a));
            law["cohesion"]   = one.k * of_k;
            law["cohesion_gradient"] = one.growth.slope * of_k;
            law["cohesion_level"]    = one.growth.level;
            law["friction_angle"]    = std::asin(one.a) * 180. / pi;
            law["tensile_strength"]  = finite_or_null(one.tension * unit);
          }
        materials.push_back(law);
      }
    return materials;
  }
} // namespace geocone::GEOCONE_DIM

#endif
