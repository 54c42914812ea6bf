// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_mixed_control_h
#define geocone_element_mixed_control_h

#include <geocone/element/element_point.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Result of solving an increment under mixed control. */
  struct ControlReport
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       residual   = 0.; ///< relative stress residual
    std::string  reason;          ///< reason for failure
  };

  /**
   * Mixed stress and strain control of a material point. Solves s(e) = target
   * for the strain increments of the stress-controlled components. Newton's
   * method with a finite-difference Jacobian, and step halving if the residual
   * does not decrease.
   */
  class MixedControl : public dealii::ParameterAcceptor
  {
  public:
    MixedControl();

    void
    prepare();

    /**
     * Solves one increment for the strains of the stress-controlled components.
     * @param point material point; the last trial is the solution, to be
     * accepted by the caller
     * @param by_stress stress-controlled components
     * @param target target stresses of the stress-controlled components (Pa)
     * @param[in,out] strain strain increments; in: initial guess of the unknown
     * increments
     */
    ControlReport
    solve(ElementPoint              &point,
          const std::array<bool, 6> &by_stress,
          const Tensor6             &target,
          Tensor6                   &strain) const;

    unsigned int max_halvings = 12;

  private:
    double       tolerance      = 1e-10;
    unsigned int max_iterations = 25;
  };
} // namespace geocone::GEOCONE_DIM

#endif
