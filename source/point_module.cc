// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Python module geocone_point: element tests in the process of the interpreter. Its
// interface for users is geocone.MaterialPoint (python/geocone/point.py).

#include <geocone/base/exceptions.h>
#include <geocone/base/units.h>
#include <geocone/element/driven_point.h>
#include <geocone/element/element_path.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{
  using namespace geocone;
  namespace py = pybind11;

  using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

  /** Parameters of all laws, found before the first point is made. */
  const ParameterFile::ParametersOfOtherKinds &
  of_other_laws()
  {
    static const ParameterFile::ParametersOfOtherKinds all =
      parameters_of_laws();
    return all;
  }

  /** Parameters and state of a point; its lines are those of path.csv. */
  class Point
  {
  public:
    explicit Point(const std::vector<std::string> &settings)
      : file(declare(settings))
      , driven(file)
      , stages(file)
    {
      file.parse(of_other_laws());
      changed = driven.prepare();
      table   = element_columns(*driven.point, driven.initial_volume);
      for (const std::string &name : table.names())
        columns.push_back(in_units(name));
    }

    Tensor6
    stress() const
    {
      return driven.point->stress();
    }

    std::vector<double>
    line(const unsigned int stage) const
    {
      return table.line(driven.record(stage));
    }

    /**
     * Follows rows of six values, an increment for each.
     * @param by_stress which of them are stresses at the end of the increment (Pa); the
     * others are strains there
     * @return a line for each row
     */
    py::array_t<double>
    follow(const std::array<bool, 6> &by_stress, const Rows &rows)
    {
      if (rows.ndim() != 2 || rows.shape(1) != 6)
        throw InputError("rows of six values are needed");
      const auto          value = rows.unchecked<2>();
      std::vector<double> lines;
      for (py::ssize_t k = 0; k < rows.shape(0); ++k)
        {
          ElementControl control;
          control.by_stress = by_stress;
          for (unsigned int i = 0; i < 6; ++i)
            if (!std::isfinite(value(k, i)))
              throw InputError("stresses and strains must be finite: row " +
                               std::to_string(k));
          for (unsigned int i = 0; i < 6; ++i)
            if (by_stress[i])
              control.stress[i] = value(k, i);
            else if (driven.point->has(i))
              control.strain[i] = value(k, i) - driven.path.strain[i];
          driven.begin(control, by_stress == before);
          before = by_stress;
          driven.follow(1., "row " + std::to_string(k));
          append(lines, 1);
        }
      return as_array(lines);
    }

    /** Follows the section Path from the initial state. @return a line for the start
     *  and for each increment */
    py::array_t<double>
    run()
    {
      stages.prepare(*driven.point, table.names());
      restart();
      std::vector<double> lines;
      append(lines, 0);
      unsigned int number = 0;
      for (const auto &stage : stages.list)
        {
          ++number;
          driven.begin(stage->control(*driven.point));
          for (const double f : stage->positions())
            {
              driven.follow(f, stage->name);
              append(lines, number);
              if (stage->stops(lines.data() + lines.size() - columns.size()))
                break;
            }
        }
      return as_array(lines);
    }

    void
    restart()
    {
      driven.restart();
      before = {};
    }

    bool
    has(const unsigned int component) const
    {
      return driven.point->has(component);
    }

    const Tensor6 &
    strain() const
    {
      return driven.path.strain;
    }

    std::string              changed;
    std::vector<std::string> columns;

  private:
    /** Forgets the declarations of earlier points, which keep their values. */
    static ParameterFile
    declare(const std::vector<std::string> &settings)
    {
      of_other_laws();
      dealii::ParameterAcceptor::prm.clear();
      declare_units();
      return ParameterFile::from_text("", "parameters", settings);
    }

    void
    append(std::vector<double> &lines, const unsigned int stage) const
    {
      // A long path can be interrupted.
      if (lines.size() % (1024 * columns.size()) == 0 &&
          PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      const std::vector<double> now = line(stage);
      lines.insert(lines.end(), now.begin(), now.end());
    }

    py::array_t<double>
    as_array(const std::vector<double> &lines) const
    {
      const std::size_t width = columns.size();
      return py::array_t<double>({lines.size() / width, width}, lines.data());
    }

    const ParameterFile            file;
    DrivenPoint                    driven;
    ElementPath                    stages;
    StatisticsTable<ElementRecord> table;
    std::array<bool, 6>            before{};
  };
} // namespace

PYBIND11_MODULE(geocone_point, module)
{
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::class_<Point>(module, "Point")
    .def(py::init<const std::vector<std::string> &>())
    .def_readonly("changed", &Point::changed)
    .def_readonly("columns", &Point::columns)
    .def("has", &Point::has)
    .def("stress", &Point::stress)
    .def("strain", &Point::strain)
    .def("line", &Point::line)
    .def("follow", &Point::follow)
    .def("restart", &Point::restart)
    .def("run", &Point::run);
}
