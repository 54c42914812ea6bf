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
  /** Gap below which a contact is considered closed, over the size of a
   *  cell. */
  constexpr double closed_gap = 1e-9;

  /** Distance below which boundaries of obstacles are joined, over the size of
   *  a cell. */
  constexpr double meeting = 1e-3;

  /** Cosine of the angle between normals above which they are considered
   *  parallel (10 degrees). */
  const double parallel = std::cos(radians(10.));

  /** Minimum length of the free part of the normal for contact of a node with
   *  partial support (10 degrees). */
  const double along_support = std::cos(radians(10.));

  /** A node that may be in contact with an obstacle or another body in a
   *  step. */
  struct ContactNode
  {
    unsigned int node; ///< local, also a ghost

    /** Number of the obstacle, or of the contact pair; pairs are numbered after
     *  obstacles. */
    unsigned int           obstacle;
    dealii::Tensor<1, dim> normal; ///< out of the obstacle, or the other body
    dealii::Tensor<1, dim> arm;    ///< from the obstacle's centre (m)

    /** Unit vectors orthogonal to the normal and each other in which it may
     *  slide, in free directions only. */
    std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
    unsigned int                                n_tangents = 0;

    dealii::Tensor<1, dim>
      velocity; ///< of the obstacle, or other body, here (m/s)

    /** A node of the other body and its weight in the velocity here. */
    struct Partner
    {
      unsigned int node; ///< local, also a ghost
      double       part;
    };
    std::vector<Partner> partners; ///< empty for obstacles

    /** Whether the other body's node is at the same position in another layer
     *  of the mesh, so that supports act on both in the same way. */
    bool is_twin = false;

    double length = 0.; ///< tributary length of the boundary (m), or 0

    /** Lower bound of the relative normal velocity: -g/h for a gap g, or -e u_N
     *  with the initial u_N if the node rebounds (m/s). */
    double least    = 0.;
    bool   rebounds = false; ///< whether e > 0

    /** Initial u_N of a node that impacts and rebounds in this step. */
    double impact = 0.;

    /** Share of the force of a corner node, which has two contacts with normals
     *  n and m: n k' with k.n = 1, k.m = 0; otherwise the identity. */
    dealii::Tensor<2, dim> share =
      dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    bool is_corner = false;
    bool is_second = false; ///< of the two contacts

    bool
    touches_body() const
    {
      return !partners.empty();
    }

    bool is_closed = false; ///< at the beginning of the step

    double friction = 0.; ///< mu
    double adhesion = 0.; ///< besides friction, while closed (N/m)
    double tension  = 0.; ///< largest tension, if initially closed (N/m)
  };

  /** A node of a first body that may contact the other one, without the values
   *  that depend on the step; the gap and, for body-fitted meshes, the size of
   *  the faces there (m). */
  struct FacingNode
  {
    ContactNode node;
    double      gap;
    double      size = 0.;
  };

  /** Potential contacts of a step. */
  struct ContactStep
  {
    /** Contact nodes of this rank, with ghosts. A corner node has two
     *  consecutive entries with non-parallel normals, the nearer contact
     *  first. */
    std::vector<ContactNode>  nodes;
    std::vector<ObstacleBody> bodies; ///< the obstacles
    bool has_pairs = false;           ///< whether bodies may touch, on any rank
  };

  /**
   * Unilateral frictional contact of nodes with rigid obstacles or other
   * bodies, without additional unknowns. In the rows of a contact node, the
   * residual R(v) of the momentum balance is the force r exerted by the
   * obstacle. Signorini's and Coulomb's laws for r and the relative velocity u,
   *   0 <= r_N + t  _|_  w_N = u_N - least >= 0,
   *   |r_T| <= mu r_N + c,  and u_T against r_T where it slides,
   * with a sustainable tension t if the node is closed at the beginning, mu t
   * <= c, are the roots of (Alart and Curnier 1991, for any rho > 0)
   *   F_N = r_N - q,                     q = max(r_N - rho w_N, -t),
   *   F_T = r_T - [r_T - rho u_T] in +-b,  b = mu q + c (0 where q = -t).
   * F replaces R in these rows, so that one Newton iteration solves for
   * plasticity and contact. dF = A dr + B dv: the 2 x 2 matrices A combine rows
   * of the Jacobian, and B is added to the diagonal. Both are zero or multiples
   * of the identity except for sliding nodes. rho is given by rho_of().
   *
   * Equivalently F = r - q, with q the projection of p = r - rho (u - least n).
   * A free obstacle has no unknowns here either: its velocity y at the end of
   * the step, which is G_i y at node i, balances the projected forces,
   *   M (y - y_0)/h + sum_i G_i' q_i = 0:
   * a function of v, found from a few equations of its own. (The forces r are
   * far off before Newton's method has converged and would accelerate a light
   * obstacle erratically.) With Q = dq/dp and E = M/h + sum rho G' Q G,
   *   dF = (1 - Q) dr + rho Q (dv - G dy),   E dy = -sum G' Q (dr - rho dv):
   * a part U W' of one column per free motion in the Jacobian, U = rho Q G, W'
   * = E^-1 sum G' Q (K - rho), K the rows of the Jacobian before they are
   * combined.
   *
   * Another body moves at node i by sum_j P_ij v_j, with the force -P_ij r_i at
   * its node j. P_ij r_i is added to the residual there before F_i replaces
   * r_i, and P_ij times the rows of i to the rows of j: the multipliers of the
   * contact, which are the r_i by the dual functions of BodyContact, are
   * condensed out.
   *
   * A corner node has two contacts with normals n_1 and n_2, each an entry of
   * its own. Without friction its force is r = a_1 n_1 + a_2 n_2, of which each
   * entry has the share n_i k_i' r; the first one also has the component along
   * the edge, which vanishes in equilibrium. F and A are the sums of both.
   *
   * A node supported in some directions is in contact only in the others, and
   * only if the normal is along them or the nodes are twins. With a single free
   * direction there is no friction.
   */
  class Contact
  {
  public:
    explicit Contact(const Unknowns &unknowns)
      : unknowns(unknowns)
    {}

    /** @throws StepFailure if a support acts on a node in contact with another
     *  body */
    void
    begin_step(ContactStep step);

    /** Nodes that couple with those of other bodies in the Jacobian: each node,
     *  followed by its partners. */
    std::vector<std::vector<unsigned int>>
    links() const;

    /**
     * Replaces the forces r in the rows of contact nodes by F, and stores both.
     * @param[in,out] residual in owned rows
     * @param scale the diagonal of the elastic Jacobian (kg/(m s))
     * @param with_friction whether friction is included
     * @param holds whether initially closed contacts are bilateral. Collective.
     */
    void
    replace(Vector       &residual,
            const Vector &v,
            const Vector &scale,
            const bool    with_friction,
            const bool    holds);

    /** Applies A and B of the last replace() to the rows of the Jacobian.
     *  Collective if obstacles are free.
     *  @return contribution of free obstacles */
    LowRank
    linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const;

    /** Applies A and B to a product: dst = A dst + B dv, in owned rows.
     *  @param dv with its ghosts. Collective. */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Sums over active and potential contacts on this rank. */
    struct Sums
    {
      double of_errors = 0.; ///< |F|^2
      double of_bodies = 0.; ///< of_errors of free obstacles
      double of_sizes  = 0.; ///< reference for errors
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

    /** State of an owned node at the last replace(). */
    struct Touch
    {
      dealii::Tensor<1, dim> force; ///< of the obstacle on the body (N/m)
      State                  state = State::open;
      double                 error = 0.; ///< |F| (N/m)
      double size = 0.; ///< |r| + rho |u|, the reference for F (N/m)
      dealii::Tensor<1, dim> relative; ///< u, in free directions (m/s)
      double                 rho = 0.; ///< (kg/(m s))
    };

    /** @name For ContactDirection */
    /** @{ */
    /** Selects the owned nodes that are in contact at the last replace(), or
     *  within the distance over which the forces there could move them.
     *  Collective. */
    std::vector<unsigned int>
    choose(const MPI_Comm comm) const;

    /** Replaces dF by r + rho du in linearise() for these nodes and freezes the
     *  motions of obstacles. Collective. */
    void
    relax(const std::vector<unsigned int> &chosen);

    bool
    is_owned(const ContactNode &node) const
    {
      return dim * node.node < row_A[0].locally_owned_size();
    }

    /** Changes the initial guess of the velocities of free obstacles in the
     *  next replace(). */
    void
    change_motions(const Eigen::VectorXd &change)
    {
      obstacles.change(change);
    }

    /** Calls f(number, G) for each free motion of a node's obstacle; G is the
     *  velocity of the node by this motion. */
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

    /** State of each of nodes(); meaningless for nodes that are not owned. */
    const std::vector<Touch> &
    touches() const
    {
      return touch;
    }

    /** Whether there is a force, including tension in initially closed
     *  contacts. */
    bool
    carries_load(const unsigned int i) const
    {
      return touch[i].state != State::open || list[i].tension > 0.;
    }

    /** Properties over all ranks. Collective. */
    ContactTraits
    traits(const MPI_Comm comm) const;

    /** Velocities of the obstacles at the last replace(). */
    const ObstacleMotions &
    motions() const
    {
      return obstacles;
    }

    /** Part of a vector along the free directions of a node. */
    dealii::Tensor<1, dim>
    free_part(const dealii::Tensor<1, dim> &x, const unsigned int node) const;

  private:
    using Force  = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    /** Input of replace() at an owned node, in free directions only. */
    struct Local
    {
      Force  r, v;
      double rho = 0.;
    };

    /** rho: for a pair 1/rho = 1/d_i + sum P_ij^2/d_j, d the mean of
     *  IncrementalProblem::scale() at a node. The lighter body dominates,
     *  whichever of the two it is. */
    double
    rho_of(const ContactNode &node, const Vector &scale) const;

    /** v at the free dofs of a node. */
    Force
    free_part(const Vector &v, const unsigned int node) const;

    /** Velocity of the other body at a node, in its free directions. @param v
     *  with ghosts */
    Force
    velocity_of_partners(const ContactNode &node, const Vector &v) const;

    /** Number of unsupported directions of a node. */
    unsigned int
    n_free(const unsigned int node) const;

    /** Chooses the tangents of a node whose normal is in its free
     *  directions. */
    void
    make_tangents(ContactNode &node) const;

    /** Makes a corner of two entries of the same node with non-parallel
     *  normals. */
    static void
    make_corner(ContactNode &a, ContactNode &b);

    /** Adds P' r to the rows of other bodies. Collective. */
    void
    load_partners(Vector &residual) const;

    /** Adds P' times the rows of contact nodes to the Jacobian's rows of other
     *  bodies. */
    void
    add_rows_to_partners(SparseMatrix &matrix) const;

    /** Projection q of a node, F, and Q. */
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

    /** Sums G' q, rho G' Q G and magnitudes for each obstacle at its present
     *  motion. Collective. */
    std::vector<double>
    sums_of_nodes(const std::vector<Local> &locals, const MPI_Comm comm) const;

    /** Combines the rows of a node by A. */
    void
    combine_rows(const unsigned int node, SparseMatrix &matrix) const;

    /** Contribution of free obstacles to the Jacobian. @param matrix before
     *  linearise() */
    LowRank
    low_rank(const SparseMatrix &matrix) const;

    const Unknowns          &unknowns;
    std::vector<ContactNode> list;
    std::vector<Touch>       touch;
    std::vector<Matrix>      rho_Q; ///< of owned nodes
    std::array<Vector, dim>  row_A; ///< A by component of F, at the node's dofs
    ObstacleMotions          obstacles;
    bool                     has_pairs     = false; ///< of bodies, on any rank
    double                   body_error    = 0.; ///< of their equilibrium (N/m)
    bool                     with_friction = true;  ///< in the last replace()
    bool                     holds         = false; ///< in the last replace()
    bool                     relaxed = false; ///< since the last replace()
  };
} // namespace geocone::GEOCONE_DIM

#endif
