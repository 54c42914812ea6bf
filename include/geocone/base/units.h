// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_units_h
#define geocone_base_units_h

#include <functional>
#include <string>

namespace geocone
{
  /**
   * Systems of units of a scene: SI (kg, N, Pa, J) or kN-m (t, kN, kPa, kJ). Both are
   * consistent and use metres and seconds, so that formulas hold in both and values are
   * never converted. They differ in the unit of mass and hence in the units of force,
   * stress and energy.
   */

  /** Selects the system of units used in all texts. @param word value of the
   *  parameter 'Analysis/Units' */
  void
  choose_units(const std::string &word);

  /** Unit of mass of the selected system (kg): 1 or 1000. */
  double
  mass_unit();

  /** Replaces SI units in a text or column name by units of the selected system.
   *  Units must follow a number or a parenthesis: "12 Pa", "load (N/m)". */
  std::string
  in_units(const std::string &text);

  /** Counterpart of an SI unit in the selected system, e.g. "kN/m" for "N/m". */
  std::string
  present_unit(const std::string &unit);

  /** Key of summary.json with the unit of the selected system, e.g. "p_kPa" for
   *  "p_Pa". */
  std::string
  key_in_units(const std::string &key);

  /** Unit of a parameter, given in brackets in its documentation; empty if the
   *  documentation states none. */
  std::string
  unit_in(const std::string &documentation);

  /** Converts the default values of all declared parameters to the selected
   *  system of units, except for parameters set by the parameter file.
   *  @param is_set whether the file sets the parameter "Section/Name" */
  void
  convert_defaults(const std::function<bool(const std::string &)> &is_set);

  /** Declares the parameter 'Analysis/Units', which ParameterFile::parse()
   *  evaluates before all others. */
  void
  declare_units();
} // namespace geocone

#endif
