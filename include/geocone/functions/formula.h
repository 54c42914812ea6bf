// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_formula_h
#define geocone_functions_formula_h

#include <geocone/base/types.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Variables of a formula. */
  enum class FormulaOf
  {
    place_and_time,
    place,
    time
  };

  /** Syntax of admissible formulas, for messages. */
  std::string
  allowed_formula(const FormulaOf variables);

  /**
   * Checks a formula before muParser parses it, by the grammar given here.
   * muParser accepts more ("x = 3" assigns, "0,5" is a list whose last value
   * counts, rand() differs from run to run) and prints its own error messages.
   * Grammar:
   *   formula := operand {operator operand} ["?" formula ":" formula]
   *   operand := ["+" | "-"] (number | name |
   *              function "(" formula {"," formula} ")" | "(" formula ")")
   * with the operators + - * / ^ < > <= >= == != & |, the names of the
   * variables, pi, _pi and _e, and the functions listed in CONTRIBUTING.md.
   * @throws InputError with the position of the error
   */
  void
  check_formula(const std::string &text,
                const std::string &parameter,
                const FormulaOf    variables = FormulaOf::place_and_time);
} // namespace geocone::GEOCONE_DIM

#endif
