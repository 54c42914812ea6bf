// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_condensed_contact_h
#define geocone_contact_condensed_contact_h

#include <Eigen/Dense>

#include <vector>

namespace geocone
{
  /**
   * The laws of contact with friction of n nodes on what is left of a linear body when
   * all other unknowns are eliminated: find u, r = K u + c with
   *   0 <= r_N + tension _|_ u_N - least >= 0,
   *   |r_T| <= mu r_N + adhesion, u_T against r_T where it slides,
   * in the axes n and t of each node, or in n alone. K (kg/(m s)) is dense
   * and small.
   *
   * An active set, by linear systems, ends at the solution in a few steps where it does
   * not go round in circles: from the start, from nodes that all stick, and from where
   * sweeps of Gauss and Seidel lead, which solve node after node exactly. With two
   * tangents, in three dimensions, it is Newton's method for the way in which nodes slide.
   */
  struct CondensedContact
  {
    struct Node
    {
      unsigned int first      = 0; ///< of its components in u and r: u_N, u_T
      unsigned int n_tangents = 0; ///< of these without friction none

      double least    = 0.; ///< (m/s)
      double friction = 0.; ///< mu
      double adhesion = 0.; ///< borne besides while closed (N/m)
      double tension  = 0.; ///< the largest pull, at most adhesion/mu (N/m)
    };

    Eigen::MatrixXd   K;
    Eigen::VectorXd   c; ///< (N/m)
    std::vector<Node> nodes;

    /**
     * @param[in,out] u in: a start; out: the solution, or the last iterate (m/s)
     * @return whether it is solved to rounding
     */
    bool
    solve(Eigen::VectorXd &u) const;

    /** The largest of what the laws lack at a node, over the largest force: of the root
     *  functions of Contact. */
    double
    error(const Eigen::VectorXd &u) const;

  private:
    /** What of error() may be rounding of K u. */
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

      /** Of a node that slides: the direction d of r_T, and what d changes by times the
       *  bound, per r_T - rho u_T: zero with one tangent. */
      Eigen::VectorXd direction;
      Eigen::MatrixXd turn;

      /** Whether both ask for the same equations. */
      bool
      operator==(const State &other) const
      {
        return contact == other.contact && turn.size() == other.turn.size() &&
               direction == other.direction && turn == other.turn;
      }
    };

    /** The states that u and r show. */
    std::vector<State>
    states(const Eigen::VectorXd &u) const;

    /** u where the states hold, all of them by equations. */
    Eigen::VectorXd
    solve_for(const std::vector<State> &state) const;

    /** A sweep over the nodes. @return the largest change of a force over the largest
     *  force */
    double
    sweep(Eigen::VectorXd &u) const;

    /** Of a node at most: its normal and two tangents. */
    using OfNode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

    /** rho of the tangents: the mean of their stiffness. */
    double
    tangential_rho(const Node &node) const;

    /** u of a node for which the others are as they are. @param b r at u = 0 of it */
    OfNode
    solve_node(const Node &node, const OfNode &b) const;
  };
} // namespace geocone

#endif
