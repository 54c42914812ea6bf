// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_varying_loads_h
#define geocone_shakedown_varying_loads_h

#include <geocone/plane_bounds/bound_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Loads that vary in a shakedown analysis. They are either tractions, each between its
   * own least and greatest factor and independent of the others, or all tractions that
   * vary together, as they are at a list of times. The states of the loads are the corners
   * of the box of factors, or these times. Each load has an elastic stress field.
   */
  class VaryingLoads : public dealii::ParameterAcceptor
  {
  public:
    VaryingLoads();

    /** Selects the loads and their states. @throws InputError */
    void
    prepare(const Scene &scene);

    /** Number of loads with elastic stresses of their own. */
    unsigned int
    n_loads() const
    {
      return varies_in_time() ? times.size() : varying.size();
    }

    /** Factors of all loads, for each state. Consecutive corners of a box differ by one
     *  load. */
    const std::vector<std::vector<double>> &
    states() const
    {
      return factors;
    }

    /** Returns the name of a state: the factors of the loads, or the time. */
    std::string
    name_of(const unsigned int state) const;

    /** Adds a load, with the factor 1, to the load vector F of a problem. */
    void
    add(const BoundScene  &bound,
        const BoundSide    side,
        const unsigned int load,
        Eigen::VectorXd   &F) const;

    /** Adds the tractions that do not vary to the load vector F of a problem. */
    void
    add_constant(const BoundScene &bound,
                 const BoundSide   side,
                 Eigen::VectorXd  &F) const;

    /** Largest departure_of_traction() of all tractions in all states. */
    double
    departure(const BoundScene &bound) const;

  private:
    bool
    varies_in_time() const
    {
      return !times.empty();
    }

    /** Lists the corners of the box of factors. @throws InputError */
    void
    take_corners();

    std::vector<std::string> names; ///< empty: all tractions
    std::vector<double>      minima, maxima, times;

    std::vector<unsigned int>        varying; ///< positions among the tractions
    std::vector<std::vector<double>> factors;
    std::vector<std::string>         names_of_loads;
  };
} // namespace geocone::GEOCONE_DIM

#endif
