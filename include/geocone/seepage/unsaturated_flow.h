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
   * Flow of water through unsaturated soil (Richards 1931), in the mixed form
   * that conserves mass (Celia et al. 1990):
   *   d(theta)/dt + div q = 0, q = -k k_r (grad psi + e_y),
   * with psi <= 0, Q >= 0, psi Q = 0 on seepage faces and under rain, whose
   * water is supplied up to the flow that the soil takes. psi is linear in
   * triangles, theta lumped at vertices, k_r of an edge that of its upstream
   * end: the scheme is monotone where no off-diagonal entry of the conductance
   * matrix is positive, and hydrostatic pressures are exact. The variable s of
   * a vertex is psi, on seepage faces psi = min(s, 0), Q = max(s, 0) scaled.
   * See doc/theory/seepage.md.
   */
  class UnsaturatedFlow
  {
  public:
    /** @param curves of each material @param measure area factor of each cell
     *  All arguments must outlive the object. */
    UnsaturatedFlow(
      const Triangles                                  &triangles,
      const std::vector<dealii::SymmetricTensor<2, 2>> &permeability,
      const std::vector<double>                        &measure,
      const std::vector<const Retention *>             &curves);

    /** Solves a time step by backward Euler.
     *  @param step size (s); 0: steady flow
     *  @param before pressure heads at its beginning (m)
     *  @param start initial guess of FlowSolution::s
     *  @return flow, and whether Newton's method has converged */
    std::pair<FlowSolution, bool>
    step(const FlowConditions      &conditions,
         const double               step,
         const std::vector<double> &before,
         const std::vector<double> &start) const;

    /** Solves steady flow, by time steps of growing size if Newton's method
     *  fails. @throws RunError */
    FlowSolution
    steady(const FlowConditions &conditions, std::vector<double> start) const;

    /** Volume of water at each vertex (m^2; m^3 in axisymmetry). */
    std::vector<double>
    water(const std::vector<double> &head) const;

    /** Largest change of the effective saturation from that of the first heads
     *  to that of the second ones, less a predicted one, of all vertices and
     *  materials.
     *  @param[in,out] change in the order of parts of vertices: predicted; the
     *  actual one is returned */
    double
    change(const std::vector<double> &from,
           const std::vector<double> &to,
           std::vector<double>       &change) const;

    /** Part of the body at a vertex that is of one material. */
    struct Part
    {
      unsigned int     vertex;
      const Retention *curve;
      double           volume; ///< (m^2)
    };

  private:
    const Triangles                                  &triangles;
    const std::vector<dealii::SymmetricTensor<2, 2>> &permeability;
    const std::vector<double>                        &measure;
    const std::vector<const Retention *>             &curves;
    std::vector<Part>                                 parts;
  };

  /** Darcy velocity q in a cell, with the mean relative permeability of its
   *  vertices (m/s). @param head pressure heads (m) */
  dealii::Tensor<1, dim>
  unsaturated_velocity(
    const Triangles                                  &triangles,
    const std::vector<dealii::SymmetricTensor<2, 2>> &permeability,
    const Retention                                  &curve,
    const std::vector<double>                        &head,
    const unsigned int                                cell);
} // namespace geocone::GEOCONE_DIM

#endif
