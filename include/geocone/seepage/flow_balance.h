// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_balance_h
#define geocone_seepage_flow_balance_h

#include <geocone/linear/linear_solver.h>
#include <geocone/seepage/flow_solution.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Equations of a flow: the balance of water of each vertex of a mesh, a
   *  piecewise smooth function of one variable s per vertex. */
  class FlowBalance
  {
  public:
    virtual ~FlowBalance() = default;

    /** Imbalance of each vertex at s (m^2/s). */
    virtual std::vector<double>
    residual(const std::vector<double> &s) = 0;

    /** Derivative of residual() at its last argument. */
    virtual const SparseMatrix &
    derivative() = 0;

    /** Largest entry of a residual over the flow through the vertex's edges. */
    double
    error(const std::vector<double> &r) const;

    const SparseMatrix &
    derivative_pattern() const
    {
      return matrix;
    }

    /** Flow into the body at each vertex at the last argument of residual(). */
    std::vector<double> inflow;

  protected:
    using Kind = FlowConditions::Kind;

    FlowBalance(const Triangles                                  &triangles,
                const std::vector<dealii::SymmetricTensor<2, 2>> &permeability,
                const std::vector<double>                        &measure,
                const FlowConditions                             &conditions);

    /** Balance at vertices with a prescribed head, and flow through the
     *  boundary at the others.
     *  @param[in,out] r net flow through the edges less the rate of storage
     *  @param outflow of seepage faces (m^2/s) */
    void
    add_boundary(const std::vector<double> &s,
                 const std::vector<double> &outflow,
                 std::vector<double>       &r);

    /** Sets the derivative to that of add_boundary(). @param doutflow
     *  derivative of the outflow by s */
    void
    begin_derivative(const std::vector<double> &doutflow);

    /** Adds to the derivative, except in rows of prescribed heads. */
    void
    add(const unsigned int row, const unsigned int column, const double value)
    {
      if (conditions.kind[row] != Kind::head)
        matrix.value[matrix.entry(row, column)] += value;
    }

    const FlowConditions               &conditions;
    const unsigned int                  n;
    const std::vector<Triangles::Edge> &edges;
    std::vector<double>                 conductance; ///< of edges (m/s)
    std::vector<double> diagonal; ///< sums of absolute conductances
    std::vector<double> y, scale;
    double              height = 0.;
    SparseMatrix        matrix;

  private:
    void
    set_pattern();
  };

  /** Conductance T_ij of the edge of a cell opposite to its vertex i, without
   *  the relative permeability (m/s). */
  double
  edge_conductance(const Triangles                     &triangles,
                   const dealii::SymmetricTensor<2, 2> &permeability,
                   const double                         measure,
                   const unsigned int                   cell,
                   const unsigned int                   i);

  /** Nonsmooth Newton method with a line search.
   *  @param wanted error, or that of rounding if it is at most 1e-10
   *  @param[in,out] flow its s, iterations and error
   *  @return whether it has converged */
  bool
  iterate(FlowBalance       &balance,
          LinearSolver      &solver,
          const unsigned int most_iterations,
          const double       wanted,
          FlowSolution      &flow);
} // namespace geocone::GEOCONE_DIM

#endif
