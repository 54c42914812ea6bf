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
   * Boundary faces of a body, listed for each node. For each face at node i,
   * the integral of N_i (m, m^2) and the outward normal are stored. Tributary
   * areas thus include only faces in contact: a node at the end of such a face
   * represents half a cell, regardless of the other faces at the node.
   */
  class NodeSides
  {
  public:
    explicit NodeSides(const Space &space);

    /** Appends a boundary face of the body. @param points all quadrature points
     *  of the face */
    void
    add(const std::vector<FacePoint> &points);

    /** Exchanges boundary faces between ranks. Then owned nodes have the faces
     *  of all ranks. Collective. */
    void
    exchange();

    /**
     * Returns the integral of the shape function N_i over those boundary faces
     * at node i that are oriented towards an obstacle. These are the face whose
     * normal is most nearly opposite to the normal of the obstacle, and faces
     * with almost the same deviation (two faces for a corner that points at the
     * obstacle).
     * @param node an owned node
     * @param normal outward normal of the obstacle
     */
    double
    facing(const unsigned int node, const dealii::Tensor<1, dim> &normal) const;

  private:
    struct Side
    {
      dealii::Tensor<1, dim> normal; ///< outward normal
      double                 integral;
    };

    const Space                   &space;
    std::vector<std::vector<Side>> sides; ///< faces of each local node
  };
} // namespace geocone::GEOCONE_DIM

#endif
