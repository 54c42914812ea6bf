// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interfaces_h
#define geocone_limit_analysis_interfaces_h

#include <geocone/mesh/triangles.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary edge on which the body slides: on an obstacle, or along a side that is
   * fixed in its normal direction and aligned with neither x nor y. The outside force r
   * per area and the velocity u of the body relative to the outside correspond to
   * stress and strain rate of a point: r = (s_n, s_t) is in a cone |s_t| <= a s_n + k,
   * with the associated rate e = -(u_N, u_T).
   */
  struct Interface
  {
    Triangles::HeldEdge    held;
    dealii::Tensor<1, dim> normal;        ///< into the body, unit length
    int                    obstacle = -1; ///< its index, or -1

    /**
     * Sets whose intersection contains r: Coulomb's cone, and r_N >= -t with the
     * tensile strength t if the cone extends beyond it; or |r_T| <= k alone, with free
     * r_N.
     */
    struct Face
    {
      double a, k; ///< k in (Pa)
      bool   has_normal, has_tangential;
    };
    std::vector<Face> faces;

    /** Whether both sets bound r_N. The body then opens by w against the second one
     *  alone, and (u_N - w, u_T) belongs to the first. */
    bool
    opens() const
    {
      return faces.size() == 2 && faces[0].has_normal && faces[1].has_normal;
    }
  };

  /** @throws InputError if an obstacle touches no edge or a part of one, or penetrates
   *  the body */
  std::vector<Interface>
  interfaces(const Scene &scene, const Triangles &triangles);

  /** Whether a normal is along x or y, where nodes are fixed without an interface. */
  bool
  is_along_axis(const dealii::Tensor<1, dim> &normal);
} // namespace geocone::GEOCONE_DIM

#endif
