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
  /** Results for the entire body at the end of a step, common to all
   *  methods. */
  struct StepEnd
  {
    Energies energies;

    /** Maximum accumulated plastic strain over all points. */
    double largest_plastic_strain = 0.;

    /** Reactions of all supports in the order of Scene::supports(). They are
     *  forces on the body (N/m) and moments (N m/m). In explicit steps they are
     *  averaged over the step. */
    std::vector<Reaction> reactions;

    void
    state(StateRow &row)
    {
      row(energies, largest_plastic_strain, reactions);
    }
  };

  /** Record of an accepted step of the loading programme, common to all
   *  methods.
   *  @tparam End StepEnd of the method */
  template <typename End>
  struct StepRecord
  {
    unsigned int step = 0;
    double       time = 0.; ///< end of the step (s)
    End          last;
    std::vector<dealii::Tensor<1, dim>>
      displacements; ///< displacements of observed points (m)

    void
    state(StateRow &row)
    {
      row(step, time, last, displacements);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
