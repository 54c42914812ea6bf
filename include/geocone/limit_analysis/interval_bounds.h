// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interval_bounds_h
#define geocone_limit_analysis_interval_bounds_h

#include <geocone/bounds/safety_search.h>
#include <geocone/folder/expectations.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/limit_analysis/parameter_intervals.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Certified bounds on a load or factor of safety for all parameters in a box of
   * intervals ("Parameter intervals"), on one mesh.
   *
   * Lower bound: the strength of a material is the intersection of all its strengths,
   * which is that of the cones of the smallest cohesion with both limits of the friction
   * angle, and the least tensile strength. Loads are at a corner: the carried loads are
   * convex, so the least lower bound of all corners holds within.
   *
   * Upper bound: the strength is the convex hull of the union, a cone with the largest
   * friction angle and a cohesion enlarged by tan(phi_2)/tan(phi_1), or with a tensile
   * strength T by T (tan(phi_2) - tan(phi_1)) if that is less. The load of one mechanism
   * is monotone in each load, so its largest value is that of a corner. The box is
   * divided where these enlargements, or loads that act in either direction, cost most
   * (doc/theory/interval_bounds.md).
   */
  class IntervalBounds
  {
  public:
    /** Declares the parameter "Parameter intervals" in a section. */
    void
    declare(dealii::ParameterAcceptor &section);

    bool
    is_asked() const
    {
      return !text.empty();
    }

    /** Reads the intervals. @param bound input on the first mesh @throws InputError for
     *  intervals for which nothing is proven */
    void
    prepare(const BoundScene &bound);

    /** Bounds for the whole box in the unit of the load, empty if not certified, and the
     *  parameters with which they were computed: two numbers of each interval. */
    struct Answer
    {
      std::optional<double>              lower, upper;
      std::vector<std::array<double, 2>> at_lower, at_upper;
      std::array<unsigned int, 2> n_solutions = {{0, 0}}; ///< by BoundSide
      std::array<std::string, 2>  reason; ///< why there is none, by BoundSide

      bool
      is_asked() const
      {
        return n_solutions[0] + n_solutions[1] > 0;
      }
    };

    /** Bounds the load for the whole box. @param given input with given strength
     *  @param tolerance of the interior-point method @param gap above the largest value
     *  of the box that the upper bound may have, relative to it @param unit load that
     *  corresponds to the load factor 1 */
    Answer
    of_load(const BoundScene &given,
            const double      tolerance,
            const double      gap,
            const double      unit) const;

    /** Bounds the factor of safety for the whole box. @param start initial guesses,
     *  lower and upper @param search with the exponent of the last mesh */
    Answer
    of_safety(const BoundScene           &given,
              const double                tolerance,
              const double                gap,
              const std::array<double, 2> start,
              const SafetySearch         &search) const;

    /** Converts an answer to the JSON object bounds/interval of summary.json. */
    Json
    topic_of(const Answer &answer) const;

    /** Returns an answer as text. @param bounded name of the quantity
     *  @param is_associated whether the flow of the given soil is associated */
    std::string
    text_of(const Answer      &answer,
            const std::string &bounded,
            const std::string &unit,
            const bool         is_associated) const;

    /** Warnings of bounds that are not certified, with the reason. */
    std::vector<std::string>
    warnings_of(const Answer &answer, const std::string &bounded) const;

  private:
    using Ranges = std::vector<std::array<double, 2>>; ///< by interval

    class Box;
    struct Side;

    void
    check_loads(const BoundScene &bound) const;

    /** Input with the strengths of the whole box that are in all of them (lower), or
     *  that contain them (upper), divided by F. @param ranges of a part of the box
     *  @param is_plain upper: those of the largest parameters instead */
    BoundScene
    with_strengths(BoundScene      bound,
                   const BoundSide side,
                   const Ranges   &ranges,
                   const double    F,
                   const bool      is_plain = false) const;

    /** Least lower bound of all corners of the loads. */
    Side
    lower(const BoundScene &given,
          const double      F,
          const double      tolerance) const;

    /** Upper bound of all loads of the box. */
    Side
    upper(const BoundScene &given,
          const double      F,
          const double      tolerance,
          const double      gap) const;

    Ranges
    all_ranges() const;

    std::string                    text;
    std::vector<ParameterInterval> intervals;
  };
} // namespace geocone::GEOCONE_DIM

#endif
