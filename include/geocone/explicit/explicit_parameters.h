// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_parameters_h
#define geocone_explicit_explicit_parameters_h

#include <geocone/base/choice.h>
#include <geocone/boundary/loading.h>
#include <geocone/transfer/transfer_kernels.h>

#include <deal.II/base/parameter_acceptor.h>

namespace geocone::GEOCONE_DIM
{
  /** Parameters of explicit steps (section "Explicit"): order of operations and step
   *  size. */
  struct ExplicitParameters : dealii::ParameterAcceptor
  {
    ExplicitParameters();

    /** @throws InputError */
    void
    check() const;

    /** Checks the steps at the start of a run.
     *  @param stability_limit critical time step (s)
     *  @throws InputError if a prescribed step is unstable, or a stage has more steps
     *  than any run can perform */
    void
    check_steps(const LoadingProgramme &loading,
                const double            stability_limit) const;

    /** Size (s) of the step from the time t on.
     *  @param last extrema of the last step
     *  @throws StepFailure if the run, or a prescribed step, is unstable */
    double
    step_size(const double    t,
              const double    stability_limit,
              const PassSums &last,
              const double    last_step) const;

    enum class Order
    {
      musl,
      usl,
      usf
    };
    Choice<Order> order = {
      {{"MUSL", Order::musl}, {"USL", Order::usl}, {"USF", Order::usf}}};

    double       courant        = 0.3;
    double       fixed_step     = 0.; ///< (s), or 0
    bool         allow_unstable = false;
    double       largest_strain = 0.; ///< increment, or 0 for no limit
    bool         fast_path      = true;
    unsigned int sort_every     = 50;
  };
} // namespace geocone::GEOCONE_DIM

#endif
