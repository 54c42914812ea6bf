// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/plane_bounds/bound_loads.h>
#include <geocone/shakedown/varying_loads.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_varying_loads[] = {
      {"Shakedown/*", "Analysis/Kind", {"shakedown"}}};

    constexpr unsigned int most_states = 64;
  } // namespace

  VaryingLoads::VaryingLoads()
    : dealii::ParameterAcceptor("/Shakedown")
  {
    add_parameter("Loads",
                  names,
                  "Names of the 'Tractions' that vary; the others and the "
                  "weight are constant and not multiplied by the shakedown "
                  "factor. Empty: all tractions vary.");
    add_parameter("Minimum factors",
                  minima,
                  "Least factor of each load that varies [-], in the order of "
                  "'Loads'. Empty: 0 for all of them.");
    add_parameter("Maximum factors",
                  maxima,
                  "Greatest factor of each load that varies [-], in the order "
                  "of 'Loads'; equal to the least one: the load is constant "
                  "and multiplied by the shakedown factor. Empty: 1 for all of "
                  "them.");
    add_parameter("Times",
                  times,
                  "Times t [s] at which the formulas of the loads give their "
                  "states, one after the other, instead of a box of factors: "
                  "for loads that move or depend on each other. Empty: the "
                  "loads vary independently.");
  }

  void
  VaryingLoads::prepare(const Scene &scene)
  {
    const auto &all = scene.tractions.names();
    if (all.empty())
      throw InputError("Tractions/Names",
                       "",
                       "a load that varies where 'Analysis/Kind' = shakedown",
                       "give tractions; 'Shakedown/Loads' says which of them "
                       "vary");
    varying.clear();
    for (const std::string &name : names.empty() ? all : names)
      {
        const auto found = std::find(all.begin(), all.end(), name);
        if (found == all.end())
          throw InputError("Shakedown/Loads",
                           name,
                           "names of 'Tractions/Names'",
                           "list the tractions that vary");
        const unsigned int place = found - all.begin();
        if (std::count(varying.begin(), varying.end(), place) > 0)
          throw InputError("Shakedown/Loads",
                           name,
                           "each name once",
                           "leave it out the second time");
        varying.push_back(place);
      }
    names_of_loads.clear();
    for (const unsigned int place : varying)
      names_of_loads.push_back(all[place]);
    if (!varies_in_time())
      return take_corners();
    if (!minima.empty() || !maxima.empty())
      throw InputError(
        minima.empty() ? "Shakedown/Maximum factors"
                       : "Shakedown/Minimum factors",
        dealii::Patterns::Tools::to_string(minima.empty() ? maxima : minima),
        "empty with 'Shakedown/Times'",
        "the formulas of the loads give their values at these "
        "times");
    if (times.size() < 2 || times.size() > most_states)
      throw InputError("Shakedown/Times",
                       dealii::Patterns::Tools::to_string(times),
                       format("2 to %u times", most_states),
                       "a load that does not vary is a limit load, with "
                       "'Analysis/Kind' = limit load");
    factors.assign(times.size(), std::vector<double>(times.size(), 0.));
    for (unsigned int k = 0; k < times.size(); ++k)
      factors[k][k] = 1.;
  }

  void
  VaryingLoads::take_corners()
  {
    const unsigned int n = varying.size();
    for (const auto &[given, entry, value] :
         {std::tuple<std::vector<double> *, const char *, double>(
            &minima, "Shakedown/Minimum factors", 0.),
          {&maxima, "Shakedown/Maximum factors", 1.}})
      {
        if (given->empty())
          given->assign(n, value);
        if (given->size() != n)
          throw InputError(entry,
                           dealii::Patterns::Tools::to_string(*given),
                           format("%u factors, one for each load", n),
                           "give them in the order of 'Shakedown/Loads'");
      }
    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!(minima[i] <= maxima[i]))
          throw InputError("Shakedown/Maximum factors",
                           maxima[i],
                           format("at least %g, the minimum factor of '%s'",
                                  minima[i],
                                  names_of_loads[i].c_str()),
                           "exchange both");
        if (minima[i] < maxima[i])
          free.push_back(i);
      }
    if (free.empty())
      throw InputError("Shakedown/Maximum factors",
                       dealii::Patterns::Tools::to_string(maxima),
                       "for one load more than the minimum factor",
                       "constant loads have a limit load, with "
                       "'Analysis/Kind' = limit load");
    if ((1U << std::min<std::size_t>(free.size(), 31)) > most_states)
      throw InputError(
        "Shakedown/Loads",
        dealii::Patterns::Tools::to_string(names),
        format("6 loads that vary, %u corners, at most", most_states),
        "let some of them vary together, with "
        "'Shakedown/Times'");
    // Gray's code: one load changes from corner to corner.
    factors.clear();
    for (unsigned int number = 0; number < 1U << free.size(); ++number)
      {
        std::vector<double> corner = minima;
        for (unsigned int i = 0; i < free.size(); ++i)
          if (((number ^ (number >> 1)) >> i) & 1U)
            corner[free[i]] = maxima[free[i]];
        factors.push_back(corner);
      }
  }

  std::string
  VaryingLoads::name_of(const unsigned int state) const
  {
    if (varies_in_time())
      return format("t = %g s", times[state]);
    std::string name;
    for (unsigned int i = 0; i < varying.size(); ++i)
      name += (i > 0 ? ", " : "") + format("%g ", factors[state][i]) +
              names_of_loads[i];
    return name;
  }

  void
  VaryingLoads::add(const BoundScene  &bound,
                    const BoundSide    side,
                    const unsigned int load,
                    Eigen::VectorXd   &F) const
  {
    const auto &all = bound.scene.tractions.list;
    if (!varies_in_time())
      return add_tractions(bound, side, *all[varying[load]], F);
    for (const unsigned int place : varying)
      add_tractions(bound, side, *all[place], F, times[load]);
  }

  void
  VaryingLoads::add_constant(const BoundScene &bound,
                             const BoundSide   side,
                             Eigen::VectorXd  &F) const
  {
    const auto &all = bound.scene.tractions.list;
    for (unsigned int place = 0; place < all.size(); ++place)
      if (std::count(varying.begin(), varying.end(), place) == 0)
        add_tractions(bound, side, *all[place], F);
  }

  double
  VaryingLoads::departure(const BoundScene &bound) const
  {
    double largest = 0.;
    for (const auto &load : bound.scene.tractions.list)
      for (const double time : varies_in_time() ? times : std::vector{0.})
        largest = std::max(largest, departure_of_traction(bound, *load, time));
    return largest;
  }
} // namespace geocone::GEOCONE_DIM
