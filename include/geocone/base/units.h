// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_units_h
#define geocone_base_units_h

#include <functional>
#include <string>

namespace geocone
{
  /**
   * Supported systems of units: SI (kg, N, Pa, J) and kN-m (t, kN, kPa, kJ). Both
   * are consistent and use metres and seconds, so that formulas hold in both and
   * values are never converted. They differ in the unit of mass and hence in the
   * units of force, stress and energy.
   */

  /** Selects the system of units of the run (SI or kN-m). @param word value of
   *  the parameter 'Analysis/Units' */
  void
  choose_units(const std::string &word);

  /** Unit of mass (kg) in the selected system of units: 1 (SI) or 1000
   *  (kN-m). */
  double
  mass_unit();

  /** Replaces the SI units in a text or column name with the units of the
   *  selected system. Units must follow a number or a parenthesis: "12 Pa",
   *  "load (N/m)". */
  std::string
  in_units(const std::string &text);

  /** Returns the unit of the selected system of units that replaces an SI unit,
   *  e.g. "kN/m" for "N/m". */
  std::string
  present_unit(const std::string &unit);

  /** Replaces the SI unit in a key of summary.json with the selected unit, e.g.
   *  "p_Pa" by "p_kPa". */
  std::string
  key_in_units(const std::string &key);

  /** Extracts the unit of a parameter from its documentation, where the unit is
   *  given in brackets. Empty if no unit is given. */
  std::string
  unit_in(const std::string &documentation);

  /** Converts the default values of declared parameters to the selected system of
   *  units. Parameters set by the parameter file are excluded.
   *  @param is_set whether the file sets the parameter "Section/Name" */
  void
  convert_defaults(const std::function<bool(const std::string &)> &is_set);

  /** Declares the parameter 'Analysis/Units', which ParameterFile::parse()
   *  evaluates before all others. */
  void
  declare_units();
} // namespace geocone

#endif
