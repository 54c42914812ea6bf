// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_face_points_h
#define geocone_surfaces_face_points_h

#include <geocone/boundary/boundary_conditions.h>
#include <geocone/space/space.h>
#include <geocone/surfaces/side_part.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Quadrature point on a face of a cell. */
  struct FacePoint
  {
    dealii::Point<dim>        position;
    dealii::Tensor<1, dim>    normal; ///< outward normal of the cell
    double                    weight; ///< JxW times measure() (m, m^2)
    std::vector<unsigned int> nodes;  ///< local nodes of the cell
    std::vector<double>       values; ///< shape functions N, by node
  };

  /** Returns Gauss points on a face or a part of a face. With shape functions
   *  of degree p, the quadrature is exact for polynomials of degree 2p + 3. */
  std::vector<FacePoint>
  points_on_face(const BackgroundMesh       &mesh,
                 const Space                &space,
                 const BackgroundMesh::Cell &cell,
                 const unsigned int          face,
                 const UnitPart             &part = UnitPart::whole());

  /** Returns the part of a face selected by a boundary condition. No value is
   *  returned for a face that is not selected. A box can select a part of a
   *  face; formulas select entire faces.
   *  @throws InputError for a part of a three-dimensional face that is oblique
   *  to the axes */
  std::optional<UnitPart>
  part_of_face(const BoundaryCondition    &condition,
               const BackgroundMesh       &mesh,
               const BackgroundMesh::Cell &cell,
               const unsigned int          face);

  /**
   * Calls f(cell, point) for each Gauss point on the faces selected by a
   * boundary condition. Faces of the cells of this rank are included.
   * @return number of selected faces on this rank
   */
  template <typename Function>
  unsigned int
  for_each_face_point(const BackgroundMesh    &mesh,
                      const Space             &space,
                      const BoundaryCondition &condition,
                      const Function          &f)
  {
    const auto   ids     = mesh.side_ids(condition);
    unsigned int n_faces = 0;
    for (const auto &cell : mesh.own_cells())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary() &&
            ids.count(cell->face(face)->boundary_id()) > 0)
          if (const auto part = part_of_face(condition, mesh, cell, face))
            {
              ++n_faces;
              for (const FacePoint &point :
                   points_on_face(mesh, space, cell, face, *part))
                f(cell, point);
            }
    return n_faces;
  }

  /** Rejects a boundary condition that selects no face. @throws InputError if
   *  no rank has a selected face
   *  @param what consequence, for the message. Collective. */
  void
  refuse_no_face(const BoundaryCondition &condition,
                 const unsigned int       n_faces,
                 const MPI_Comm           comm,
                 const std::string       &what);
} // namespace geocone::GEOCONE_DIM

#endif
