// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_condensed_contact_h
#define geocone_contact_condensed_contact_h

#include <Eigen/Dense>

#include <vector>

namespace geocone
{
  /**
   * Frictional contact of n nodes with a linear body whose other unknowns are
   * eliminated: find u, r = K u + c with
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
      unsigned int first      = 0; ///< of its components in u and r: u_N, u_T
      unsigned int n_tangents = 0; ///< 0 for nodes without friction

      double least    = 0.; ///< (m/s)
      double friction = 0.; ///< mu
      double adhesion = 0.; ///< additional, while closed (N/m)
      double tension  = 0.; ///< largest tension, at most adhesion/mu (N/m)
    };

    Eigen::MatrixXd   K;
    Eigen::VectorXd   c; ///< (N/m)
    std::vector<Node> nodes;

    /**
     * Solves the contact problem.
     * @param[in,out] u in: initial guess; out: the solution, or the last
     * iterate (m/s)
     * @return whether it is solved within rounding
     */
    bool
    solve(Eigen::VectorXd &u) const;

    /** Largest violation of the laws at a node, by the root functions of
     *  Contact, over the largest force. */
    double
    error(const Eigen::VectorXd &u) const;

  private:
    /** Rounding error of K u in error(). */
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

      /** Slip direction d of r_T, and the derivative of d times the bound with
       *  respect to r_T - rho u_T: zero with one tangent. */
      Eigen::VectorXd direction;
      Eigen::MatrixXd turn;

      /** Whether both lead to the same equations. */
      bool
      operator==(const State &other) const
      {
        return contact == other.contact && turn.size() == other.turn.size() &&
               direction == other.direction && turn == other.turn;
      }
    };

    /** Contact states by u and r. */
    std::vector<State>
    states(const Eigen::VectorXd &u) const;

    /** u that satisfies the equations of all these states. */
    Eigen::VectorXd
    solve_for(const std::vector<State> &state) const;

    /** Gauss-Seidel sweep over the nodes. @return the largest change of a force
     *  over the largest force */
    double
    sweep(Eigen::VectorXd &u) const;

    /** Vector of at most a normal and two tangential components of a node. */
    using OfNode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

    /** rho of the tangents: the mean of their stiffness. */
    double
    tangential_rho(const Node &node) const;

    /** Solves for u of one node, with the others fixed. @param b r for u = 0 at
     *  this node */
    OfNode
    solve_node(const Node &node, const OfNode &b) const;
  };
} // namespace geocone

#endif
