// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_path_h
#define geocone_element_element_path_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/element/element_point.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A condition on a column of the results, "NAME <= NUMBER" or ">=". */
  struct StopCondition
  {
    std::size_t column  = 0;
    bool        at_most = true;
    double      bound   = 0.;
  };

  /**
   * Control of each component along a stage: strain control by an increment, or
   * stress control by a target. f runs from 0 at the start of the stage to 1.
   */
  struct ElementControl
  {
    std::array<bool, 6> by_stress{};
    Tensor6             strain{}; ///< increment for f from 0 to 1 (-)
    Tensor6             stress{}; ///< value at f = 1 (Pa)

    void
    state(StateRow &row)
    {
      row(by_stress, strain, stress);
    }
  };

  /** A stage of a path: parameters of the section "Path/NAME". */
  class ElementStage : public dealii::ParameterAcceptor
  {
  public:
    explicit ElementStage(const std::string &name);

    /** Checks the parameters for the components and columns of a point. */
    void
    prepare(const ElementPoint &point, const std::vector<std::string> &columns);

    /** Control of a stage that starts from the present stress. */
    ElementControl
    control(const ElementPoint &point) const;

    /** f at the ends of all increments. */
    std::vector<double>
    positions() const;

    /** Whether a line of the results ends the stage early. */
    bool
    stops(const double *line) const;

    const std::string name;

  private:
    void
    check_components(const ElementPoint &point) const;

    std::string
    parameter(const std::string &entry) const;
    unsigned int
    axis_index() const;

    enum class Kind
    {
      components,
      isotropic,
      oedometric,
      drained,
      undrained,
      simple_shear
    };
    Choice<Kind> kind = {{{"components", Kind::components},
                          {"isotropic", Kind::isotropic},
                          {"oedometric", Kind::oedometric},
                          {"drained", Kind::drained},
                          {"undrained", Kind::undrained},
                          {"simple shear", Kind::simple_shear}}};

    /** Axes in the order of the components. */
    enum class Axis
    {
      xx,
      yy,
      zz
    };
    Choice<Axis> axis = {
      {{"yy", Axis::yy}, {"xx", Axis::xx}, {"zz", Axis::zz}}};

    enum class CycleForm
    {
      two_way,
      one_way
    };
    Choice<CycleForm> cycle_form = {
      {{"two-way", CycleForm::two_way}, {"one-way", CycleForm::one_way}}};

    double                     amount       = 0.;
    unsigned int               n_increments = 100;
    unsigned int               n_cycles     = 0;
    std::string                stop_text;
    std::vector<StopCondition> stop; ///< none or one
    std::array<std::string, 6> strain_texts, stress_texts;
  };

  /** The stages of "Path/Names", one after the other. */
  class ElementPath : public NamedList<ElementStage>
  {
  public:
    explicit ElementPath(const ParameterFile &file);

    void
    prepare(const ElementPoint &point, const std::vector<std::string> &columns);
  };
} // namespace geocone::GEOCONE_DIM

#endif
