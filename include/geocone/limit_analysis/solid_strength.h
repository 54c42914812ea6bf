// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_strength_h
#define geocone_limit_analysis_solid_strength_h

#include <geocone/materials/material.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  /** Dissipation of a strain rate or a velocity jump by the associated flow rule. */
  struct SolidFlow
  {
    double dissipation = 0.;
    double miss        = 0.; ///< distance from admissible flow; <= 0 inside
    double constrained = 0.; ///< rate that must vanish
  };

  /** Strength of a material in three-dimensional limit analysis, in scaled units. */
  struct SolidStrength
  {
    /** True for the circular cone |s_t| <= a s_n + k, false for Mohr-Coulomb's yield
     *  condition (1 + a) s_1 - (1 - a) s_3 <= k. */
    bool   is_circular = false;
    double a = 0., k = 0.;

    /** Tensile strength T of the cut-off s_1 <= T, with Mohr-Coulomb's yield condition. */
    double tension = std::numeric_limits<double>::infinity();

    /** Increase of the strength k with depth (in scaled units, per m). */
    Material::StrengthGradient growth;

    double
    k_at(const dealii::Point<dim> &x) const
    {
      return k + growth.at(x[1]);
    }

    /** Returns true if a tension cut-off below the apex of the pyramid is part of the
     *  strength. */
    bool
    is_cut() const
    {
      return std::isfinite(tension) && 2. * a * tension < k;
    }

    /** Reduces the strength of a material: divides c, tan(phi) and T, or k of a
     *  circular cone without friction, by F. */
    void
    reduce(const double F);

    /** Coulomb strength |s_t| <= c - mu s_n of a face across which the velocity
     *  jumps. Its dissipation is that of the material
     *  (doc/theory/limit_analysis.md). */
    double
    face_friction() const;
    double
    face_cohesion_per_k() const;

    /** Returns the ratio of a stress to the strength: the stress is admissible if the
     *  ratio is at most 1. Rounding of eigenvalues is on the safe side.
     *  @param k strength at the point */
    double
    utilisation(const double k, const Mandel &s) const;

    /** Returns the flow of a symmetric strain rate tensor e. The dissipation is the largest
     *  power s.e of admissible stresses, if e is admissible. */
    SolidFlow
    flow(const double k, const Eigen::Matrix3d &e) const;

    /** Returns the flow of a jump with components u_n along the normal and u_t along the
     *  face. @param c cohesion of the face, face_cohesion_per_k() times k */
    SolidFlow
    flow_of_jump(const double c, const double u_n, const double u_t) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
