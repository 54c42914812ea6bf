// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_load_choice_h
#define geocone_limit_analysis_load_choice_h

#include <geocone/base/choice.h>
#include <geocone/limit_analysis/load_factor.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Choice of the loads multiplied by the load factor of a limit analysis, in the plane
   *  and in three dimensions. */
  class LoadChoice
  {
  public:
    /** Declares the parameter "Load factor of" in a section. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** Loads that the load factor multiplies; LoadFactor::automatic before a choice. */
    LoadFactor
    factor() const
    {
      return chosen;
    }

    /** Whether the bounded load is the reaction to prescribed velocities. */
    bool
    is_reaction() const
    {
      return chosen == LoadFactor::velocity;
    }

    std::string
    word() const;

    /** Unit of the bounded load: of a force (per metre in the plane) for a reaction,
     *  otherwise "-". */
    std::string
    unit() const;

    /** Load that corresponds to the load factor 1 of a problem: in unit() for a reaction,
     *  otherwise 1. */
    double
    value_of_unit() const
    {
      return load_unit;
    }

    /** Whether some material has non-associated flow, i.e. a dilatancy angle smaller than
     *  the friction angle. */
    bool
    non_associated() const
    {
      return less_dilatant;
    }

    BoundUnits units;

  protected:
    /**
     * Selects the loads, and the unit of velocity.
     * @param velocity prescribed non-zero velocity (m/s), if any
     * @param has_weight whether gravity acts
     * @throws InputError if the loads asked for do not suit the prescribed velocity
     */
    void
    choose(const std::optional<dealii::Tensor<1, dim>> &velocity,
           const bool                                   has_weight);

    /** Selects weight and tractions, for strength reduction. */
    void
    choose_all()
    {
      chosen = LoadFactor::all;
    }

    /** @throws InputError because the chosen loads are zero */
    [[noreturn]] void
    refuse_zero_load() const;

    double load_unit     = 1.;
    bool   less_dilatant = false;

  private:
    Choice<LoadFactor> asked  = {{{"automatic", LoadFactor::automatic},
                                  {"velocity", LoadFactor::velocity},
                                  {"weight", LoadFactor::weight},
                                  {"tractions", LoadFactor::tractions}}};
    LoadFactor         chosen = LoadFactor::automatic;
  };
} // namespace geocone::GEOCONE_DIM

#endif
