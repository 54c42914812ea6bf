// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_condensed_contact_h
#define geocone_contact_condensed_contact_h

#include <Eigen/Dense>

#include <vector>

namespace geocone
{
  /**
   * Frictional contact problem of n nodes, after static condensation of all
   * other unknowns of a linear body. Find u and r = K u + c with
   *   0 <= r_N + tension _|_ u_N - least >= 0,
   *   |r_T| <= mu r_N + adhesion, u_T against r_T where it slides,
   * in the axes n and t of each node, or in n alone if it has no friction. K
   * (kg/(m s)) is dense and small.
   *
   * An active-set method, which solves linear systems, reaches the solution in
   * a few steps unless it cycles. It starts from the given state, from all
   * nodes sticking, and from the result of Gauss-Seidel sweeps, which solve
   * node after node exactly. With two tangents, in three dimensions, it is
   * Newton's method for the slip directions.
   */
  struct CondensedContact
  {
    struct Node
    {
      unsigned int first      = 0; ///< index of u_N in u (and r); u_T follows
      unsigned int n_tangents = 0; ///< 0 for nodes without friction

      double least    = 0.; ///< lower bound on u_N (m/s)
      double friction = 0.; ///< friction coefficient mu
      double adhesion = 0.; ///< shear strength at r_N = 0, if closed (N/m)
      double tension  = 0.; ///< tensile strength, <= adhesion/mu (N/m)
    };

    Eigen::MatrixXd   K;
    Eigen::VectorXd   c; ///< forces r at u = 0 (N/m)
    std::vector<Node> nodes;

    /**
     * Solves the contact problem for the velocities u.
     * @param[in,out] u in: initial guess; out: the solution, or the last
     * iterate (m/s)
     * @return whether the problem is solved within rounding
     */
    bool
    solve(Eigen::VectorXd &u) const;

    /** Largest nodal residual of the contact laws, divided by the largest contact
     *  force. The residual is the function F of Contact. */
    double
    error(const Eigen::VectorXd &u) const;

  private:
    /** Estimates the contribution of rounding errors in the product K u to the
     *  relative residual error(). */
    double
    rounding(const Eigen::VectorXd &u) const;

    enum class Contact
    {
      open,
      stick,
      slip
    };
    struct State
    {
      Contact contact = Contact::open;

      /** Unit vector in the direction of the tangential contact force during
       *  slip. The matrix `direction_derivative` is the derivative of d with respect to r_T -
       *  rho u_T, times the friction bound; it is zero for one tangent. */
      Eigen::VectorXd direction;
      Eigen::MatrixXd direction_derivative;

      /** Returns true if two contact states lead to the same linear
       *  equations. */
      bool
      operator==(const State &other) const
      {
        return contact == other.contact &&
               direction_derivative.size() ==
                 other.direction_derivative.size() &&
               direction == other.direction &&
               direction_derivative == other.direction_derivative;
      }
    };

    /** Predicts the contact states of all nodes from their velocities u and
     *  contact forces r = K u + c. */
    std::vector<State>
    states(const Eigen::VectorXd &u) const;

    /** Solves the linear system for the velocities u, with given contact states
     *  of the nodes. */
    Eigen::VectorXd
    solve_for(const std::vector<State> &state) const;

    /** Performs a Gauss-Seidel sweep over the nodes.
     *  @return the largest change of a force, divided by the largest force */
    double
    sweep(Eigen::VectorXd &u) const;

    /** Nodal vector with one normal and at most two tangential components. */
    using OfNode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

    /** Augmentation parameter rho of the friction equations: mean tangential
     *  stiffness of the node. */
    double
    tangential_rho(const Node &node) const;

    /** Solves the contact problem of one node, with the velocities of all other
     *  nodes fixed.
     *  @param b force r at the node for u = 0 at the node
     *  @return u at the node */
    OfNode
    solve_node(const Node &node, const OfNode &b) const;
  };
} // namespace geocone

#endif
