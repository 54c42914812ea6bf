// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_solution_h
#define geocone_seepage_flow_solution_h

#include <geocone/seepage/flow_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Boundary conditions of a seepage flow problem at the vertices of a mesh.
   *  The remaining boundary is impervious. */
  struct FlowConditions
  {
    enum class Kind : char
    {
      none,
      head,        ///< prescribed pressure head psi > 0
      seepage_face ///< open to the air: psi = 0 where water leaves
    };
    std::vector<Kind>   kind;
    std::vector<double> head; ///< psi, where prescribed (m)
    std::vector<double> rain; ///< rainfall supplied to a vertex (m^2/s)

    /** @name Data of a time step of transient flow; empty: steady flow */
    /** @{ */
    std::vector<double> storage; ///< drainable volume over step size (m^2/s)
    std::vector<double> saturation_before;
    /** @} */
  };

  /** Solution of a seepage flow problem at the vertices of a mesh. */
  struct FlowSolution
  {
    /** Pressure head psi = u/gamma_w >= 0 at each vertex (m). */
    std::vector<double> head;

    /** Relative permeability chi in [0, 1] at each vertex: 1 where psi > 0. */
    std::vector<double> saturation;

    /** Flow rate into the body through the boundary at each vertex, including
     *  rain (m^2/s; m^3/s in axisymmetry). */
    std::vector<double> inflow;

    /** Variable s of the normal map (a form of the complementarity conditions)
     *  at each vertex. Positive: psi, or at seepage faces the scaled outflow;
     *  negative: chi - 1. */
    std::vector<double> s;

    unsigned int iterations = 0;

    /** Largest relative residual of the water balance over all vertices. At a
     *  vertex, it is the imbalance divided by the flow through the edges. */
    double error = 0.;
  };

  /**
   * Solves the steady seepage flow through a porous body with a free surface,
   * or a time step of transient flow. Steady flow satisfies
   *   div q = 0, q = -k (grad psi + chi e_y),
   *   psi >= 0, 1 - chi >= 0, psi (1 - chi) = 0,
   * with the outflow Q >= 0, psi = 0 and (1 - chi) Q = 0 on seepage faces. psi
   * is linear in triangles or tetrahedra; the gravity part of the flow along an edge uses the
   * upstream chi, so that the scheme is monotone and chi is in [0, 1] where no
   * off-diagonal entry of the conductance matrix is positive. In a time step of
   * transient flow div q = -n d(chi)/dt by backward Euler, with the drainable
   * porosity n. A normal map,
   *   psi = max(s, 0), chi = 1 + min(s, 0)
   * (at seepage faces Q = max(s, 0)), leads to a system of piecewise linear
   * equations, solved by the nonsmooth Newton method with a line search. See
   * doc/theory/seepage.md.
   * @param permeability hydraulic conductivity of each material (m/s)
   * @param measure area factor at the centre of each cell: 1, in axisymmetry 2
   * pi r
   * @param start initial guess of FlowSolution::s
   * @throws RunError if Newton's method does not converge
   */
  FlowSolution
  solve_flow(const FlowMesh                                     &mesh,
             const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
             const std::vector<double>                          &measure,
             const FlowConditions                               &conditions,
             std::vector<double>                                 start);

  /** Darcy velocity q in a cell (m/s). */
  dealii::Tensor<1, dim>
  darcy_velocity(
    const FlowMesh                                     &mesh,
    const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
    const FlowSolution                                 &flow,
    const unsigned int                                  cell);
} // namespace geocone::GEOCONE_DIM

#endif
