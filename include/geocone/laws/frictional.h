// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_frictional_h
#define geocone_laws_frictional_h

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/expression.h>
#include <geocone/functions/formula.h>
#include <geocone/laws/with_friction_memory.h>
#include <geocone/materials/frictional_strength.h>
#include <geocone/materials/material.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Base class of constitutive laws with cohesion, friction and dilatancy.
   * History variables of the strength are the delayed normal stress
   * (WithFrictionMemory) and, if the cohesion varies in space, its increase
   * above c at the initial position of the point (Pa). The cohesion varies with
   * depth, c(y) = c + gradient (level - y), by a formula, or in proportion to
   * the initial vertical stress.
   * @tparam Base Material, or a class derived from it
   */
  template <typename Base>
  class Frictional : public WithFrictionMemory<Base>
  {
    using Remembering = WithFrictionMemory<Base>;

  public:
    using typename Remembering::Components;
    using typename Remembering::OutputQuantity;
    using typename Remembering::Stress;

    void
    prepare() override
    {
      Remembering::prepare();
      given.prepare(this->parameter());
      if (!(ratio >= 0.) ||
          (ratio > 0. && (given.gradient != 0. || !profile_text.empty())))
        throw InputError(this->parameter("Cohesion ratio"),
                         ratio,
                         ">= 0, and 0 with a formula or a gradient of the "
                         "cohesion",
                         "0.22 to 0.3 are usual for normally consolidated "
                         "clay");
      if (profile_text.empty())
        return;
      if (given.gradient != 0.)
        throw InputError(this->parameter("Cohesion formula"),
                         profile_text,
                         "empty with a 'Cohesion gradient'",
                         "give one of them");
      check_formula(profile_text,
                    this->parameter("Cohesion formula"),
                    FormulaVariables::place);
      profile.emplace().prepare(profile_text,
                                this->parameter("Cohesion formula"));
    }

    std::string
    strength_formula() const override
    {
      return profile ? "Cohesion formula" : ratio > 0. ? "Cohesion ratio" : "";
    }

    std::string
    formula_of_place() const override
    {
      return profile ? "Cohesion formula" : Remembering::formula_of_place();
    }

    unsigned int
    n_history() const override
    {
      return Remembering::n_history() + cohesion_grows();
    }

    void
    initialise_at(const dealii::Point<dim> &place,
                  double                   *history) const override
    {
      Remembering::initialise_at(place, history);
      if (given.gradient == 0. && !profile)
        return;
      const double more =
        profile ? profile->value(place, 0.) - given.c : given.growth(place[1]);
      const double here = given.c + more;
      if (!(here > 0. || (here == 0. && given.phi > 0.)))
        throw InputError(
          this->parameter(profile ? "Cohesion formula" : "Cohesion gradient"),
          profile ? profile_text : format("%g", given.gradient),
          format("a cohesion > 0 Pa everywhere; here it is %g Pa", here),
          profile ? "limit it from below, e.g. max(1000, ...)"
                  : "give 'Cohesion' at the top of the soil, and its y as "
                    "'Cohesion level'");
      history[index_of_growth()] = more;
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override
    {
      const std::string remark = Remembering::initialise(stress, size, history);
      if (ratio > 0.)
        history[index_of_growth()] = std::max(-ratio * stress[1] - given.c, 0.);
      return remark;
    }

    std::vector<OutputQuantity>
    output_quantities() const override
    {
      std::vector<OutputQuantity> all = Remembering::output_quantities();
      if (cohesion_grows())
        all.push_back({"cohesion", "cohesion (Pa)"});
      return all;
    }

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override
    {
      Remembering::output(stress, history, values);
      if (cohesion_grows())
        values[Remembering::output_quantities().size()] =
          given.c + history[index_of_growth()];
    }

  protected:
    explicit Frictional(const std::string &section)
      : Remembering(section)
    {
      given.declare(*this);
      declare_places();
      this->memory.declare(*this);
    }

    /** Constructor for laws without friction, phi = theta = 0. The angles are
     *  not declared as parameters.
     *  @param cohesion documentation of the parameter 'Cohesion' */
    Frictional(const std::string &section, const std::string &cohesion)
      : Remembering(section)
      , given(FrictionalStrength::without_friction())
    {
      this->memory = FrictionMemory("0");
      given.declare_cohesion(*this, cohesion);
      declare_places();
    }

    /** Returns true if the cohesion varies in space. */
    bool
    cohesion_grows() const
    {
      return given.gradient != 0. || profile || ratio > 0.;
    }

    /** Difference (Pa) between the cohesion at a point and the parameter
     *  'Cohesion'.
     *  @param history of the point; null: no increase */
    double
    cohesion_increase(const double *history) const
    {
      return cohesion_grows() && history != nullptr ? history[index_of_growth()]
                                                    : 0.;
    }

    /** Index of the history variable that stores the cohesion increase.
     *  @pre the cohesion varies in space */
    unsigned int
    index_of_growth() const
    {
      return Remembering::n_history();
    }

    FrictionalStrength given;

  private:
    void
    declare_places()
    {
      given.declare_growth(*this);
      this->add_parameter(
        "Cohesion formula",
        profile_text,
        "Cohesion [Pa] as a formula in the initial coordinates of a point, "
        "instead of 'Cohesion'. Empty: not used.");
      this->add_parameter(
        "Cohesion ratio",
        ratio,
        "Cohesion over the initial effective vertical stress of a point [-], "
        "e.g. 0.25 for the undrained strength of normally consolidated clay; "
        "at least 'Cohesion'. 0: not used.");
    }

    std::string               profile_text;
    std::optional<Expression> profile;
    double                    ratio = 0.; ///< s_u over the vertical stress (-)
  };
} // namespace geocone::GEOCONE_DIM

#endif
