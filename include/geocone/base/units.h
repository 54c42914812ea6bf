// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_units_h
#define geocone_base_units_h

#include <functional>
#include <string>

namespace geocone
{
  /**
   * Systems of units of a scene, SI (kg, N, Pa, J) and kN-m (t, kN, kPa, kJ). Both are
   * consistent, with metres and seconds, so that formulas hold in both and numbers are
   * never converted: they differ in the unit of mass, and so in those of forces, stresses
   * and energies.
   */

  /** Sets the system of units used in all texts. @param word of
   *  'Analysis/Units' */
  void
  choose_units(const std::string &word);

  /** Present unit of mass (kg): 1 or 1000. */
  double
  mass_unit();

  /** Replaces SI units that follow a number or a parenthesis in a text or a
   *  column name by the present ones: "12 Pa", "load (N/m)". */
  std::string
  in_units(const std::string &text);

  /** Counterpart of an SI unit in the present system, "kN/m" of "N/m". */
  std::string
  present_unit(const std::string &unit);

  /** A key of summary.json with present units, "p_kPa" of "p_Pa". */
  std::string
  key_in_units(const std::string &key);

  /** Unit of a parameter's value, given in brackets in its text; empty:
   *  none. */
  std::string
  unit_in(const std::string &documentation);

  /** Converts the defaults of all declared parameters to present units, except
   *  those that a file sets. @param is_set whether it does so, by
   *  "Section/Name" */
  void
  convert_defaults(const std::function<bool(const std::string &)> &is_set);

  /** Declares the parameter 'Analysis/Units', which ParameterFile::parse()
   *  evaluates before all others. */
  void
  declare_units();
} // namespace geocone

#endif
