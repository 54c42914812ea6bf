// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_interval_functions_h
#define geocone_functions_interval_functions_h

#include <geocone/base/types.h>

#include <boost/numeric/interval.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Interval of real numbers. Bounds are rounded to nearest; linear bounds of formulas are
   *  widened by more than the rounding errors. */
  using RealInterval = boost::numeric::interval<
    double,
    boost::numeric::interval_lib::policies<
      boost::numeric::interval_lib::rounded_transc_exact<double>,
      boost::numeric::interval_lib::checking_base<double>>>;

  /** Box of positions (m). */
  using IntervalBox = std::array<RealInterval, dim>;

  /** Bounds of the values and the gradient of a function in a box. */
  struct Enclosure
  {
    RealInterval value;
    std::array<RealInterval, dim>
      gradient; ///< generalised; of Lipschitz functions

    /** False if the function may jump, or its gradient be infinite. */
    bool is_lipschitz = true;
  };

  /** Enclosures of the functions of formulas, from those of their arguments: natural
   *  interval extensions, gradients by the chain rule (Moore et al. 2009). */
  namespace enclosures
  {
    Enclosure
    constant(const RealInterval &value);

    Enclosure
    negative(const Enclosure &x);

    /** a where the condition is not zero, else b. */
    Enclosure
    choice(const RealInterval &condition,
           const Enclosure    &a,
           const Enclosure    &b);

    using Operator = Enclosure (*)(const Enclosure &, const Enclosure &);

    /** Returns the operator of a name that check_formula() accepts, e.g. "+". */
    Operator
    operator_of(const std::string &name);

    using Function = std::function<Enclosure(const std::vector<Enclosure> &)>;

    /** Returns the function of a name that check_formula() accepts. */
    Function
    function_of(const std::string &name);
  } // namespace enclosures
} // namespace geocone::GEOCONE_DIM

#endif
