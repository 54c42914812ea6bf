// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interfaces_h
#define geocone_limit_analysis_interfaces_h

#include <geocone/limit_analysis/triangles.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * An edge of the boundary on which the body slides: on an obstacle, or along a
   * side that is held normally and lies along neither x nor y. The force r of what
   * is outside, per area, and the velocity u of the body relative to it do what a
   * point of a body does with its stress and strain rate: r = (s_n, s_t) is in a
   * cone |s_t| <= a s_n + k, and the associated rate is e = -(u_N, u_T).
   */
  struct Interface
  {
    Triangles::HeldEdge    held;
    dealii::Tensor<1, dim> normal;        ///< into the body, unit length
    int                    obstacle = -1; ///< its number, or none

    /**
     * The sets in which r is, all of them: Coulomb's cone, r_N >= -t with the tensile
     * strength t where the cone goes farther; or only |r_T| <= k where r_N is free.
     */
    struct Face
    {
      double a, k; ///< k in (Pa)
      bool   has_normal, has_tangential;
    };
    std::vector<Face> faces;

    /** Whether both of them bound r_N: then the body opens by w against the second one
     *  alone, and (u_N - w, u_T) is the first one's. */
    bool
    opens() const
    {
      return faces.size() == 2 && faces[0].has_normal && faces[1].has_normal;
    }
  };

  /** @throws InputError if an obstacle touches no edge, or a part of one, or is in
   *  the body */
  std::vector<Interface>
  interfaces(const Scene &scene, const Triangles &triangles);

  /** Whether a normal is along x or y, where nodes are held without an interface. */
  bool
  is_along_axis(const dealii::Tensor<1, dim> &normal);
} // namespace geocone::GEOCONE_DIM

#endif
