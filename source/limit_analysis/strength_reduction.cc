// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/strength_reduction.h>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    class ReducedPlane : public SafetySearch::Solver
    {
    public:
      ReducedPlane(const StrengthReduction::Reduced &reduced,
                   const double                      tolerance,
                   StrengthReduction::Level         &level)
        : reduced(reduced)
        , tolerance(tolerance)
        , level(level)
      {}

      std::array<SafetySearch::Attempt, 2>
      both(const double F) override
      {
        level.bounds = certified_bounds(reduced(F), tolerance);
        return {
          {figures_of(level.bounds.lower), figures_of(level.bounds.upper)}};
      }

      SafetySearch::Attempt
      one(const double F, const SafetySearch::Side side) override
      {
        last[side] = side == SafetySearch::lower
                       ? certified_lower(reduced(F), tolerance)
                       : certified_upper(reduced(F), tolerance);
        return figures_of(last[side]);
      }

      void
      keep(const SafetySearch::Side side) override
      {
        (side == SafetySearch::lower ? level.lower_proof : level.upper_proof) =
          last[side];
      }

    private:
      static SafetySearch::Attempt
      figures_of(const CertifiedSide &side)
      {
        return {side.bound.load,
                side.bound.certified,
                side.solution.grows,
                side.solution.factorisations,
                side.bound.rejection};
      }

      const StrengthReduction::Reduced &reduced;
      const double                      tolerance;
      StrengthReduction::Level         &level;

      std::array<CertifiedSide, 2> last; ///< by SafetySearch::Side
    };
  } // namespace

  StrengthReduction::Level
  StrengthReduction::on_mesh(const Reduced &reduced, const double tolerance)
  {
    Level        level;
    ReducedPlane solver(reduced, tolerance, level);
    static_cast<SafetySearch::Level &>(level) = search.on_mesh(solver);
    return level;
  }
} // namespace geocone::GEOCONE_DIM
