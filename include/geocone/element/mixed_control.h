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
  /** Outcome of an increment. */
  struct ControlReport
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       residual   = 0.; ///< relative
    std::string  reason;          ///< why it did not converge
  };

  /**
   * Solves for the strain increments of stress-controlled components: Newton's
   * method for s(e) = target with a finite-difference Jacobian, and damping if
   * the residual does not decrease.
   */
  class MixedControl : public dealii::ParameterAcceptor
  {
  public:
    MixedControl();

    void
    prepare();

    /**
     * @param point its last trial is the solution; the caller accepts it
     * @param by_stress components with a target stress
     * @param target their stresses (Pa)
     * @param[in,out] strain increments; initial guess of the unknown ones
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
