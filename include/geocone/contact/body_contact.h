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
   * Contact between deformable bodies by the mortar method with dual basis functions
   * psi_i (Wohlmuth 2000; Hueeber and Wohlmuth 2005). A uniform pressure is
   * transmitted between non-matching meshes. The contact pressure is sum_i psi_i
   * r_i/D_i on the faces of the first body, where on each face
   *   int psi_i N_j = delta_ij int N_j  over the part facing the other body.
   * With D_i = int psi_i and M_ij = int psi_i N_j of the other body, node i is
   * in contact with a surface that moves by sum_j P_ij v_j, P = M/D; its gap is
   * n.(x_i - sum_j P_ij x_j). Forces r_i and -P_ij r_i are in equilibrium; so
   * are their moments if the gap is closed.
   *
   * Positions are those at the beginning of a step. Strains are small, so
   * integrals use the initial measures: around an axis with 2 pi r. Edges are
   * taken as straight and faces as flat; points are projected along the normal
   * of the face of the first body. n is the mean of these normals at the node.
   * Nodes with D_i = 0, e.g. corners of quadratic triangles, carry no force and
   * are free. The integrals are exact, piece by piece, in the plane and for
   * triangles and parallelograms.
   */
  class BodyContact
  {
  public:
    BodyContact(const Scene          &scene,
                const BackgroundMesh &mesh,
                const Space          &space);

    /** Function that returns the current position of a local node. */
    using Positions = std::function<dealii::Point<dim>(unsigned int)>;

    /**
     * Finds the potential contact nodes. The result is the same on all ranks. Each
     * node appears once, in the first contact of the list that contains it.
     * @param reach maximum distance of facing faces, in addition to the size of a
     * face (m)
     * @throws StepFailure if a node of the first body of one contact also
     * belongs to the other body of a later contact
     */
    std::vector<FacingNode>
    find(const Positions &place, const double reach) const;

    /** Checks that the bodies do not overlap in the initial state.
     *  @throws InputError if bodies overlap */
    void
    check_start(const Positions &place) const;

  private:
    /** A boundary face of a cell: an edge in two dimensions. */
    struct Face
    {
      BackgroundMesh::Cell      cell;
      SidePart                  unit;     ///< in unit coordinates of the cell
      SidePart                  at_start; ///< initial, ordered as FacePlane
      std::vector<unsigned int> corners = {}; ///< nodes, ordered as FacePlane
      std::vector<unsigned int> nodes   = {}; ///< nodes on the face
      std::vector<unsigned int> of_cell = {}; ///< numbers in the cell

      Eigen::VectorXd integrals = {}; ///< int N of each, on the initial face

      double size = 0.; ///< initial length (m) or area (m^2), without 2 pi r
    };

    /** Finds the boundary faces of all cells with selected materials.
     *  @param materials selection by material index */
    std::vector<Face>
    faces_of(const std::vector<bool> &materials) const;

    /** A face in the current configuration. */
    struct PlacedFace
    {
      const Face *face;
      SidePart    outline;
      FacePlane   plane;
    };
    static std::vector<PlacedFace>
    placed(const std::vector<Face> &faces, const Positions &place);

    /** Evaluates the shape functions N of the nodes on a face, at unit
     *  coordinates s of the face. */
    void
    evaluate(const Face                   &face,
             const dealii::Point<dim - 1> &s,
             Eigen::VectorXd              &N) const;

    /** A quadrature point on a face of the first body, and the opposite point on
     *  the other body. */
    struct PointAhead
    {
      dealii::Point<dim - 1> s; ///< unit coordinates on the face
      const Face            *other;
      dealii::Point<dim - 1> other_s;
      double                 part; ///< weight, as a fraction of the face
    };
    std::vector<PointAhead>
    points_ahead(const PlacedFace              &face,
                 const std::vector<PlacedFace> &others,
                 const double                   reach) const;

    /** Mortar integrals of a node, summed over the faces that contain the
     *  node. */
    struct Sums
    {
      double                         D     = 0.;
      double                         whole = 0.; ///< D of fully opposite faces
      double                         faced = 0.; ///< size of the opposite part
      double                         diameter = 0.; ///< largest face (m)
      dealii::Tensor<1, dim>         normal; ///< sum of outward normal x size
      std::map<unsigned int, double> M;
    };

    /** Adds the contributions of a face to the mortar matrices (D on the first
     *  body, M on the other body) and to the nodal normals. */
    void
    integrate(const PlacedFace              &placed_face,
              const std::vector<PointAhead> &points,
              std::map<unsigned int, Sums>  &sums) const;

    /** Computes Sums::whole, i.e. D as if the faces were completely opposite the
     *  other body, for all contact nodes. */
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
