// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_contact_h
#define geocone_mechanics_contact_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/mechanics/jacobian_pattern.h>
#include <geocone/mechanics/unknowns.h>

#include <array>
#include <vector>

namespace geocone
{
  /** A node that may touch an obstacle in a step. */
  struct ContactNode
  {
    unsigned int           node;     ///< local, also a ghost
    unsigned int           obstacle; ///< its number
    dealii::Tensor<1, dim> normal;   ///< out of the obstacle
    dealii::Tensor<1, dim> velocity; ///< of the obstacle (m/s)

    /** Least relative normal velocity: -g/h for a gap g, or -e u_N of the beginning
     *  where the node rebounds (m/s). */
    double least = 0.;

    double friction = 0.; ///< mu
    double adhesion = 0.; ///< borne besides friction, while closed (N/m)
  };

  /**
   * Unilateral contact with friction of nodes and rigid obstacles, without an
   * unknown of its own. In the rows of a node that may touch, the residual R(v) of
   * the momentum balance is the force r that the obstacle exerts. Signorini's and
   * Coulomb's laws for it and the relative velocity u,
   *   0 <= r_N  _|_  w_N = u_N - least >= 0,
   *   |r_T| <= mu r_N + c,  and u_T against r_T where it slides,
   * are the roots of (Alart and Curnier 1991, for any rho > 0)
   *   F_N = r_N - q,                     q = max(r_N - rho w_N, 0),
   *   F_T = r_T - [r_T - rho u_T] in +-b,  b = mu q + c (c = 0 where q = 0),
   * which takes the place of R in these rows, so that one Newton iteration solves
   * for plasticity and contact. dF = A dr + B dv: rows of the Jacobian are
   * combined by the 2 x 2 matrices A, and B comes to the diagonal; both are the
   * identity's multiples or zero but for sliding nodes. rho is the node's mean of
   * IncrementalProblem::scale().
   *
   * A node that a support holds in one direction is in contact only in the other
   * one, without friction.
   */
  class Contact
  {
  public:
    explicit Contact(const Unknowns &unknowns)
      : unknowns(unknowns)
    {}

    /** @param nodes all that this rank knows, with ghosts, each once */
    void
    begin_step(std::vector<ContactNode> nodes);

    /**
     * Replaces the forces r in the rows of contact by F, and keeps both.
     * @param[in,out] residual in owned rows
     * @param scale the diagonal of the elastic Jacobian (kg/(m s)). Collective.
     */
    void
    replace(Vector &residual, const Vector &v, const Vector &scale);

    /** A and B of the last replace() in place of the Jacobian's rows. */
    void
    linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const;

    /** The same for a product: dst = A dst + B dv, in owned rows. */
    void
    apply_tangent(Vector &dst, const Vector &dv) const;

    /** The sum of |F|^2 on this rank: what obstacles ask of a body at rest is a part of
     *  the residual that it is compared with. */
    double
    size() const
    {
      double square = 0.;
      for (const Touch &at : touch)
        square += at.error * at.error;
      return square;
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
    };

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

    /** The free direction of a node: 0 or 1 where a support holds the other one, 2
     *  where both are free, and nothing (3) where none is. */
    unsigned int
    free_direction(const unsigned int node) const;

  private:
    using Matrix = std::array<std::array<double, dim>, dim>;

    const Unknowns          &unknowns;
    std::vector<ContactNode> list;
    std::vector<Touch>       touch;
    std::vector<Matrix>      B;     ///< of owned ones
    std::array<Vector, dim>  row_A; ///< by component of F, at the node's dofs
  };
} // namespace geocone

#endif
