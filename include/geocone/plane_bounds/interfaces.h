// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_interfaces_h
#define geocone_plane_bounds_interfaces_h

#include <geocone/mesh/triangles.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary edge along which the body can slide. The edge is in contact with an
   * obstacle, or on a side that is fixed in its normal direction and not parallel to x or
   * y. The traction r from outside and the velocity u of the body relative to the outside
   * correspond to stress and strain rate of a point: r = (s_n, s_t) is in a cone |s_t| <=
   * a s_n + k, with the associated rate e = -(u_N, u_T).
   */
  struct Interface
  {
    Triangles::HeldEdge    held;
    dealii::Tensor<1, dim> normal;        ///< into the body, unit length
    int                    obstacle = -1; ///< index; -1: oblique side

    /**
     * Face of the yield surface of an interface, i.e. one of its strength
     * conditions. The traction r is inside all faces. These are Coulomb's cone,
     * and r_N >= -t with the tensile strength t if the cone extends beyond it;
     * or |r_T| <= k alone, with free r_N.
     */
    struct Face
    {
      double a, k; ///< aperture (-), strength (Pa)
      bool   has_normal, has_tangential;
    };
    std::vector<Face> faces;

    /** Returns true if the yield surface of the interface has two faces and
     *  both of them limit the normal traction r_N. The interface then opens at
     *  a rate w associated with the second face, and the rate (u_N - w, u_T) is
     *  associated with the first. */
    bool
    opens() const
    {
      return faces.size() == 2 && faces[0].has_normal && faces[1].has_normal;
    }
  };

  /** Finds all interfaces of the body with obstacles and oblique fixed sides.
   *  @throws InputError if an obstacle touches no edge or only part of an edge, or
   *  penetrates the body */
  std::vector<Interface>
  interfaces(const Scene &scene, const Triangles &triangles);

  /** Returns true if a normal is parallel to x or y. Nodes on sides with such a normal
   *  are fixed without an interface. */
  bool
  is_along_axis(const dealii::Tensor<1, dim> &normal);
} // namespace geocone::GEOCONE_DIM

#endif
