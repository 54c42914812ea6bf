// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_solution_h
#define geocone_seepage_flow_solution_h

#include <geocone/mesh/triangles.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Conditions of a flow at the vertices of a mesh; elsewhere the boundary is
   *  impervious. */
  struct FlowConditions
  {
    enum class Kind : char
    {
      none,
      head,        ///< prescribed pressure head psi > 0
      seepage_face ///< open to the air: psi = 0 where water leaves
    };
    std::vector<Kind>   kind;
    std::vector<double> head; ///< psi, where it is prescribed (m)
    std::vector<double> rain; ///< supply to a vertex (m^2/s)

    /** @name Of a step of a transient flow; empty: steady */
    /** @{ */
    std::vector<double> storage; ///< drainable volume over the step (m^2/s)
    std::vector<double> saturation_before;
    /** @} */
  };

  /** Steady flow on a mesh, by vertices. */
  struct FlowSolution
  {
    /** Pressure head psi = u/gamma_w >= 0 (m). */
    std::vector<double> head;

    /** Relative permeability chi in [0, 1]: 1 where psi > 0. */
    std::vector<double> saturation;

    /** Flow through the boundary into the body, rain included (m^2/s, in axisymmetry
     *  m^3/s). */
    std::vector<double> inflow;

    /** Variable of the normal map: psi, or the outflow over its scale at a seepage face,
     *  where positive; chi - 1 where negative. */
    std::vector<double> s;

    unsigned int iterations = 0;

    /** Largest imbalance of a vertex over the flow through its edges. */
    double error = 0.;
  };

  /**
   * Steady flow of water through a porous body with a free surface:
   *   div q = 0, q = -k (grad psi + chi e_y),
   *   psi >= 0, 1 - chi >= 0, psi (1 - chi) = 0,
   * with the outflow Q >= 0, psi = 0 and (1 - chi) Q = 0 on seepage faces. Linear
   * triangles for psi; the gravity part of the flow along an edge has the chi of the
   * vertex from which it comes, so that the flow is monotone and chi stays in [0, 1]
   * where no off-diagonal entry of the conductance matrix is positive. In a step of a
   * transient flow div q = -n d(chi)/dt by backward Euler, with the drainable porosity n.
   * A normal map,
   *   psi = max(s, 0), chi = 1 + min(s, 0)
   * (at seepage faces Q = max(s, 0)), makes it one system of piecewise linear equations,
   * solved by the nonsmooth Newton method with a line search.
   * See doc/theory/seepage.md.
   * @param permeability hydraulic conductivity of each material (m/s)
   * @param measure factor of the area at a centre: 1, or 2 pi r
   * @param start FlowSolution::s to start from
   * @throws RunError if Newton's method does not converge
   */
  FlowSolution
  solve_flow(const Triangles                                  &triangles,
             const std::vector<dealii::SymmetricTensor<2, 2>> &permeability,
             const std::vector<double>                        &measure,
             const FlowConditions                             &conditions,
             std::vector<double>                               start);

  /** Flow velocity q (Darcy) of a cell (m/s). */
  dealii::Tensor<1, dim>
  darcy_velocity(const Triangles                                  &triangles,
                 const std::vector<dealii::SymmetricTensor<2, 2>> &permeability,
                 const FlowSolution                               &flow,
                 const unsigned int                                cell);
} // namespace geocone::GEOCONE_DIM

#endif
