// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_with_stiffness_formula_h
#define geocone_laws_with_stiffness_formula_h

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/expression.h>
#include <geocone/functions/formula.h>
#include <geocone/materials/material.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Adds a Young's modulus that varies in space to a constitutive law. If the
   * modulus is a formula in the initial coordinates of a point, E (Pa) is the
   * history variable after the variables of the base class. Poisson's ratio is
   * that of the law.
   * @tparam Base Material, or a class derived from it
   */
  template <typename Base>
  class WithStiffnessFormula : public Base
  {
  public:
    using Stress     = typename Base::Stress;
    using OutputQuantity = typename Base::OutputQuantity;
    using Components = typename Base::Components;

    explicit WithStiffnessFormula(const std::string &section)
      : Base(section)
    {
      this->add_parameter(
        entry,
        text,
        "Young's modulus [Pa] as a formula in the initial coordinates of a "
        "point, instead of 'Young modulus'. Empty: not used.");
    }

    void
    prepare() override
    {
      Base::prepare();
      if (text.empty())
        return;
      check_formula(text, this->parameter(entry), FormulaVariables::place);
      formula.emplace().prepare(text, this->parameter(entry));
    }

    bool
    has_constant_stiffness() const override
    {
      return !formula;
    }

    std::string
    formula_of_place() const override
    {
      return formula ? entry : Base::formula_of_place();
    }

    unsigned int
    n_history() const override
    {
      return Base::n_history() + formula.has_value();
    }

    void
    initialise_at(const dealii::Point<dim> &place,
                  double                   *history) const override
    {
      Base::initialise_at(place, history);
      if (!formula)
        return;
      const double E = formula->value(place, 0.);
      if (!(E > 0.))
        throw InputError(this->parameter(entry),
                         text,
                         format("E > 0 Pa everywhere; here it is %g Pa", E),
                         "limit it from below, e.g. max(1e6, ...)");
      history[index_of_modulus()] = E;
    }

    Elasticity
    elasticity_at(const Mandel &stress, const double *history) const override
    {
      return formula ? own_elasticity(history)
                     : Base::elasticity_at(stress, history);
    }

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double        *history) const override
    {
      if (!formula)
        return Base::elastic_strain(from, to, history);
      const Mandel change = (to - from).template head<n_mandel>();
      return extended(own_elasticity(history).strain(change), 0.);
    }

    double
    wave_modulus(const Stress &stress, const double *history) const override
    {
      if (!formula)
        return Base::wave_modulus(stress, history);
      const Elasticity own = own_elasticity(history);
      return own.lambda + own.two_G;
    }

    std::vector<OutputQuantity>
    output_quantities() const override
    {
      std::vector<OutputQuantity> all = Base::output_quantities();
      if (formula)
        all.push_back({"young_modulus", "Young's modulus (Pa)"});
      return all;
    }

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override
    {
      Base::output(stress, history, values);
      if (formula)
        values[Base::output_quantities().size()] = history[index_of_modulus()];
    }

  protected:
    /** Name of the input parameter for the stiffness formula. */
    static constexpr const char *entry = "Young modulus formula";

    /** Elastic moduli of a point with a stiffness formula. @pre there is a
     *  formula */
    Elasticity
    own_elasticity(const double *history) const
    {
      return {history[index_of_modulus()], this->poisson()};
    }

  private:
    /** Index of Young's modulus E among the history variables, if a formula is
     *  given. */
    unsigned int
    index_of_modulus() const
    {
      return Base::n_history();
    }

    std::string               text;
    std::optional<Expression> formula;
  };
} // namespace geocone::GEOCONE_DIM

#endif
