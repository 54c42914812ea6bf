// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_pore_pressures_h
#define geocone_terms_pore_pressures_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/base/state_row.h>
#include <geocone/space/space.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Water balance of consolidating soil in a time step. */
  struct WaterBalance
  {
    double outflow     = 0.; ///< rate through the drained sides (m^2/s)
    double error       = 0.; ///< relative error of the balance (-)
    double dissipation = 0.; ///< energy dissipated by seepage (J/m)

    void
    state(StateRow &row)
    {
      row(outflow, error, dissipation);
    }
  };

  /**
   * Interface of excess pore pressures p that are unknowns of an implicit step.
   * They satisfy linear equations, so that p(v) is a linear function of the
   * nodal velocities v, and the residual R(v) includes the forces -G p(v).
   * Newton's method solves the coupled system
   *   [K -G; -G' -A/h] (dv, dp) = (-R, 0),   A p = f - h G' v.
   * It is Newton's method for the unknowns v and p, whose iterates satisfy the
   * water balance.
   */
  class PorePressures
  {
  public:
    virtual ~PorePressures() = default;

    /** Prepares the water balance of a step of size h (s). Collective. */
    virtual void
    begin_step(const double h) = 0;

    /** Computes the pressures p(v). @param v with its ghosts. Collective. */
    virtual void
    update(const Vector &v) = 0;

    /** Excess pore pressure at a point, from the last call to update()
     *  (Pa). */
    virtual double
    at(const unsigned int point) const = 0;

    /** Derivative -dp/dtr(e) of the pressure at a point by its volumetric strain,
     *  at given pressures of the vertices (Pa). Internal forces add it to the
     *  stiffness matrix. */
    virtual double
    fluid_modulus(const unsigned int point) const = 0;

    /** Adds the derivative h G A^-1 G' dv of the forces -G p(v) in the direction
     *  dv to dst. @param dv with its ghosts. Collective. */
    virtual void
    add_tangent(Vector &dst, const Vector &dv) const = 0;

    /** @name Coupled system */
    /** @{ */

    /** Creates the sparsity pattern of the coupled matrix. Collective.
     *  @param stiffness matrix K, which the coupled matrix contains */
    virtual SparseMatrix
    make_pattern(const SparseMatrix &stiffness) = 0;

    /** Assembles the coupled matrix.
     *  @param stiffness matrix K
     *  @param[in,out] matrix created by make_pattern() */
    virtual void
    assemble(const SparseMatrix &stiffness, SparseMatrix &matrix) const = 0;

    /** Number of pressures over all ranks. */
    virtual unsigned int
    n_rows() const = 0;
    /** @} */

    /** Accepts the pressures of the last call to update() as those at t_n.
     *  Collective. */
    virtual WaterBalance
    commit() = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
