// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_shakedown_proof_h
#define geocone_shakedown_shakedown_proof_h

#include <geocone/shakedown/shakedown_problem.h>

#include <array>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Alternating plasticity at a point, where strains of all states add up to zero. */
  struct AlternatingPoint
  {
    double       factor = std::numeric_limits<double>::infinity();
    unsigned int point  = 0;
    std::array<unsigned int, 2> states = {
      {0, 0}}; ///< whose stresses differ most
  };

  /** Finds the point with the least factor: no residual stress makes the stresses of
   *  all states admissible under a larger one. Where phi > 0 a pressure does. */
  AlternatingPoint
  alternating_point(const BoundProblem             &problem,
                    const std::vector<LinearField> &elastic);

  /** Upper bound by the work of the means of both elastic stresses, and its error. The
   *  error of a load does no work on compatible strains. */
  double
  proven_upper(const BoundProblem                 &above,
               const VaryingLoads                 &loads,
               const ElasticSolver                &solver,
               const std::vector<ElasticStresses> &stresses,
               const std::vector<LinearField>     &rates,
               const Bound                        &upper);

  /** Upper bound by alternating strains of two states in the triangles where their
   *  stresses differ most relative to the strength. More triangles have a smaller error
   *  of the work, fewer of them a larger work. */
  double
  proven_alternating(const BoundScene                   &bound,
                     const BoundProblem                 &problem,
                     const VaryingLoads                 &loads,
                     const ElasticSolver                &solver,
                     const std::vector<ElasticStresses> &stresses,
                     const AlternatingPoint             &at);

  /** Largest work of the differences of both elastic stresses on compatible strains,
   *  relative to that of the stresses. It vanishes if both carry the same loads, and
   *  does not where tractions are not linear between the vertices. */
  double
  difference_of_loads(const ElasticSolver                &solver,
                      const std::vector<ElasticStresses> &stresses);
} // namespace geocone::GEOCONE_DIM

#endif
