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
  /** Condition for ending a stage early: "COLUMN <= NUMBER" or "COLUMN >=
   *  NUMBER" for a column of path.csv. */
  struct StopCondition
  {
    std::size_t column  = 0;
    bool        at_most = true;
    double      bound   = 0.;
  };

  /**
   * Strain or stress control of each tensor component in a stage.
   * Strain-controlled components have a total increment, stress-controlled
   * components a target stress. The fraction f of the stage increases from 0 to
   * 1.
   */
  struct ElementControl
  {
    std::array<bool, 6> by_stress{};
    Tensor6             strain{}; ///< total increment, f from 0 to 1 (-)
    Tensor6             stress{}; ///< target stress at f = 1 (Pa)

    void
    state(StateRow &row)
    {
      row(by_stress, strain, stress);
    }
  };

  /** Stage of the loading path of an element test, defined in the section
   *  "Path/NAME". */
  class ElementStage : public dealii::ParameterAcceptor
  {
  public:
    explicit ElementStage(const std::string &name);

    /** Checks that the parameters are consistent with the material point and
     *  the columns of path.csv. */
    void
    prepare(const ElementPoint &point, const std::vector<std::string> &columns);

    /** Returns the strain increments and target stresses of the stage. The
     *  stage starts from the current stress of the point. */
    ElementControl
    control(const ElementPoint &point) const;

    /** Returns the completed fraction of the stage (0 to 1) at the end of each
     *  loading increment. */
    std::vector<double>
    positions() const;

    /** Returns true if a row of path.csv fulfils the condition for ending
     *  the stage early. */
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

    /** Loading axis. The enumerators are in the order of the tensor
     *  components. */
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
    std::vector<StopCondition> stop; ///< at most one condition
    std::array<std::string, 6> strain_texts, stress_texts;
  };

  /** Loading path: sequence of the stages listed in "Path/Names". */
  class ElementPath : public NamedList<ElementStage>
  {
  public:
    explicit ElementPath(const ParameterFile &file);

    void
    prepare(const ElementPoint &point, const std::vector<std::string> &columns);
  };
} // namespace geocone::GEOCONE_DIM

#endif
