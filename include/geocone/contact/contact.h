// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_contact_h
#define geocone_contact_contact_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/conditions/jacobian_pattern.h>
#include <geocone/conditions/unknowns.h>
#include <geocone/contact/contact_traits.h>
#include <geocone/contact/low_rank.h>
#include <geocone/contact/obstacle_motions.h>

#include <deal.II/base/symmetric_tensor.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A gap that counts as none, over the size of a cell. */
  constexpr double closed_gap = 1e-9;

  /** Boundaries of obstacles that are nearer than this part of a cell meet. */
  constexpr double meeting = 1e-3;

  /** Normals with a larger cosine between them count as one (10 degrees). */
  const double parallel = std::cos(radians(10.));

  /** A node of which a support holds some directions touches in the others, if the
   *  normal's part along these is longer (10 degrees). */
  const double along_support = std::cos(radians(10.));

  /** A node that may touch an obstacle, or another body, in a step. */
  struct ContactNode
  {
    unsigned int node; ///< local, also a ghost

    /** Number of the obstacle; of a pair of bodies, which come after them. */
    unsigned int           obstacle;
    dealii::Tensor<1, dim> normal; ///< out of the obstacle, or the other body
    dealii::Tensor<1, dim> arm;    ///< from the obstacle's centre (m)

    /** Unit vectors across the normal and each other in which it may slide: as many as
     *  supports leave free. */
    std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
    unsigned int                                n_tangents = 0;

    dealii::Tensor<1, dim>
      velocity; ///< of the obstacle, or other body, here (m/s)

    /** A node of the other body, and its part of the velocity here. */
    struct Partner
    {
      unsigned int node; ///< local, also a ghost
      double       part;
    };
    std::vector<Partner> partners; ///< of an obstacle none

    /** Whether the other body's node is in the same place of another layer of the mesh:
     *  what holds one of both holds the other one alike. */
    bool is_twin = false;

    double length = 0.; ///< of the boundary that the node stands for (m), or 0

    /** Least relative normal velocity: -g/h for a gap g, or -e u_N of the beginning
     *  where the node rebounds (m/s). */
    double least    = 0.;
    bool   rebounds = false; ///< whether e > 0

    /** Of a node that hits in this step and rebounds: its u_N at the beginning. */
    double impact = 0.;

    /** Of a corner, where a node is in two contacts with other normals n and m: the part
     *  of its force that is this one's, n k' with k.n = 1, k.m = 0; else the identity. */
    dealii::Tensor<2, dim> share =
      dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    bool is_corner = false;
    bool is_second = false; ///< of the two contacts

    bool
    touches_body() const
    {
      return !partners.empty();
    }

    bool is_closed = false; ///< at the beginning

    double friction = 0.; ///< mu
    double adhesion = 0.; ///< borne besides friction, while closed (N/m)
    double tension  = 0.; ///< largest pull, of what is closed at first (N/m)
  };

  /** A node of a first body that may touch the other one, without what depends on the
   *  step, the gap, and of meshes that are bodies the size of the faces there (m). */
  struct FacingNode
  {
    ContactNode node;
    double      gap;
    double      size = 0.;
  };

  /** What may touch in a step. */
  struct ContactStep
  {
    /** All of this rank, with ghosts; in a corner two of the same node, one after the
     *  other, the nearer one first, with normals that are not parallel. */
    std::vector<ContactNode>  nodes;
    std::vector<ObstacleBody> bodies; ///< the obstacles
    bool has_pairs = false;           ///< whether bodies may touch, on any rank
  };

  /**
   * Unilateral contact with friction of nodes and rigid obstacles, or other bodies,
   * without an unknown of its own. In the rows of a node that may touch, the residual R(v) of
   * the momentum balance is the force r that the obstacle exerts. Signorini's and
   * Coulomb's laws for it and the relative velocity u,
   *   0 <= r_N + t  _|_  w_N = u_N - least >= 0,
   *   |r_T| <= mu r_N + c,  and u_T against r_T where it slides,
   * with a pull t that is borne where the node is closed at the beginning, mu t <= c,
   * are the roots of (Alart and Curnier 1991, for any rho > 0)
   *   F_N = r_N - q,                     q = max(r_N - rho w_N, -t),
   *   F_T = r_T - [r_T - rho u_T] in +-b,  b = mu q + c (0 where q = -t),
   * which takes the place of R in these rows, so that one Newton iteration solves
   * for plasticity and contact. dF = A dr + B dv: rows of the Jacobian are
   * combined by the 2 x 2 matrices A, and B comes to the diagonal; both are the
   * identity's multiples or zero but for sliding nodes. rho is rho_of().
   *
   * So F = r - q, q the projection of p = r - rho (u - least n). A free obstacle has no
   * unknowns here either: its velocity y at the end of the step, which is G_i y at node
   * i, is that for which the projected forces are in equilibrium with its own,
   *   M (y - y_0)/h + sum_i G_i' q_i = 0:
   * a function of v, found by a few equations of its own. (By the forces r, which are
   * far off before Newton's method has converged, a light obstacle would be thrown
   * about.) With Q = dq/dp and E = M/h + sum rho G' Q G,
   *   dF = (1 - Q) dr + rho Q (dv - G dy),   E dy = -sum G' Q (dr - rho dv):
   * a part U W' of one column per free motion in the Jacobian, U = rho Q G, W' = E^-1 sum
   * G' Q (K - rho), K the rows of the Jacobian before they are combined.
   *
   * Another body moves at node i by sum_j P_ij v_j, and bears -P_ij r_i at its node j.
   * So P_ij r_i comes to the residual there before r_i gives way to F_i, and P_ij times
   * the rows of i to the rows of j: the multipliers of the contact, which are the r_i by
   * the dual functions of BodyContact, are condensed out.
   *
   * A node in a corner is in two contacts with normals n_1 and n_2, each an entry of its
   * own. Without friction its force is r = a_1 n_1 + a_2 n_2, of which each takes its share
   * n_i k_i' r; the first one also what is along the edge, which is no force. F and A are
   * the sums of both.
   *
   * A node of which a support holds some directions is in contact only in the other
   * ones: where the normal is along them, or the nodes are twins. Where only one is
   * free, there is no friction.
   */
  class Contact
  {
  public:
    explicit Contact(const Unknowns &unknowns)
      : unknowns(unknowns)
    {}

    /** @throws StepFailure if a node that touches another body is held */
    void
    begin_step(ContactStep step);

    /** The nodes that meet those of other bodies in the Jacobian: of each first the
     *  node, then its partners. */
    std::vector<std::vector<unsigned int>>
    links() const;

    /**
     * Replaces the forces r in the rows of contact by F, and keeps both.
     * @param[in,out] residual in owned rows
     * @param scale the diagonal of the elastic Jacobian (kg/(m s))
     * @param rubs whether there is friction
     * @param holds whether what is closed at the beginning stays so. Collective.
     */
    void
    replace(Vector       &residual,
            const Vector &v,
            const Vector &scale,
            const bool    rubs,
            const bool    holds);

    /** A and B of the last replace() in place of the Jacobian's rows. Collective
     *  where obstacles are free.
     *  @return what free obstacles add to it */
    LowRank
    linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const;

    /** The same for a product: dst = A dst + B dv, in owned rows.
     *  @param dv with its ghosts. Collective. */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Sums over what touches, and may touch, on this rank. */
    struct Sums
    {
      double of_errors = 0.; ///< |F|^2
      double of_bodies = 0.; ///< the same of free obstacles
      double of_sizes  = 0.; ///< what errors are compared with
    };
    Sums
    sums() const
    {
      Sums sums;
      sums.of_bodies = body_error * body_error;
      for (const Touch &at : touch)
        {
          sums.of_errors += at.error * at.error;
          sums.of_sizes += at.size;
        }
      return sums;
    }

    enum class State
    {
      open,
      stick,
      slip
    };

    /** Of an owned node, at the last replace(). */
    struct Touch
    {
      dealii::Tensor<1, dim> force; ///< of the obstacle on the body (N/m)
      State                  state = State::open;
      double                 error = 0.; ///< |F| (N/m)
      double size = 0.; ///< |r| + rho |u|, of what F is made of (N/m)
      dealii::Tensor<1, dim> relative; ///< u, in free directions (m/s)
      double                 rho = 0.; ///< (kg/(m s))
    };

    /** @name For ContactDirection */
    /** @{ */
    /** The owned nodes that touch at the last replace(), or are no farther away than
     *  the forces there could move them. Collective. */
    std::vector<unsigned int>
    choose(const MPI_Comm comm) const;

    /** Takes the laws of these nodes out of linearise(), and the motions of obstacles:
     *  there r + rho du stands in place of dF. Collective. */
    void
    relax(const std::vector<unsigned int> &chosen);

    bool
    is_owned(const ContactNode &node) const
    {
      return dim * node.node < row_A[0].locally_owned_size();
    }

    /** Changes the velocities of free obstacles from which the next replace() begins to
     *  look for them. */
    void
    change_motions(const Eigen::VectorXd &change)
    {
      obstacles.change(change);
    }

    /** Calls f(number, G) for each free motion of a node's obstacle, of which the node
     *  has the velocity G. */
    template <typename Function>
    void
    for_motions_of(const ContactNode &node, const Function &f) const
    {
      if (!node.touches_body())
        obstacles.for_free(
          node.obstacle, [&](const unsigned int k, const unsigned int number) {
            f(number, RigidMotion::of_point(k, node.arm));
          });
    }
    /** @} */

    const std::vector<ContactNode> &
    nodes() const
    {
      return list;
    }

    /** Of each of nodes(); nothing of those that are not owned. */
    const std::vector<Touch> &
    touches() const
    {
      return touch;
    }

    /** Whether there is a force: also where what is closed at first is pulled open. */
    bool
    bears(const unsigned int i) const
    {
      return touch[i].state != State::open || list[i].tension > 0.;
    }

    /** Of all ranks. Collective. */
    ContactTraits
    traits(const MPI_Comm comm) const;

    /** The velocities of the obstacles, at the last replace(). */
    const ObstacleMotions &
    motions() const
    {
      return obstacles;
    }

    /** What of a vector is along the free directions of a node. */
    dealii::Tensor<1, dim>
    free_part(const dealii::Tensor<1, dim> &x, const unsigned int node) const;

  private:
    using Force  = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    /** Of an owned node: what replace() starts from, of free directions only. */
    struct Local
    {
      Force  r, v;
      double rho = 0.;
    };

    /** rho: of a pair 1/rho = 1/d_i + sum P_ij^2/d_j, d the mean of IncrementalProblem::
     *  scale() at a node; a light body gives way, whichever of both it is. */
    double
    rho_of(const ContactNode &node, const Vector &scale) const;

    /** v at the free dofs of a node. */
    Force
    free_part(const Vector &v, const unsigned int node) const;

    /** Of the other body at a node, in its free directions. @param v with ghosts */
    Force
    velocity_of_partners(const ContactNode &node, const Vector &v) const;

    /** In how many directions no support holds a node. */
    unsigned int
    n_free(const unsigned int node) const;

    /** Chooses the tangents of a node, whose normal is of its free directions. */
    void
    make_tangents(ContactNode &node) const;

    /** Makes two entries of the same node, whose normals are not parallel, a corner. */
    static void
    make_corner(ContactNode &a, ContactNode &b);

    /** Adds P' r to the rows of other bodies. Collective. */
    void
    load_partners(Vector &residual) const;

    /** The same for rows of the Jacobian. */
    void
    add_rows_to_partners(SparseMatrix &matrix) const;

    /** q of a node, F, and Q. */
    struct Projection
    {
      Force  q, F;
      Matrix Q;
      State  state = State::open;
    };
    Projection
    project(const ContactNode &node,
            const Local       &at,
            const Force       &velocity) const;

    /** sum G' q, sum rho G' Q G and the size of the sums, of each obstacle at its
     *  motion. Collective. */
    std::vector<double>
    sums_of_nodes(const std::vector<Local> &locals, const MPI_Comm comm) const;

    /** Combines the rows of a node by A. */
    void
    combine_rows(const unsigned int node, SparseMatrix &matrix) const;

    /** What free obstacles add to the Jacobian. @param matrix before linearise() */
    LowRank
    low_rank(const SparseMatrix &matrix) const;

    const Unknowns          &unknowns;
    std::vector<ContactNode> list;
    std::vector<Touch>       touch;
    std::vector<Matrix>      rho_Q; ///< of owned ones
    std::array<Vector, dim>  row_A; ///< A by component of F, at the node's dofs
    ObstacleMotions          obstacles;
    bool                     has_pairs  = false; ///< of bodies, on any rank
    double                   body_error = 0.;    ///< of their equilibrium (N/m)
    bool                     rubs       = true;  ///< in the last replace()
    bool                     holds      = false; ///< in the last replace()
    bool                     relaxed    = false; ///< since the last replace()
  };
} // namespace geocone::GEOCONE_DIM

#endif
