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
   * Contact between deformable bodies: mortar elements with dual functions
   * (Wohlmuth 2000; Hueeber and Wohlmuth 2005), which transmit a uniform
   * pressure between non-matching meshes. The contact pressure is sum_i psi_i
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

    /** Current position of a local node. */
    using Place = std::function<dealii::Point<dim>(unsigned int)>;

    /**
     * Finds the contact nodes, the same on each rank. Each node appears once,
     * in the first contact of the list that contains it.
     * @param reach largest distance of facing faces, in addition to the size of
     * a face (m)
     * @throws StepFailure if a node of the first body of one contact also
     * belongs to the other body of a later contact
     */
    std::vector<FacingNode>
    find(const Place &place, const double reach) const;

    /** @throws InputError if bodies overlap at the start */
    void
    check_start(const Place &place) const;

  private:
    /** A face of a cell at the boundary: an edge in the plane. */
    struct Face
    {
      BackgroundMesh::Cell      cell;
      SidePart                  unit;     ///< in unit coordinates of the cell
      SidePart                  at_start; ///< both in the order of FacePlane
      std::vector<unsigned int> corners = {}; ///< nodes, in this order
      std::vector<unsigned int> nodes   = {}; ///< on the face
      std::vector<unsigned int> of_cell = {}; ///< their numbers in the cell

      Eigen::VectorXd integrals = {}; ///< of their N, on the initial face

      double size =
        0.; ///< at the start (m, m^2), around an axis without 2 pi r
    };

    /** Boundary faces of the materials. */
    std::vector<Face>
    faces_of(const std::vector<bool> &materials) const;

    /** A face in its current position. */
    struct PlacedFace
    {
      const Face *face;
      SidePart    outline;
      FacePlane   plane;
    };
    static std::vector<PlacedFace>
    placed(const std::vector<Face> &faces, const Place &place);

    /** Evaluates N of the nodes of a face, in unit coordinates of the face. */
    void
    evaluate(const Face                   &face,
             const dealii::Point<dim - 1> &s,
             Eigen::VectorXd              &N) const;

    /** A quadrature point on a face of the first body opposite the other
     *  body. */
    struct PointAhead
    {
      dealii::Point<dim - 1> s; ///< on the face
      const Face            *other;
      dealii::Point<dim - 1> other_s;
      double                 part; ///< fraction of the face
    };
    std::vector<PointAhead>
    points_ahead(const PlacedFace              &face,
                 const std::vector<PlacedFace> &others,
                 const double                   reach) const;

    /** Sums over the faces of a node. */
    struct Sums
    {
      double                         D     = 0.;
      double                         whole = 0.; ///< D if fully opposite
      double                         faced = 0.; ///< size of the opposite part
      double                         diameter = 0.; ///< of the largest (m)
      dealii::Tensor<1, dim>         normal;        ///< outward, times sizes
      std::map<unsigned int, double> M;
    };

    /** Adds the contributions of a face to D, M and the normals. */
    void
    integrate(const PlacedFace              &placed_face,
              const std::vector<PointAhead> &points,
              std::map<unsigned int, Sums>  &sums) const;

    /** Computes D of fully opposite faces for all nodes with such faces. */
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
