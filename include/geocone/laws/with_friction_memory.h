// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_with_friction_memory_h
#define geocone_laws_with_friction_memory_h

#include <geocone/materials/friction_memory.h>
#include <geocone/materials/material.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Adds optional friction memory to a constitutive law: the strength follows
   * the normal stress with a delay. The strength depends on a delayed normal
   * stress p (Pa), stored as the history variable after the variables of the
   * base class.
   * @tparam Base Material, or a class derived from it
   */
  template <typename Base>
  class WithFrictionMemory : public Base
  {
  public:
    using Stress     = typename Base::Stress;
    using OutputQuantity = typename Base::OutputQuantity;
    using Components = typename Base::Components;

    unsigned int
    n_history() const override
    {
      return Base::n_history() + (memory.time() > 0.);
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override
    {
      const std::string remark = Base::initialise(stress, size, history);
      if (memory.time() > 0.)
        history[index_of_memory()] = remembered_stress(stress);
      return remark;
    }

    std::vector<OutputQuantity>
    output_quantities() const override
    {
      std::vector<OutputQuantity> all = Base::output_quantities();
      if (memory.time() > 0.)
        all.push_back({"remembered_normal_stress", "remembered s_n (Pa)"});
      return all;
    }

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override
    {
      Base::output(stress, history, values);
      if (memory.time() > 0.)
        values[Base::output_quantities().size()] = history[index_of_memory()];
    }

    double
    friction_memory() const override
    {
      return memory.time();
    }

  protected:
    using Base::Base;

    /** Steady-state value of the delayed normal stress p of friction with
     *  memory at constant stress (Pa). */
    virtual double
    remembered_stress(const Stress &stress) const = 0;

    /** Index, among the history variables, of the delayed normal stress p of
     *  friction with memory.
     *  @pre the relaxation time is positive */
    unsigned int
    index_of_memory() const
    {
      return Base::n_history();
    }

    /** Delayed normal stress (Pa) of friction with memory, and its weight (-)
     *  in the yield condition. */
    struct FrictionHistory
    {
      double part, stress;
    };

    /** Computes the delayed part of the normal stress for friction with memory.
     *  Lagged friction of a solver increases the weight of this part, also
     *  without friction memory.
     *  @param s_n normal stress at the beginning of the step (Pa) */
    FrictionHistory
    friction_history_of(const StepData &step,
                        const double   *history_n,
                        const double    s_n) const
    {
      if (memory.time() == 0.)
        return {step.friction_lag, s_n};
      const double part = memory.remembered(step.size);
      return {part + (1. - part) * step.friction_lag,
              history_n[index_of_memory()]};
    }

    FrictionMemory memory;
  };
} // namespace geocone::GEOCONE_DIM

#endif
