// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_spatial_strength_h
#define geocone_bounds_spatial_strength_h

#include <geocone/base/types.h>
#include <geocone/scene/scene.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Strength of a material in a limit analysis in which all three principal stresses
   *  count (three-dimensional or axisymmetric), in scaled units. */
  struct SpatialStrength
  {
    /** True for the circular cone |s_t| <= a s_n + k, false for Mohr-Coulomb's yield
     *  condition (1 + a) s_1 - (1 - a) s_3 <= k. */
    bool   is_circular = false;
    double a = 0., k = 0.;

    /** Tensile strength T of the cut-off s_1 <= T, with Mohr-Coulomb's yield condition. */
    double tension = std::numeric_limits<double>::infinity();

    /** Increase of the strength k with depth (in scaled units, per m). */
    Material::StrengthGradient growth;

    bool is_associated = true; ///< equal angles of friction and dilatancy

    double
    k_at(const dealii::Point<dim> &x) const
    {
      return k + growth.at(x[1]);
    }

    /** Returns true if the tension cut-off is part of the strength: if it is below the
     *  apex of the pyramid. Reduced strengths have the same apex but a smaller T. */
    bool
    is_cut() const
    {
      return std::isfinite(tension) && 2. * a * tension < k;
    }

    /** Forms of the strength. */
    enum Form
    {
      pyramid,
      circle,
      cut_pyramid,
      n_forms
    };

    Form
    form() const
    {
      return is_circular ? circle : is_cut() ? cut_pyramid : pyramid;
    }

    /** Divides all stresses by a unit. */
    void
    scale(const double unit)
    {
      k /= unit;
      growth.slope /= unit;
      tension /= unit;
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
    utilisation(const double k, const Eigen::Matrix3d &stress) const;

    /** Dissipation of a strain rate or a velocity jump by the associated flow rule. */
    struct Flow
    {
      double dissipation = 0.;
      double miss        = 0.; ///< distance from admissible flow; <= 0 inside
      double constrained = 0.; ///< rate that must vanish
    };

    /** Returns the flow of a symmetric strain rate tensor. The dissipation is the largest
     *  power of admissible stresses, if the rate is admissible.
     *  @param k strength at the point */
    Flow
    flow(const double k, const Eigen::Matrix3d &rate) const;

    /** Returns the flow of a jump with components u_n along the normal and u_t along the
     *  face. @param c cohesion of the face, face_cohesion_per_k() times k */
    Flow
    flow_of_jump(const double c, const double u_n, const double u_t) const;
  };

  /** Returns the strength of each material (Pa).
   *  @throws InputError for a material whose loads cannot be bounded */
  std::vector<SpatialStrength>
  spatial_strengths(const Scene &scene);

  /** Checks that the strengths of all materials can be reduced.
   *  @throws InputError for a circular cone with friction */
  void
  check_reducible(const Scene                        &scene,
                  const std::vector<SpatialStrength> &strengths);

  /** Returns the strength k of a material at a place.
   *  @throws InputError if it is not positive */
  double
  positive_strength(const Scene                        &scene,
                    const std::vector<SpatialStrength> &strengths,
                    const unsigned int                  material,
                    const dealii::Point<dim>           &x);
} // namespace geocone::GEOCONE_DIM

#endif
