// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/element/element_path.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_element_path[] = {
      {"Path/*", "Discretisation/Method", {"point"}},
      {"Path/*/*", "Discretisation/Method", {"point"}}};
  } // namespace

  namespace
  {
    double
    number(const std::string &text, const std::string &parameter)
    {
      std::istringstream in(text);
      double             value;
      std::string        rest;
      if (!(in >> value) || in >> rest || !std::isfinite(value))
        throw InputError(
          parameter,
          text,
          "a number, or nothing",
          "e.g. -0.01 for a strain of 1 % in compression, -100e3 "
          "for 100 kPa");
      return value;
    }

    StopCondition
    stop_condition(const std::string              &text,
                   const std::string              &parameter,
                   const std::vector<std::string> &columns)
    {
      // The name can contain blanks: "stress yy <= -200e3".
      const std::size_t place = text.find("=");
      StopCondition     condition;
      std::string       known;
      if (place != std::string::npos && place > 0 &&
          (text[place - 1] == '<' || text[place - 1] == '>'))
        {
          condition.at_most = text[place - 1] == '<';
          const auto parts  = split_names(text.substr(0, place - 1));
          condition.bound   = number(text.substr(place + 1), parameter);
          for (const std::string &column : columns)
            {
              const std::string name = column.substr(0, column.find(" ("));
              if (!parts.empty() && name == parts[0])
                return condition;
              known += (known.empty() ? "" : ", ") + name;
              ++condition.column;
            }
        }
      throw InputError(parameter,
                       text,
                       "NAME <= NUMBER or NAME >= NUMBER" +
                         (known.empty() ? "" : ", NAME one of: " + known),
                       "e.g. p <= 20e3");
    }
  } // namespace

  ElementStage::ElementStage(const std::string &name)
    : dealii::ParameterAcceptor("/Path/" + name)
    , name(name)
  {
    kind.declare(
      *this,
      "Kind",
      ". Components: each component by its own strain or stress below. "
      "Isotropic: equal normal strains; Amount: volumetric strain. Oedometric: "
      "axial strain only; Amount: axial strain. Drained: constant lateral "
      "stresses; Amount: axial strain. Undrained: constant volume with equal "
      "lateral strains; Amount: axial strain. Simple shear: Amount: shear "
      "angle gamma = 2 eps_xy, no other strain. Tension is positive: -0.1 is "
      "10 % compression.");
    axis.declare(
      *this, "Axis", ": axis of the kinds oedometric, drained and undrained.");
    add_parameter(
      "Amount", amount, "Strain at the end of the stage [-]; see 'Kind'.");
    add_parameter("Increments",
                  n_increments,
                  "Number of increments, > 0; with cycles, per amplitude.");
    add_parameter(
      "Cycles",
      n_cycles,
      "Number of cycles; 0: monotonic. With cycles, the amount, strains and "
      "target stresses are amplitudes about the initial state.");
    cycle_form.declare(*this,
                       "Cycle form",
                       ". Two-way: to the amplitude, to its opposite and back. "
                       "One-way: to the amplitude and back.");
    add_parameter(
      "Stop when",
      stop_text,
      "Condition that ends the stage early: NAME <= NUMBER or NAME >= NUMBER "
      "with a column of path.csv, e.g. p <= 20e3, eps_q >= 0.05. Empty: none.");
    for (unsigned int i = 0; i < 6; ++i)
      {
        add_parameter(
          std::string("Strain ") + component_names[i],
          strain_texts[i],
          "Strain increment of the stage [-], for the kind 'components'. Zero "
          "if neither strain nor stress is given.");
        add_parameter(std::string("Stress ") + component_names[i],
                      stress_texts[i],
                      "Target stress at the end of the stage [Pa], or "
                      "'constant', for the kind 'components'.");
      }
  }

  std::string
  ElementStage::parameter(const std::string &entry) const
  {
    return "Path/" + name + "/" + entry;
  }

  unsigned int
  ElementStage::axis_index() const
  {
    return static_cast<unsigned int>(Axis(axis));
  }

  void
  ElementStage::check_components(const ElementPoint &point) const
  {
    bool any = false;
    for (unsigned int i = 0; i < 6; ++i)
      {
        const std::string component = component_names[i];
        const bool given = !strain_texts[i].empty() || !stress_texts[i].empty();
        any              = any || given;
        if (given && kind != Kind::components)
          throw InputError(parameter(!strain_texts[i].empty()
                                       ? "Strain " + component
                                       : "Stress " + component),
                           strain_texts[i] + stress_texts[i],
                           "nothing where Kind = " + kind.word(),
                           "set 'Kind = components' and give all components");
        if (!strain_texts[i].empty() && !stress_texts[i].empty())
          throw InputError(parameter("Stress " + component),
                           stress_texts[i],
                           "strain or stress of a component, not both",
                           "take one of them out");
        if (given && !point.has(i))
          throw InputError(parameter(!strain_texts[i].empty()
                                       ? "Strain " + component
                                       : "Stress " + component),
                           strain_texts[i] + stress_texts[i],
                           "nothing: it has no strain in plane strain",
                           "control xx, yy and xy, or set 'Element/Components "
                           "= 3D' if the material has it");
        if (!strain_texts[i].empty())
          number(strain_texts[i], parameter("Strain " + component));
        if (!stress_texts[i].empty() && stress_texts[i] != "constant")
          number(stress_texts[i], parameter("Stress " + component));
      }
    if (kind == Kind::components && !any)
      throw InputError(parameter("Strain yy"),
                       "",
                       "a strain or stress of at least one component",
                       "e.g. -0.01, or choose another Kind");
  }

  void
  ElementStage::prepare(const ElementPoint             &point,
                        const std::vector<std::string> &columns)
  {
    if (!point.has(axis_index()))
      throw InputError(parameter("Axis"),
                       axis.word(),
                       "xx | yy in plane strain",
                       "choose one of them");
    if (kind != Kind::components && !(amount != 0. && std::isfinite(amount)))
      throw InputError(parameter("Amount"),
                       amount,
                       "a strain, not 0",
                       "-0.01 is 1 % in compression");
    if (n_increments == 0)
      throw InputError(
        parameter("Increments"), n_increments, "> 0", "100 is usual");
    if (4. * n_increments * std::max(1U, n_cycles) > 1e8)
      throw InputError(n_cycles > n_increments ? parameter("Cycles")
                                               : parameter("Increments"),
                       std::max(n_cycles, n_increments),
                       "at most 2.5e7 increments, of all cycles",
                       "take fewer increments or cycles, or more stages");
    check_components(point);
    if (!stop_text.empty())
      stop = {stop_condition(stop_text, parameter("Stop when"), columns)};
  }

  ElementControl
  ElementStage::control(const ElementPoint &point) const
  {
    ElementControl     control;
    const Tensor6      start = point.stress();
    const unsigned int a     = axis_index();
    control.stress           = start;
    if (kind == Kind::components)
      for (unsigned int i = 0; i < 6; ++i)
        {
          control.by_stress[i] = !stress_texts[i].empty();
          if (!strain_texts[i].empty())
            control.strain[i] = std::stod(strain_texts[i]);
          if (control.by_stress[i] && stress_texts[i] != "constant")
            control.stress[i] = std::stod(stress_texts[i]);
        }
    else if (kind == Kind::simple_shear)
      control.strain[3] = amount / 2.;
    else
      for (unsigned int i = 0; i < 3; ++i)
        if (point.has(i))
          {
            const double n = point.has(2) ? 3. : 2.;
            if (kind == Kind::isotropic)
              control.strain[i] = amount / n;
            else if (i == a)
              control.strain[i] = amount;
            else if (kind == Kind::undrained)
              control.strain[i] = -amount / (n - 1.);
            else if (kind == Kind::drained)
              control.by_stress[i] = true;
          }
    return control;
  }

  std::vector<double>
  ElementStage::positions() const
  {
    std::vector<double> corners = {0.};
    if (n_cycles == 0)
      corners.push_back(1.);
    for (unsigned int i = 0; i < n_cycles; ++i)
      {
        corners.push_back(1.);
        if (cycle_form == CycleForm::two_way)
          corners.push_back(-1.);
        corners.push_back(0.);
      }
    std::vector<double> f;
    for (std::size_t i = 1; i < corners.size(); ++i)
      {
        const double       way = corners[i] - corners[i - 1];
        const unsigned int n   = n_increments * std::lround(std::abs(way));
        for (unsigned int j = 1; j <= n; ++j)
          f.push_back(corners[i - 1] + way * j / n);
      }
    return f;
  }

  bool
  ElementStage::stops(const double *line) const
  {
    return std::any_of(stop.begin(), stop.end(), [&](const StopCondition &s) {
      return s.at_most ? line[s.column] <= s.bound : line[s.column] >= s.bound;
    });
  }

  ElementPath::ElementPath(const ParameterFile &file)
    : NamedList(file,
                "Path",
                "Names of the stages in order, comma-separated; each has a "
                "subsection of its name.",
                "loading")
  {
    make();
  }

  void
  ElementPath::prepare(const ElementPoint             &point,
                       const std::vector<std::string> &columns)
  {
    require_one("shear");
    for (const auto &stage : list)
      stage->prepare(point, columns);
  }
} // namespace geocone::GEOCONE_DIM
