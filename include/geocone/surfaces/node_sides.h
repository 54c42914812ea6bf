// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_node_sides_h
#define geocone_surfaces_node_sides_h

#include <geocone/space/space.h>
#include <geocone/surfaces/face_points.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary faces of a body at its nodes: for each face the integral of N_i
   * (m, m^2) and the outward normal. A node at the end of a face in contact
   * represents half a cell there, regardless of the other faces that meet at
   * it.
   */
  class NodeSides
  {
  public:
    explicit NodeSides(const Space &space);

    /** Adds a face of the boundary. @param points all of its quadrature
     *  points */
    void
    add(const std::vector<FacePoint> &points);

    /** Completes the data: owned nodes receive those of other ranks.
     *  Collective. */
    void
    exchange();

    /**
     * Integral of N_i over the faces opposite an obstacle: those whose normals
     * are most nearly opposite to its normal, and others that are almost as
     * close (two for a corner that stands on its tip).
     * @param node an owned one
     * @param normal out of the obstacle
     */
    double
    facing(const unsigned int node, const dealii::Tensor<1, dim> &normal) const;

  private:
    struct Side
    {
      dealii::Tensor<1, dim> normal; ///< outward
      double                 integral;
    };

    const Space                   &space;
    std::vector<std::vector<Side>> sides; ///< by local node
  };
} // namespace geocone::GEOCONE_DIM

#endif
