// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_face_points_h
#define geocone_mechanics_face_points_h

#include <geocone/discretisation/space.h>

#include <vector>

namespace geocone
{
  /** A quadrature point of a face of a cell. */
  struct FacePoint
  {
    dealii::Point<dim>        position;
    dealii::Tensor<1, dim>    normal; ///< outward from the cell
    double                    weight; ///< JxW (m)
    std::vector<unsigned int> nodes;  ///< local, of the cell
    std::vector<double>       values; ///< N at the point, per node
  };

  /** Gauss points of a face, exact for degree 2p + 3. Faces are straight. */
  std::vector<FacePoint>
  points_on_face(const BackgroundMesh       &mesh,
                 const Space                &space,
                 const BackgroundMesh::Cell &cell,
                 const unsigned int          face);
} // namespace geocone

#endif
