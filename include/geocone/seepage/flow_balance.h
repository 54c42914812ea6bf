// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_balance_h
#define geocone_seepage_flow_balance_h

#include <geocone/linear/linear_solver.h>
#include <geocone/seepage/flow_solution.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Nonlinear equations of a flow problem: the water balance of each vertex of
   *  a mesh. The balance is a piecewise smooth function of one variable s per
   *  vertex. */
  class FlowBalance
  {
  public:
    virtual ~FlowBalance() = default;

    /** Residual of the water balance of each vertex at s (m^2/s). */
    virtual std::vector<double>
    residual(const std::vector<double> &s) = 0;

    /** Jacobian matrix of residual() at the last argument of residual(). */
    virtual const SparseMatrix &
    derivative() = 0;

    /** Maximum norm of the residual r (-). Each entry is divided by the sum of
     *  the absolute flow rates through the edges of the vertex. */
    double
    error(const std::vector<double> &r) const;

    const SparseMatrix &
    derivative_pattern() const
    {
      return matrix;
    }

    /** Inflow through the boundary at each vertex (m^2/s), at the last argument
     *  of residual(). */
    std::vector<double> inflow;

  protected:
    using Kind = FlowConditions::Kind;

    FlowBalance(
      const FlowMesh                                     &mesh,
      const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
      const std::vector<double>                          &measure,
      const FlowConditions                               &conditions);

    /** Adds the flow through the boundary to the residual, and replaces the
     *  residual at vertices with a prescribed head.
     *  @param outflow of seepage faces (m^2/s)
     *  @param[in,out] r net flow through the edges less the rate of storage */
    void
    add_boundary(const std::vector<double> &s,
                 const std::vector<double> &outflow,
                 std::vector<double>       &r);

    /** Initialises the Jacobian matrix with the contributions of
     *  add_boundary(). @param doutflow derivative of the outflow by s */
    void
    begin_derivative(const std::vector<double> &doutflow);

    /** Adds a value to an entry of the Jacobian matrix, except in rows of
     *  prescribed heads. */
    void
    add(const unsigned int row, const unsigned int column, const double value)
    {
      if (conditions.kind[row] != Kind::head)
        matrix.value[matrix.entry(row, column)] += value;
    }

    const FlowConditions                           &conditions;
    const unsigned int                              n;
    const std::vector<std::array<unsigned int, 2>> &connections;
    std::vector<double> conductance; ///< of connections (m/s)
    std::vector<double> diagonal;    ///< sums of absolute conductances
    std::vector<double> y, scale;
    double              height = 0.;
    SparseMatrix        matrix;

  private:
    void
    set_pattern();
  };

  /** Conductance T_ij of connection i of a cell, without the relative
   *  permeability (m/s; m^2/s in three dimensions). */
  double
  edge_conductance(const FlowMesh                        &mesh,
                   const dealii::SymmetricTensor<2, dim> &permeability,
                   const double                           measure,
                   const unsigned int                     cell,
                   const unsigned int                     i);

  /** Solves the equations of a flow problem by a nonsmooth Newton method with a
   *  line search.
   *  @param wanted error(); where rounding prevents it, at most 1e-10 is
   *  accepted
   *  @param[in,out] flow s, iterations and error
   *  @param smallest_step of the line search, as a part of Newton's step; 1: none
   *  @return true if the method has converged */
  bool
  iterate(FlowBalance       &balance,
          LinearSolver      &solver,
          const unsigned int most_iterations,
          const double       wanted,
          FlowSolution      &flow,
          const double       smallest_step = 1. / 64.);
} // namespace geocone::GEOCONE_DIM

#endif
