// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_body_contact_h
#define geocone_mechanics_body_contact_h

#include <geocone/discretisation/space.h>
#include <geocone/mechanics/contact.h>
#include <geocone/scene/scene.h>

#include <Eigen/Dense>

#include <functional>
#include <map>
#include <vector>

namespace geocone
{
  /**
   * Where the deformable bodies of a plane scene touch: by mortar elements with dual
   * functions (Wohlmuth 2000; Hueeber and Wohlmuth 2005), so that a uniform pressure
   * passes through meshes that do not fit. The pressure of the contact is
   * sum_i psi_i r_i/D_i on the edges of the first body, where on each edge
   *   int psi_i N_j = delta_ij int N_j  over what the other body faces.
   * With D_i = int psi_i and M_ij = int psi_i N_j of the other body, node i touches what
   * moves by sum_j P_ij v_j, P = M/D; its gap is n.(x_i - sum_j P_ij x_j). Forces r_i
   * and -P_ij r_i are in equilibrium; so are their moments where the gap is closed.
   *
   * Places are those of the beginning of a step. Edges are taken as straight; points
   * are projected along the normal of the edge of the first body. n is the mean of
   * these normals at the node. The integrals are exact, piece by piece.
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
     * @param reach how far apart edges count that face each other, beside the length
     * of an edge (m)
     * @throws StepFailure if a node touches by one contact and is touched by another
     * one that comes later
     */
    std::vector<FacingNode>
    find(const Place &place, const double reach) const;

    /** @throws InputError if bodies overlap at the start */
    void
    check_start(const Place &place) const;

  private:
    /** An edge of a cell at the boundary. */
    struct Edge
    {
      BackgroundMesh::Cell      cell;
      dealii::Point<dim>        unit_start, unit_end; ///< the body on the left
      unsigned int              start, end;           ///< nodes at the ends
      std::vector<unsigned int> nodes;                ///< on the edge
      std::vector<unsigned int> of_cell; ///< their numbers in the cell

      /** At the start, as strains are small: of the edge (m), and int N of its nodes. */
      double          length;
      Eigen::VectorXd integrals;
    };

    /** The edges of the materials. */
    std::vector<Edge>
    edges_of(const std::vector<bool> &materials) const;

    /** N of the nodes on an edge, at a part s of its length. */
    void
    evaluate(const Edge &edge, const double s, double *N) const;

    /** What an edge of the first body faces. */
    struct Piece
    {
      double      begin, end; ///< parts of its length
      const Edge *other;
      double      other_begin, other_end; ///< of the other edge
    };
    std::vector<Piece>
    pieces(const Edge              &edge,
           const std::vector<Edge> &others,
           const Place             &place,
           const double             reach) const;

    /** Sums over the edges of a node. */
    struct Sums
    {
      double                 D     = 0.;
      double                 whole = 0.; ///< D if all of the edges are faced
      dealii::Tensor<1, dim> normal;     ///< outward, times lengths
      std::map<unsigned int, double> M;
    };

    /** Adds what an edge has of D, M and the normals. */
    void
    integrate(const Edge                   &edge,
              const std::vector<Piece>     &facing,
              const Place                  &place,
              std::map<unsigned int, Sums> &sums) const;

    /** Adds what D would be on whole edges, of those nodes that have one. */
    void
    add_whole_edges(const std::vector<Edge>      &edges,
                    const Place                  &place,
                    std::map<unsigned int, Sums> &sums) const;

    const Scene          &scene;
    const BackgroundMesh &mesh;
    const Space          &space;

    struct Pair
    {
      std::vector<Edge> first, other;
    };
    std::vector<Pair> pairs;
  };
} // namespace geocone

#endif
