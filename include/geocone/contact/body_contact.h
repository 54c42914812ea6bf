// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_body_contact_h
#define geocone_contact_body_contact_h

#include <geocone/contact/contact.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>
#include <geocone/surfaces/face_plane.h>

#include <Eigen/Dense>

#include <functional>
#include <map>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Where deformable bodies touch: by mortar elements with dual functions (Wohlmuth
   * 2000; Hueeber and Wohlmuth 2005), so that a uniform pressure passes through meshes
   * that do not fit. The pressure of the contact is sum_i psi_i r_i/D_i on the faces of
   * the first body, where on each face
   *   int psi_i N_j = delta_ij int N_j  over what the other body faces.
   * With D_i = int psi_i and M_ij = int psi_i N_j of the other body, node i touches what
   * moves by sum_j P_ij v_j, P = M/D; its gap is n.(x_i - sum_j P_ij x_j). Forces r_i
   * and -P_ij r_i are in equilibrium; so are their moments where the gap is closed.
   *
   * Places are those of the beginning of a step, the measures of integrals those of the
   * start, as strains are small: around an axis with 2 pi r. Edges are taken as straight
   * and faces as flat; points are projected along the normal of the face of the first
   * body. n is the mean of these normals at the node. Nodes with D_i = 0, as corners of
   * quadratic triangles, bear nothing and are free. The integrals are exact, piece by
   * piece, in the plane and of triangles and parallelograms.
   */
  class BodyContact
  {
  public:
    BodyContact(const Scene          &scene,
                const BackgroundMesh &mesh,
                const Space          &space);

    /** Where a local node is. */
    using Place = std::function<dealii::Point<dim>(unsigned int)>;

    /**
     * All of them, the same on each rank, each node once: by the contact that comes
     * first in the list.
     * @param reach how far apart faces count that face each other, beside the size of a
     * face (m)
     * @throws StepFailure if a node touches by one contact and is touched by another
     * one that comes later
     */
    std::vector<FacingNode>
    find(const Place &place, const double reach) const;

    /** @throws InputError if bodies overlap at the start */
    void
    check_start(const Place &place) const;

  private:
    /** A face of a cell at the boundary: in the plane an edge. */
    struct Face
    {
      BackgroundMesh::Cell      cell;
      SidePart                  unit;     ///< in unit coordinates of the cell
      SidePart                  at_start; ///< both in the order of FacePlane
      std::vector<unsigned int> corners = {}; ///< nodes, in this order
      std::vector<unsigned int> nodes   = {}; ///< on the face
      std::vector<unsigned int> of_cell = {}; ///< their numbers in the cell

      Eigen::VectorXd integrals = {}; ///< of their N, at the start

      double size =
        0.; ///< at the start (m, m^2), around an axis without 2 pi r
    };

    /** The faces of the materials. */
    std::vector<Face>
    faces_of(const std::vector<bool> &materials) const;

    /** A face as it is. */
    struct PlacedFace
    {
      const Face *face;
      SidePart    outline;
      FacePlane   plane;
    };
    static std::vector<PlacedFace>
    placed(const std::vector<Face> &faces, const Place &place);

    /** N of the nodes on a face, at unit coordinates of the face. */
    void
    evaluate(const Face                   &face,
             const dealii::Point<dim - 1> &s,
             Eigen::VectorXd              &N) const;

    /** A point of integrals over what a face of the first body faces. */
    struct PointAhead
    {
      dealii::Point<dim - 1> s; ///< on the face
      const Face            *other;
      dealii::Point<dim - 1> other_s;
      double                 part; ///< of the size of the face
    };
    std::vector<PointAhead>
    points_ahead(const PlacedFace              &face,
                 const std::vector<PlacedFace> &others,
                 const double                   reach) const;

    /** Sums over the faces of a node. */
    struct Sums
    {
      double                 D        = 0.;
      double                 whole    = 0.; ///< D if all of the faces are faced
      double                 faced    = 0.; ///< size of what of them is faced
      double                 diameter = 0.; ///< of the largest (m)
      dealii::Tensor<1, dim> normal;        ///< outward, times sizes
      std::map<unsigned int, double> M;
    };

    /** Adds what a face has of D, M and the normals. */
    void
    integrate(const PlacedFace              &placed_face,
              const std::vector<PointAhead> &points,
              std::map<unsigned int, Sums>  &sums) const;

    /** Adds what D would be on whole faces, of those nodes that have one. */
    static void
    add_whole_faces(const std::vector<PlacedFace> &faces,
                    std::map<unsigned int, Sums>  &sums);

    const Scene          &scene;
    const BackgroundMesh &mesh;
    const Space          &space;

    struct Pair
    {
      std::vector<Face> first, other;
    };
    std::vector<Pair> pairs;
  };
} // namespace geocone::GEOCONE_DIM

#endif
