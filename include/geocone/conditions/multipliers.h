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
   * General linear constraints H v = q on the free dofs, with multipliers
   * lambda: H' lambda are the constraint forces on the body. The rows prescribe
   * velocities at points, H = A N, and may be linearly dependent (more points
   * than functions): a pivoted QR factorisation of H' selects independent rows,
   * with which the others must agree.
   */
  class Multipliers
  {
  public:
    /** Identifies a row: condition, component, and a number within them. */
    struct Key
    {
      unsigned int condition;
      unsigned int component;
      unsigned int number;
    };

    /** A row that cannot be satisfied. */
    struct Refusal
    {
      Key    key;
      bool   is_supported; ///< false if the row contains no function with mass
      double asked = 0.;   ///< its target (m/s)
      double left  = 0.;   ///< value by the rows on which it depends (m/s)
    };

    Multipliers() = default;

    /** Constraints of one rank, given by their matrices. */
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

    /** Adds a term to the right-hand side that is not a prescribed velocity and
     *  is excluded from mean_target(). */
    void
    add_offset(const Key &key, const double value);

    /**
     * Assembles the rows from the contributions of all ranks. Prescribed dofs
     * move to the right-hand side. Functions without mass are omitted, and the
     * remaining coefficients of a row are scaled to preserve its sum.
     * @param prescribed a vector that contains the values of prescribed dofs
     * @return the first row that cannot be satisfied, the same on all ranks, or
     * nothing. Collective.
     */
    std::optional<Refusal>
    assemble(const Space       &space,
             const Constraints &constraints,
             const Vector      &prescribed);

    /**
     * Adds, as the last row, F.v/sum |F_i| = velocity for load stepping. Its
     * multiplier is the load factor times the sum, over the nodes, of the
     * magnitudes of their forces.
     * @param force F, including prescribed dofs @param prescribed as in
     * assemble()
     * @return whether the loads can move the body. Collective.
     */
    bool
    add_loads(const Vector   &force,
              const double    velocity,
              const Unknowns &unknowns,
              const Vector   &prescribed);

    /** Whether the last row controls a load factor. */
    bool
    has_loads() const
    {
      return sum_of_loads > 0.;
    }

    /** Load factor, from the multiplier of the last row. */
    double
    load_factor(const Eigen::VectorXd &lambda) const
    {
      return lambda[lambda.size() - 1] / sum_of_loads;
    }

    /** Number of independent rows, and of all rows given. */
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

    /** Defect q - H v. Collective. */
    Eigen::VectorXd
    defect(const Vector &v) const;

    /** Product H f. Collective. */
    Eigen::VectorXd
    multiply(const Vector &f) const;

    /** Adds factor H' lambda to f, in owned entries. */
    void
    add_transposed(Vector                &f,
                   const double           factor,
                   const Eigen::VectorXd &lambda) const;

    /**
     * QR factorisation D^{-1/2} H' = Q U over all ranks, Q with orthonormal
     * columns, U upper triangular. Nearly dependent rows make U
     * ill-conditioned, but not Q: H D^{-1} H' = U'U would lose twice as many
     * digits.
     */
    struct Factors
    {
      Eigen::VectorXd root; ///< D^{1/2} of the dofs involved
      Eigen::MatrixXd Q;    ///< rows of the dofs involved
      Eigen::MatrixXd U;
    };

    /** Factorises H'. @param scale D, or null for 1. Collective. */
    Factors
    factorise(const Vector *scale) const;

    /**
     * Removes from a residual R the forces H' lambda that minimise
     *   sum_i (R - H' lambda)_i^2 / D_i over the dofs involved.
     * The result is accurate to the rounding of R, however large the
     * multipliers of nearly dependent rows.
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

    /** Contribution of low-mass functions to a row. */
    struct LightShare
    {
      double             largest   = 0.; ///< over all rows
      unsigned int       condition = 0;  ///< its condition
      dealii::Point<dim> place;          ///< of the function of largest share
    };

    /**
     * Share of low-mass functions in the worst row: |sum_light H_i v_i| over
     * sum_i H_i times the velocity prescribed by its condition along x or y.
     * Functions with less than 1e-3 of the largest mass in the row are
     * low-mass. The share is 0.02 in sound steps, and above 1 if spurious
     * velocities satisfy the row. Collective.
     */
    LightShare
    light_share(const Vector &v, const Vector &mass, const Space &space) const;

    /** Mean of the velocities prescribed by a condition, or 0. */
    double
    mean_target(const unsigned int condition,
                const unsigned int component) const;

    /** Owned local dofs involved in rows, and their coefficients per row. */
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

    /** Right-hand side q, less contributions of prescribed dofs. */
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
    double           sum_of_loads = 0.; ///< of load stepping (N/m), or 0
    std::vector<Key> keys;
    std::vector<unsigned int> touched;
    Eigen::MatrixXd           H;
    Eigen::VectorXd           q; ///< less contributions of prescribed dofs
    Eigen::VectorXd           row_sum;

    /** Right-hand side of a given row without offset, and the sum of its N. */
    struct Asked
    {
      Key    key;
      double target, weight;
    };
    std::vector<Asked> asked;
  };
} // namespace geocone::GEOCONE_DIM

#endif
