// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_step_record_h
#define geocone_time_stepping_step_record_h

#include <geocone/conditions/prescribed_node.h>
#include <geocone/time_stepping/energies.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Common end-of-step data of all methods, over all ranks. */
  struct StepEnd
  {
    Energies energies;

    /** Largest cumulative plastic strain of all points. */
    double largest_plastic_strain = 0.;

    /** Forces on the body of each of Scene::supports() (N/m), and their moments
     *  (N m/m); explicit: means over the step. */
    std::vector<Reaction> reactions;

    void
    state(StateRow &row)
    {
      row(energies, largest_plastic_strain, reactions);
    }
  };

  /** Common record of an accepted step of the loading programme.
   *  @tparam End the method's own StepEnd */
  template <typename End>
  struct StepRecord
  {
    unsigned int step = 0;
    double       time = 0.; ///< at its end (s)
    End          last;
    std::vector<dealii::Tensor<1, dim>>
      displacements; ///< of observed points (m)

    void
    state(StateRow &row)
    {
      row(step, time, last, displacements);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
