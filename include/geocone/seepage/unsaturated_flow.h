// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_unsaturated_flow_h
#define geocone_seepage_unsaturated_flow_h

#include <geocone/materials/retention.h>
#include <geocone/seepage/flow_solution.h>

#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Solver for Richards' equation of flow through unsaturated soil (Richards
   * 1931). The mixed form conserves mass (Celia et al. 1990):
   *   d(theta)/dt + div q = 0, q = -k k_r (grad psi + e_y).
   * On seepage faces and under rain, psi <= 0, Q >= 0 and psi Q = 0, where Q is
   * the outflow, or the part of the rain that does not infiltrate. psi is
   * linear in cells, theta is lumped at vertices, and k_r of an edge is
   * evaluated at its upstream vertex. The scheme is monotone where no
   * off-diagonal entry of the conductance matrix is positive, and exact for
   * hydrostatic pressures. The variable s of a vertex is psi; on seepage faces
   * psi = min(s, 0) and Q = max(s, 0), scaled. See doc/theory/seepage.md.
   */
  class UnsaturatedFlow
  {
  public:
    /** @param measure area factor of each cell (1, or 2 pi r in axisymmetry)
     *  @param curves of each material
     *  @pre all arguments outlive the object */
    UnsaturatedFlow(
      const FlowMesh                                     &mesh,
      const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
      const std::vector<double>                          &measure,
      const std::vector<const Retention *>               &curves);

    /** Solves one time step by the backward Euler method.
     *  @param step size (s); 0: steady flow
     *  @param before pressure heads at the beginning of the step (m)
     *  @param start initial guess of FlowSolution::s
     *  @return flow, and true if Newton's method has converged */
    std::pair<FlowSolution, bool>
    step(const FlowConditions      &conditions,
         const double               step,
         const std::vector<double> &before,
         const std::vector<double> &start) const;

    /** Solves the steady flow problem. If Newton's method fails, time steps of
     *  increasing size approach the steady state. @throws RunError */
    FlowSolution
    steady(const FlowConditions &conditions, std::vector<double> start) const;

    /** Water volume assigned to each vertex (m^2; m^3 in axisymmetry). */
    std::vector<double>
    water(const std::vector<double> &head) const;

    /** Returns the largest difference between actual and predicted changes of
     *  the effective saturation, over all vertices and materials.
     *  @param from,to pressure heads before and after the change (m)
     *  @param[in,out] change predicted change of each Part; replaced by the
     *  actual change */
    double
    change(const std::vector<double> &from,
           const std::vector<double> &to,
           std::vector<double>       &change) const;

    /** Control volume of a vertex, restricted to one material. */
    struct Part
    {
      unsigned int     vertex;
      const Retention *curve;
      double           volume; ///< (m^2)
    };

  private:
    const FlowMesh                                     &mesh;
    const std::vector<dealii::SymmetricTensor<2, dim>> &permeability;
    const std::vector<double>                          &measure;
    const std::vector<const Retention *>               &curves;
    std::vector<Part>                                   parts;
  };

  /** Darcy velocity q in a cell (m/s), with the mean relative permeability of
   *  the vertices of the cell. @param head pressure heads (m) */
  dealii::Tensor<1, dim>
  unsaturated_velocity(
    const FlowMesh                                     &mesh,
    const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
    const Retention                                    &curve,
    const std::vector<double>                          &head,
    const unsigned int                                  cell);
} // namespace geocone::GEOCONE_DIM

#endif
