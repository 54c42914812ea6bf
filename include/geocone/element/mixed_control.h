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
  /** How an increment ended. */
  struct ControlReport
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       residual   = 0.; ///< relative
    std::string  reason;          ///< why it did not converge
  };

  /**
   * Finds the strain increments of the components that are controlled by their
   * stress: Newton's method on s(e) = target with differences for the Jacobian,
   * and shorter steps where the residual does not fall.
   */
  class MixedControl : public dealii::ParameterAcceptor
  {
  public:
    MixedControl();

    void
    prepare();

    /**
     * @param point its last trial is the answer; the caller accepts it
     * @param by_stress which components have a target
     * @param target their stresses (Pa)
     * @param[in,out] strain increments; the first guess of the unknown ones
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
