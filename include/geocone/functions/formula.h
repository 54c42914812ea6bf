// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_formula_h
#define geocone_functions_formula_h

#include <geocone/base/types.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Variables that a formula may contain. */
  enum class FormulaVariables
  {
    place_and_time,
    place,
    time
  };

  /** Description of the formula syntax, for error messages. */
  std::string
  allowed_formula(const FormulaVariables variables);

  /**
   * Checks the syntax of a formula before muParser parses the formula. The
   * grammar excludes input that muParser accepts: "x = 3" assigns, "0,5" is a
   * list with the value 5, rand() differs from run to run. It also prevents
   * muParser from printing error messages. Grammar:
   *   formula := operand {operator operand} ["?" formula ":" formula]
   *   operand := ["+" | "-"] (number | name |
   *              function "(" formula {"," formula} ")" | "(" formula ")")
   * with the operators + - * / ^ < > <= >= == != & |, the names of the
   * variables, pi, _pi and _e, and the functions listed in CONTRIBUTING.md.
   * @throws InputError with the position of the error
   */
  void
  check_formula(
    const std::string     &text,
    const std::string     &parameter,
    const FormulaVariables variables = FormulaVariables::place_and_time);
} // namespace geocone::GEOCONE_DIM

#endif
