// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_load_choice_h
#define geocone_bounds_load_choice_h

#include <geocone/base/choice.h>
#include <geocone/bounds/load_factor.h>
#include <geocone/scene/scene.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Returns the choice of loads that includes the pore pressures: those by the
   *  pore pressure ratio grow with the weight, others only with all loads. */
  inline LoadFactor
  factor_of_water(const Scene &scene)
  {
    return scene.water.scales_with_weight() ? LoadFactor::weight
                                            : LoadFactor::all;
  }

  /** Loads that are multiplied by the load factor of a limit analysis, in two and three
   *  dimensions. */
  class LoadChoice
  {
  public:
    /** Declares the parameter "Load factor of" in a section of the parameter file. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** Returns the type of loads that are multiplied by the load factor. Before they are
     *  selected, LoadFactor::automatic is returned. */
    LoadFactor
    factor() const
    {
      return chosen;
    }

    /** Returns true if the bounded load is the reaction force at supports with
     *  prescribed velocities. */
    bool
    is_reaction() const
    {
      return chosen == LoadFactor::velocity;
    }

    std::string
    word() const;

    /** Returns the unit of the bounded load as text. It is the unit of a force (per metre
     *  of thickness in plane strain) for a reaction, otherwise "-". */
    std::string
    unit() const;

    /** Returns the load that corresponds to the load factor 1 of a problem. It is in
     *  unit() for a reaction, otherwise 1. */
    double
    load_of_unit_factor() const
    {
      return load_unit;
    }

    /** Returns a message if the load that steps observe is another one than the
     *  bounded reaction of all that is pushed, in the direction of the prescribed
     *  velocity: another support, component, or one of the opposite sign. Otherwise, and
     *  without an observed load, the message is empty. */
    std::string
    other_than_observed(const Scene &scene) const;

    /** Checks that what is observed is what is pushed. @throws InputError if the bounded
     *  reaction is that of another support than the first one of
     *  'Observation/Conditions' */
    void
    check_observed(const Scene &scene) const;

    /** Returns true if any material has non-associated flow. Its dilatancy angle is then
     *  smaller than its friction angle. */
    bool
    non_associated() const
    {
      return less_dilatant;
    }

    BoundUnits units;

  protected:
    /**
     * Selects the loads that are multiplied by the load factor, and sets the
     * unit of velocity.
     * @param velocity prescribed non-zero velocity (m/s), if any
     * @param has_weight whether gravity acts
     * @throws InputError if the selected loads do not suit the prescribed velocity
     */
    void
    choose(const std::optional<dealii::Tensor<1, dim>> &velocity,
           const bool                                   has_weight);

    /** Rejects tractions of pore pressures if either weight or tractions are
     *  multiplied: water would be multiplied in one of them alone.
     *  @throws InputError */
    void
    refuse_pore_pressures(const Scene &scene) const;

    /** Selects weight and tractions as the loads for strength reduction.
     *  @param kind of analysis, for messages
     *  @throws InputError if a velocity is prescribed that is not zero */
    void
    choose_all(const bool has_velocity, const std::string &kind);

    /** Selects tractions as the loads, some of which may be zero at t = 0.
     *  @param kind of analysis, for messages
     *  @throws InputError if a velocity is prescribed that is not zero */
    void
    choose_tractions(const bool has_velocity, const std::string &kind);

    /** Throws an exception that reports that the selected loads are zero.
     *  @throws InputError */
    [[noreturn]] void
    refuse_zero_load() const;

    /** Largest vertical stress by the weight of a body (Pa). @param height (m) */
    static double
    stress_of_weight(const Scene &scene, const double height);

    /** Unit of a reaction force, see unit(). */
    std::string unit_of_reaction = dim == 2 ? "N/m" : "N";

    double load_unit     = 1.;
    bool   may_vanish    = false; ///< loads at t = 0
    bool   less_dilatant = false;

  private:
    Choice<LoadFactor> asked  = {{{"automatic", LoadFactor::automatic},
                                  {"velocity", LoadFactor::velocity},
                                  {"weight", LoadFactor::weight},
                                  {"tractions", LoadFactor::tractions}}};
    LoadFactor         chosen = LoadFactor::automatic;

    dealii::Tensor<1, dim> direction; ///< of a prescribed velocity, unit vector
  };
} // namespace geocone::GEOCONE_DIM

#endif
