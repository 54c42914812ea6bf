// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_expression_h
#define geocone_scene_expression_h

#include <geocone/base/types.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace geocone
{
  /**
   * A scalar function of (x, y, t) given as text in muParser's language, with
   * the constant pi.
   */
  class Expression
  {
  public:
    /**
     * @param text the formula
     * @param parameter name for messages
     * @throws InputError if the formula cannot be parsed
     */
    void
    prepare(const std::string &text, const std::string &parameter);

    double
    value(const dealii::Point<dim> &x, const double t) const;

  private:
    std::unique_ptr<dealii::FunctionParser<dim>> function;
  };
} // namespace geocone

#endif
