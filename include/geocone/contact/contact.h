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
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Contact tolerance: a contact is considered closed if its gap is smaller
   *  than this fraction of the cell size. */
  constexpr double closed_gap = 1e-9;

  /** Tolerance for adjacent obstacles: their boundaries form one continuous
   *  boundary if the distance between them is smaller than this fraction of the
   *  cell size. */
  constexpr double continuity_tolerance = 1e-3;

  /** Threshold for parallel normals: cosine of the largest angle (10 degrees)
   *  between two normals that are treated as one. */
  const double parallel = std::cos(radians(10.));

  /** Threshold for contact with another body at a partially supported node: cosine
   *  of the largest angle (10 degrees) between the contact normal and the free
   *  directions of the node. */
  const double least_free_component = std::cos(radians(10.));

  /** Length of the free part of an obstacle's normal below which the supports of
   *  a node act alone. */
  constexpr double least_free_normal = 0.05;

  /** Potential contact node, which may be in contact with an obstacle or another
   *  body in a step. */
  struct ContactNode
  {
    unsigned int node; ///< local number, owned or ghost

    /** Index of the obstacle or contact pair to which the contact belongs.
     *  Contact pairs are numbered after the obstacles. */
    unsigned int           obstacle;

    /** Normal out of the obstacle or other body; at a partially supported node
     *  the direction of its free part. */
    dealii::Tensor<1, dim> normal;
    dealii::Tensor<1, dim> arm; ///< from the obstacle's centre (m)

    /** Matrix B of a contact with an obstacle. The velocity of the node relative
     *  to the obstacle's velocity V there is u = v_f - B V, with the free part v_f
     *  of its velocity; the force of the obstacle on the node is B' q, with the
     *  free part q. At a free node B is the identity. */
    dealii::Tensor<2, dim> of_obstacle =
      dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());

    /** Orthonormal tangent vectors along which the node can slide. The vectors
     *  lie in the free directions of the node. */
    std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
    unsigned int                                n_tangents = 0;

    dealii::Tensor<1, dim>
      velocity; ///< of the obstacle or other body at the node (m/s)

    /** Node j of the other body, with the weight P_ij of its velocity at contact
     *  node i. */
    struct Partner
    {
      unsigned int node; ///< local number, owned or ghost
      double       part;
    };
    std::vector<Partner> partners; ///< empty for obstacles

    /** True if the contact node coincides with the node of the other body. Both
     *  are then nodes of two layers of the mesh, and supports act on both in the
     *  same way. */
    bool is_twin = false;

    double length = 0.; ///< tributary length of the boundary (m), or 0

    /** Lower bound on the normal component u_N of the relative velocity (m/s).
     *  The bound is -g/h for a gap g, or -e times the initial u_N if the node
     *  rebounds with a coefficient of restitution e. */
    double least    = 0.;
    bool   rebounds = false; ///< whether the node rebounds (e > 0)

    /** Normal component u_N of the relative velocity before impact, for a node
     *  that rebounds in this step (m/s). */
    double impact = 0.;

    /** Matrix that extracts the force of this contact from the total contact
     *  force of a corner node, which has two contacts. For contact normals n
     *  and m the matrix is n k' with k.n = 1, k.m = 0; for nodes with a single
     *  contact it is the identity. */
    dealii::Tensor<2, dim> share =
      dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    bool is_corner = false;
    bool is_second = false; ///< second contact of a corner node

    bool
    touches_body() const
    {
      return !partners.empty();
    }

    /**
     * Restricts the contact with an obstacle to the free directions of the node.
     * With n = n_f + n_p of the free and the prescribed directions, s = |n_f|, m =
     * n_f/s and c = n_p/s, the laws of the normal force N and of u_N = n.(v - V)
     * are those of q.m = s N and
     *   u.m = u_N/s - c.v_p,  u = v_f - B V,  B = 1_f + m c',
     * and friction acts along the free tangents, |q_T| <= (mu/s) q.m + c.
     * @param is_prescribed by component
     * @param v velocity, of which the prescribed components v_p count (m/s)
     */
    void
    support(const std::array<bool, dim>  &is_prescribed,
            const dealii::Tensor<1, dim> &v);

    /** Force of the obstacle on the node, with the part that goes into supports.
     *  @param q its part in the free directions */
    dealii::Tensor<1, dim>
    whole(const dealii::Tensor<1, dim> &q) const
    {
      return transpose(of_obstacle) * q;
    }

    /** Length s of the free part of the obstacle's normal, which is s
     *  whole(normal). */
    double
    free_part_of_normal() const
    {
      return 1. / whole(normal).norm();
    }

    bool is_closed = false; ///< gap closed at the beginning of the step

    double friction = 0.; ///< friction coefficient mu
    double adhesion = 0.; ///< shear strength at r_N = 0, if closed (N/m)
    double tension  = 0.; ///< tensile strength, if initially closed (N/m)
  };

  /** Potential contact node on the first of the two bodies of a contact pair.
   *  Includes the gap and, for body-fitted meshes, the size of adjacent faces
   *  (m). Members of ContactNode that depend on the step are not set. */
  struct FacingNode
  {
    ContactNode node;
    double      gap;
    double      size = 0.;
  };

  /** Potential contacts of a step. */
  struct ContactStep
  {
    /** Potential contact nodes of this rank, including ghosts. A corner node has
     *  two consecutive entries with non-parallel normals, the nearer contact
     *  first. */
    std::vector<ContactNode>  nodes;
    std::vector<ObstacleBody> bodies; ///< obstacles
    bool has_pairs = false;           ///< contact between bodies, on any rank
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
   * A free obstacle requires no additional unknowns either: its velocity y at the
   * end of the step, which is G_i y at node i, balances the projected forces,
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
   * A node supported in some directions is in contact only in the others: with
   * an obstacle by ContactNode::support(), with another body only if the normal
   * is along them or the nodes are twins. With a single free direction there is
   * no friction.
   */
  class Contact
  {
  public:
    explicit Contact(const Unknowns &unknowns)
      : unknowns(unknowns)
    {}

    /** Sets the potential contacts of a step. Collective.
     *  @param prescribed contains the velocities of supports
     *  @throws StepFailure if a support acts on a node in contact with another
     *  body, or if two contacts squeeze a node along its only free direction */
    void
    begin_step(ContactStep step, const Vector &prescribed);

    /** Groups of nodes that are coupled in the Jacobian by contact between
     *  bodies. Each group is a contact node, followed by its partners. */
    std::vector<std::vector<unsigned int>>
    links() const;

    /**
     * Replaces the residual rows of contact nodes with the residuals F of the
     * contact equations. Forces r and residuals F are stored. Collective.
     * @param[in,out] residual in owned rows
     * @param scale the diagonal of the elastic Jacobian (kg/(m s))
     * @param with_friction whether friction is included
     * @param holds whether initially closed contacts are bilateral
     */
    void
    replace(Vector       &residual,
            const Vector &v,
            const Vector &scale,
            const bool    with_friction,
            const bool    holds);

    /** Replaces the Jacobian rows of contact nodes with the linearised contact
     *  equations. The matrices A and B are those of the last call to replace().
     *  Collective if obstacles are free.
     *  @return low-rank contribution of free obstacles */
    LowRank
    linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const;

    /** Applies the linearised contact equations to a Jacobian-vector product:
     *  dst = A dst + B dv in owned rows. The matrices A and B are those of the
     *  last call to replace(). Collective. @param dv with its ghosts */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** Residual norms, summed over active and potential contacts on this rank. */
    struct Sums
    {
      double of_errors = 0.; ///< sum of |F|^2 of the nodes ((N/m)^2)
      double of_bodies = 0.; ///< the same for free obstacles ((N/m)^2)
      double of_sizes  = 0.; ///< sum of the references NodalContact::size (N/m)
    };
    Sums
    sums() const
    {
      Sums sums;
      sums.of_bodies = body_error * body_error;
      for (const NodalContact &at : nodal_contact)
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

    /** Contact force and state of an owned node, computed by the last call to
     *  replace(). */
    struct NodalContact
    {
      dealii::Tensor<1, dim> force; ///< r, obstacle on body (N/m)
      State                  state = State::open;
      double                 error = 0.; ///< |F| (N/m)
      double size = 0.; ///< |r| + rho |u|, the reference for F (N/m)
      dealii::Tensor<1, dim> relative; ///< u, in free directions (m/s)
      double                 rho = 0.; ///< rho of F (kg/(m s))
    };

    /** @name Contact law of a node */
    /** @{ */
    using Force  = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    /** Contact force r, velocity v and augmentation parameter rho of a node, in its
     *  free directions. */
    struct Local
    {
      Force  r, v;
      double rho = 0.;
    };

    /** Parts of the contact law that act. */
    struct Law
    {
      bool with_friction = true;
      bool holds         = false; ///< closed contacts are bilateral
    };

    /** Contact force q of a node by the contact law, with the residual F = r -
     *  q and the derivative Q = dq/dp. The force q is the projection of p = r -
     *  rho (u - least n), with the relative velocity u. */
    struct Projection
    {
      Force  q, F;
      Matrix Q;
      State  state = State::open;
    };
    /** @param velocity of the obstacle or other body, in the free directions of
     *  the node */
    static Projection
    project(const ContactNode &node,
            const Local       &at,
            const Force       &velocity,
            const Law         &law);

    /** Adds the force on a node by an obstacle and its derivative to the sums of the
     *  obstacle, see ObstacleMotions::Sums. */
    static void
    add_to_obstacle(const ContactNode &node,
                    const double       rho,
                    const Projection  &at,
                    double            *sums);
    /** @} */

    /** @name Functions for ContactDirection */
    /** @{ */
    /** Selects the owned nodes that are in contact or close to contact. A node
     *  is close to contact if the largest contact force could close its gap.
     *  Contact states are those of the last call to replace(). Collective. */
    std::vector<unsigned int>
    choose(const MPI_Comm comm) const;

    /** Simplifies the left-hand side of the linearised contact equations to
     *  dr + rho du, at the chosen nodes. It is used by linearise(). The motions
     *  of the obstacles are fixed. Collective. */
    void
    relax(const std::vector<unsigned int> &chosen);

    bool
    is_owned(const ContactNode &node) const
    {
      return dim * node.node < row_A[0].locally_owned_size();
    }

    /** Corrects the initial guess for the velocities of free obstacles, used by
     *  the next call to replace(). */
    void
    change_motions(const Eigen::VectorXd &change)
    {
      obstacles.change(change);
    }

    /** Calls f(number, G) for each free rigid-body motion of the obstacle that
     *  is in contact with a node. G is B V of the node due to a unit motion. */
    template <typename Function>
    void
    for_motions_of(const ContactNode &node, const Function &f) const
    {
      if (!node.touches_body())
        obstacles.for_free(
          node.obstacle, [&](const unsigned int k, const unsigned int number) {
            f(number, node.of_obstacle * RigidMotion::of_point(k, node.arm));
          });
    }
    /** @} */

    const std::vector<ContactNode> &
    nodes() const
    {
      return list;
    }

    /** Contact forces and states, in the order of nodes(). Undefined for nodes
     *  that are not owned. */
    const std::vector<NodalContact> &
    nodal_contacts() const
    {
      return nodal_contact;
    }

    /** Returns true if a contact is closed or can carry tension. Tension requires
     *  that the contact was initially closed. */
    bool
    carries_load(const unsigned int i) const
    {
      return nodal_contact[i].state != State::open || list[i].tension > 0.;
    }

    /** Features of the contact problem that determine the solution strategy,
     *  reduced over all ranks. Collective. */
    ContactTraits
    traits(const MPI_Comm comm) const;

    /** Velocities of the obstacles at the last call to replace(). */
    const ObstacleMotions &
    motions() const
    {
      return obstacles;
    }

    /** Projects a vector onto the free directions of a node. */
    dealii::Tensor<1, dim>
    free_part(const dealii::Tensor<1, dim> &x, const unsigned int node) const;

  private:
    /** Augmentation parameter rho of a contact node (kg/(m s)). For obstacles rho
     *  = d_i, for a pair 1/rho = 1/d_i + sum P_ij^2/d_j, where d is the mean of
     *  IncrementalProblem::scale() at a node. The lighter body dominates,
     *  whichever of the two it is. */
    double
    rho_of(const ContactNode &node, const Vector &scale) const;

    /** Projects the velocity of a node onto the free directions of the node. */
    Force
    free_part(const Vector &v, const unsigned int node) const;

    /** Velocity of the other body at a contact node, projected onto the free
     *  directions of the node. @param v with ghosts */
    Force
    velocity_of_partners(const ContactNode &node, const Vector &v) const;

    /** Number of directions in which the motion of a node is not prescribed. */
    unsigned int
    n_free(const unsigned int node) const;

    /** Restricts a contact node to its free directions.
     *  @return whether it has contact
     *  @param[in,out] refusal reason if that is impossible */
    bool
    support(ContactNode  &node,
            const Vector &prescribed,
            std::string  &refusal) const;

    /** Appends a contact node to the list. Of two contacts of a node with the same
     *  normal one counts, others are a corner.
     *  @param[in,out] refusal reason if that is impossible */
    void
    append(ContactNode &node, std::string &refusal);

    /** Computes the tangents of a contact node. The normal must lie in the free
     *  directions. */
    void
    make_tangents(ContactNode &node) const;

    /** Combines two contacts of a node with non-parallel normals into a corner
     *  contact. */
    static void
    make_corner(ContactNode &a, ContactNode &b);

    /** Adds the contact forces r, distributed by the transposed weights P', to
     *  the residual rows of the partner nodes on other bodies. Collective. */
    void
    load_partners(Vector &residual) const;

    /** Adds the Jacobian rows of contact nodes, multiplied by the transposed
     *  weights P' of the partner nodes, to the rows of the partner nodes. */
    void
    add_rows_to_partners(SparseMatrix &matrix) const;

    /** Sums contact forces and their derivatives over the contact nodes of each
     *  obstacle. The sums are sum G' q, sum rho G' Q G and the sum of magnitudes,
     *  at the current motion of the obstacle. Collective. */
    std::vector<double>
    sums_of_nodes(const std::vector<Local> &locals, const MPI_Comm comm) const;

    /** Multiplies the Jacobian rows of a contact node by the matrix A of the
     *  linearised contact equations. */
    void
    combine_rows(const unsigned int node, SparseMatrix &matrix) const;

    /** Computes the low-rank contribution of free obstacles to the Jacobian.
     *  @param matrix before linearise() */
    LowRank
    low_rank(const SparseMatrix &matrix) const;

    const Unknowns           &unknowns;
    std::vector<ContactNode>  list;
    std::vector<NodalContact> nodal_contact;
    std::vector<Matrix>       rho_Q; ///< rho Q of owned nodes
    std::array<Vector, dim> row_A; ///< A by component of F, at the node's dofs
    ObstacleMotions         obstacles;
    bool                    has_pairs     = false; ///< ContactStep::has_pairs
    double                  body_error    = 0.;    ///< out of balance (N/m)
    Law                       law;                   ///< in the last replace()
    bool                    relaxed       = false; ///< relax() since replace()
  };
} // namespace geocone::GEOCONE_DIM

#endif
