// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_multipliers_h
#define geocone_conditions_multipliers_h

#include <geocone/space/space.h>

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  class Constraints;
  struct Unknowns;

  /**
   * General linear constraints H v = q on the free dofs, with multipliers lambda:
   * the forces H' lambda hold the body. The rows come from velocities at points,
   * H = A N, and may depend on each other (more points than functions): a pivoted
   * QR factorisation of H' keeps independent ones, and the others must agree
   * with them.
   */
  class Multipliers
  {
  public:
    /** What makes a row: a condition, its component, and a number of its own. */
    struct Key
    {
      unsigned int condition;
      unsigned int component;
      unsigned int number;
    };

    /** A row that cannot be fulfilled. */
    struct Refusal
    {
      Key    key;
      bool   is_supported; ///< else no function with mass is in it
      double asked = 0.;   ///< its target (m/s)
      double left  = 0.;   ///< what the rows that it depends on leave (m/s)
    };

    Multipliers() = default;

    /** Rows of one rank as data, without the conditions that made them. */
    Multipliers(const std::vector<unsigned int> &dofs,
                const Eigen::MatrixXd           &H,
                const Eigen::VectorXd           &q)
      : given(H.rows())
      , touched(dofs)
      , H(H)
      , q(q)
    {}

    void
    clear();

    /** Adds a coefficient of a node to a row, e.g. weight x N_i(x). */
    void
    add_coefficient(const Key                            &key,
                    const dealii::types::global_dof_index node,
                    const double                          value);

    /** Adds to the right-hand side q of a row. */
    void
    add_target(const Key &key, const double value);

    /** Adds to the right-hand side what is no prescribed velocity: mean_target() does
     *  not count it. */
    void
    add_offset(const Key &key, const double value);

    /**
     * Makes the rows from what all ranks have added. Prescribed dofs move to the
     * right-hand side; functions without mass are left out, and the remaining
     * coefficients of a row scaled so that its sum stays.
     * @param prescribed a vector that has the values of prescribed dofs
     * @return the first row that cannot be fulfilled, the same on all ranks, or
     * nothing. Collective.
     */
    std::optional<Refusal>
    assemble(const Space       &space,
             const Constraints &constraints,
             const Vector      &prescribed);

    /**
     * Adds, after all others, the row F.v/sum |F_i| = velocity of loads that are
     * raised, whose multiplier is the load factor times the sum, over the nodes, of the
     * sizes of their forces.
     * @param force F, with prescribed dofs, too @param prescribed as in assemble()
     * @return whether the loads can move the body. Collective.
     */
    bool
    add_loads(const Vector   &force,
              const double    velocity,
              const Unknowns &unknowns,
              const Vector   &prescribed);

    /** Whether the last row is that of raised loads. */
    bool
    has_loads() const
    {
      return sum_of_loads > 0.;
    }

    /** Their factor. */
    double
    load_factor(const Eigen::VectorXd &lambda) const
    {
      return lambda[lambda.size() - 1] / sum_of_loads;
    }

    /** Independent rows, and all that were given. */
    unsigned int
    n_rows() const
    {
      return H.rows();
    }
    unsigned int
    n_given() const
    {
      return given;
    }

    /** q - H v. Collective. */
    Eigen::VectorXd
    defect(const Vector &v) const;

    /** H f. Collective. */
    Eigen::VectorXd
    multiply(const Vector &f) const;

    /** f += factor H' lambda, in owned entries. */
    void
    add_transposed(Vector                &f,
                   const double           factor,
                   const Eigen::VectorXd &lambda) const;

    /**
     * D^{-1/2} H' = Q U of all ranks, Q with orthonormal columns, U upper
     * triangular. Rows that nearly depend on each other make U ill-conditioned,
     * but not Q: H D^{-1} H' = U'U would lose twice as many digits.
     */
    struct Factors
    {
      Eigen::VectorXd root; ///< D^{1/2} of the touched dofs
      Eigen::MatrixXd Q;    ///< rows of the touched dofs
      Eigen::MatrixXd U;
    };

    /** @param scale D, or null for 1. Collective. */
    Factors
    factorise(const Vector *scale) const;

    /**
     * Takes the forces H' lambda that leave the least residual,
     *   min_lambda sum_i (R - H' lambda)_i^2 / D_i over the touched dofs,
     * out of a residual R. What is left is accurate to the rounding of R, however
     * large the lambda of rows are that nearly depend on each other.
     * @return lambda. Collective.
     */
    Eigen::VectorXd
    remove(Vector &residual, const Factors &factors) const;

    /** Sum of the forces H' lambda of a condition along a component (N/m). */
    double
    resultant(const Eigen::VectorXd &lambda,
              const unsigned int     condition,
              const unsigned int     component) const;

    /** Moment of the forces H' lambda of a condition about a point (N m/m). Collective. */
    dealii::Tensor<1, n_rotations>
    moment(const Eigen::VectorXd    &lambda,
           const unsigned int        condition,
           const dealii::Point<dim> &centre,
           const Space              &space) const;

    /** By how much a row rests on functions that hold hardly any mass. */
    struct LightShare
    {
      double             largest   = 0.; ///< of the rows
      unsigned int       condition = 0;  ///< its condition
      dealii::Point<dim> place; ///< of the function with the largest part in it
    };

    /**
     * |sum_light H_i v_i| of the worst row over sum_i H_i times the velocity that its
     * condition asks for along x or y, light functions being those with less than
     * 1e-3 of the largest mass in the row: 0.02 in sound steps, more than 1 where
     * the row is fulfilled by a jet. Collective.
     */
    LightShare
    light_share(const Vector &v, const Vector &mass, const Space &space) const;

    /** Mean of the velocities that a condition asks for, or 0. */
    double
    mean_target(const unsigned int condition,
                const unsigned int component) const;

    /** Owned local dofs that rows touch, and their coefficients per row. */
    const std::vector<unsigned int> &
    dofs() const
    {
      return touched;
    }
    const Eigen::MatrixXd &
    coefficients() const
    {
      return H;
    }

    /** q, without what prescribed dofs contribute. */
    const Eigen::VectorXd &
    targets() const
    {
      return q;
    }

  private:
    void
    contribute(const Key &key, const double node, const double value);

    /** condition, component, number, node (-1: target, -2: offset), value. */
    std::vector<std::array<double, 5>> contributions;

    MPI_Comm         comm         = MPI_COMM_SELF;
    unsigned int     given        = 0;
    double           sum_of_loads = 0.; ///< of raised loads (N/m), or 0
    std::vector<Key> keys;
    std::vector<unsigned int> touched;
    Eigen::MatrixXd           H;
    Eigen::VectorXd           q; ///< without what prescribed dofs contribute
    Eigen::VectorXd           row_sum;

    /** Of a row that was given: its right-hand side without offset and the sum of its
     *  N. */
    struct Asked
    {
      Key    key;
      double target, weight;
    };
    std::vector<Asked> asked;
  };
} // namespace geocone::GEOCONE_DIM

#endif
