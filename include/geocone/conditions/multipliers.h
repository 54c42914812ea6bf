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
   * Linear constraints H v = q on the free dofs, imposed by Lagrange multipliers
   * lambda. The constraint forces on the body are H' lambda. The rows prescribe
   * velocities at points, H = A N, and may be linearly dependent (more points than
   * basis functions): a pivoted QR factorisation of H' selects independent rows, and
   * all other rows must be consistent with these.
   */
  class Multipliers
  {
  public:
    /** Key of a constraint row: boundary condition, velocity component and
     *  consecutive number. */
    struct Key
    {
      unsigned int condition;
      unsigned int component;
      unsigned int number;
    };

    /** A constraint row that cannot be satisfied. */
    struct Refusal
    {
      Key    key;
      bool   is_supported;    ///< whether a basis function of the row has mass
      double prescribed = 0.; ///< prescribed right-hand side q (m/s)
      double implied    = 0.; ///< q implied by the independent rows (m/s)
    };

    Multipliers() = default;

    /** Creates constraints H v = q on one rank from given H and q. */
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

    /** Adds the coefficient of a node (e.g. a weight times the shape function
     *  N_i) to a row of the constraint matrix H. */
    void
    add_coefficient(const Key                            &key,
                    const dealii::types::global_dof_index node,
                    const double                          value);

    /** Adds a prescribed velocity to the right-hand side q of a constraint row. */
    void
    add_target(const Key &key, const double value);

    /** Adds a term other than a prescribed velocity to the right-hand side q of a
     *  constraint row. The term is excluded from mean_target(). */
    void
    add_offset(const Key &key, const double value);

    /**
     * Assembles the constraint rows from the contributions of all ranks. Prescribed
     * dofs move to the right-hand side. Basis functions without mass are omitted,
     * and the remaining coefficients of a row are scaled to preserve their sum.
     * @param prescribed a vector that contains the values of prescribed dofs
     * @return the first row that cannot be satisfied, the same on all ranks, or
     * nothing. Collective.
     */
    std::optional<Refusal>
    assemble(const Space       &space,
             const Constraints &constraints,
             const Vector      &prescribed);

    /**
     * Appends the constraint row F.v/sum |F_i| = velocity for the loads F in
     * load stepping. The multiplier of this row is the load factor times the
     * sum of the magnitudes |F_i| of the nodal forces.
     * @param force F, including prescribed dofs @param prescribed as in
     * assemble()
     * @return whether the loads can move the body. Collective.
     */
    bool
    add_loads(const Vector   &force,
              const double    velocity,
              const Unknowns &unknowns,
              const Vector   &prescribed);

    /** Returns true if the last constraint row controls the load factor, see
     *  add_loads(). */
    bool
    has_loads() const
    {
      return sum_of_loads > 0.;
    }

    /** Load factor, computed from the Lagrange multiplier of the last constraint
     *  row. */
    double
    load_factor(const Eigen::VectorXd &lambda) const
    {
      return lambda[lambda.size() - 1] / sum_of_loads;
    }

    /** Number of linearly independent constraint rows. The number of all
     *  constraint rows is n_given(). */
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

    /** Residual q - H v of the constraints (m/s). Collective. */
    Eigen::VectorXd
    defect(const Vector &v) const;

    /** Matrix-vector product H f with the constraint matrix H. Collective. */
    Eigen::VectorXd
    multiply(const Vector &f) const;

    /** Adds the constraint forces H' lambda, multiplied by @p factor, to the
     *  owned entries of f. */
    void
    add_transposed(Vector                &f,
                   const double           factor,
                   const Eigen::VectorXd &lambda) const;

    /**
     * QR factorisation D^{-1/2} H' = Q U of the transposed constraint matrix
     * H', scaled by the diagonal matrix D. Q has orthonormal columns,
     * distributed over all ranks, and U is upper triangular. Nearly dependent
     * rows make U ill-conditioned, but not Q: H D^{-1} H' = U'U would lose
     * twice as many digits.
     */
    struct Factors
    {
      Eigen::VectorXd root; ///< D^{1/2}, in the order of dofs()
      Eigen::MatrixXd Q;    ///< rows in the order of dofs()
      Eigen::MatrixXd U;
    };

    /** Computes the QR factorisation of the scaled, transposed constraint
     *  matrix D^{-1/2} H'. Collective.
     *  @param scale D, or null for the identity */
    Factors
    factorise(const Vector *scale) const;

    /**
     * Subtracts the constraint forces H' lambda (lambda: Lagrange multipliers)
     * from a residual R. The multipliers lambda minimise
     *   sum_i (R - H' lambda)_i^2 / D_i over dofs().
     * The result is accurate to the rounding of R, however large the
     * multipliers of nearly dependent rows.
     * @return lambda. Collective.
     */
    Eigen::VectorXd
    remove(Vector &residual, const Factors &factors) const;

    /** Resultant constraint force of a boundary condition in one coordinate
     *  direction (N/m). */
    double
    resultant(const Eigen::VectorXd &lambda,
              const unsigned int     condition,
              const unsigned int     component) const;

    /** Resultant moment of the constraint forces of a boundary condition about a
     *  given point (N m/m). Collective. */
    dealii::Tensor<1, n_rotations>
    moment(const Eigen::VectorXd    &lambda,
           const unsigned int        condition,
           const dealii::Point<dim> &centre,
           const Space              &space) const;

    /** Largest relative contribution of basis functions with little mass to a
     *  velocity constraint. */
    struct LowMassShare
    {
      double             largest   = 0.; ///< maximum over all rows (-)
      unsigned int       condition = 0;  ///< condition of the row
      dealii::Point<dim> place;          ///< of the largest term (m)
    };

    /**
     * Returns the largest relative contribution of low-mass basis functions to
     * a velocity constraint. The contribution is |sum_light H_i v_i|, divided
     * by sum_i H_i times the larger of the velocities that the condition
     * prescribes along x and y. Basis functions with less than 1e-3 of the
     * largest mass in the row are low-mass. The ratio is 0.02 in sound steps,
     * and above 1 if spurious velocities satisfy the row. Collective.
     */
    LowMassShare
    low_mass_share(const Vector &v,
                   const Vector &mass,
                   const Space  &space) const;

    /** Mean velocity component prescribed by a boundary condition (m/s). Zero if
     *  none is prescribed. */
    double
    mean_target(const unsigned int condition,
                const unsigned int component) const;

    /** Owned local dofs with nonzero constraint coefficients, in the column order
     *  of coefficients(). */
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

    /** Right-hand side q of the constraints minus the contributions of prescribed
     *  dofs (m/s). */
    const Eigen::VectorXd &
    targets() const
    {
      return q;
    }

  private:
    void
    contribute(const Key &key, const double node, const double value);

    /** Coefficients and right-hand sides that this rank contributes to the
     *  constraint rows. Each contains the condition, component, number, node
     *  (-1: target, -2: offset) and value. */
    std::vector<std::array<double, 5>> contributions;

    MPI_Comm         comm         = MPI_COMM_SELF;
    unsigned int     given        = 0;
    double           sum_of_loads = 0.; ///< sum |F_i|, see add_loads() (N/m)
    std::vector<Key> keys;
    std::vector<unsigned int> touched;
    Eigen::MatrixXd           H;
    Eigen::VectorXd           q; ///< minus terms of prescribed dofs (m/s)
    Eigen::VectorXd           row_sum;

    /** Prescribed velocity and sum of coefficients of a constraint row. The
     *  offset is excluded. */
    struct Asked
    {
      Key    key;
      double target, weight;
    };
    std::vector<Asked> asked;
  };
} // namespace geocone::GEOCONE_DIM

#endif
