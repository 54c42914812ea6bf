// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_shakedown_problem_h
#define geocone_shakedown_shakedown_problem_h

#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/shakedown/elastic_stresses.h>
#include <geocone/shakedown/varying_loads.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Problem of a side with dead loads only. */
  BoundProblem
  with_dead_loads(const BoundScene   &bound,
                  const VaryingLoads &loads,
                  const BoundSide     side);

  /** Load vectors of all loads, with the factor 1. */
  std::vector<Eigen::VectorXd>
  load_vectors(const BoundScene   &bound,
               const VaryingLoads &loads,
               const BoundSide     side,
               const unsigned int  n_dofs);

  /** Combination of the fields of all loads.
   *  @param minus state whose combination is subtracted, or -1 */
  LinearField
  of_state(const VaryingLoads             &loads,
           const std::vector<LinearField> &fields,
           const unsigned int              state,
           const int                       minus = -1);

  /**
   * Problem of all states of the loads. The points of the first state keep the dofs of
   * the mesh; those of each further state are additional cells. Their stresses differ
   * from those of the state before by the load factor times the difference of the
   * elastic stresses, which is equilibrium of further dofs w of each point. The rates
   * are e_1 = B q - w_2, e_k = w_k - w_{k+1}: those of all states add up to B q.
   * @param first with_dead_loads()
   * @param fields elastic stresses of all loads
   * @param forces vectors of all loads
   */
  BoundProblem
  of_all_states(const BoundProblem                 &first,
                const VaryingLoads                 &loads,
                const std::vector<LinearField>     &fields,
                const std::vector<Eigen::VectorXd> &forces,
                const BoundSide                     side);

  /** Stresses of all states from those of the first one. They are scaled into their
   *  cones where no dead load prevents it, and replace those of the solver, which tie
   *  the states up to rounding. */
  void
  tie_states(const BoundProblem             &problem,
             const VaryingLoads             &loads,
             const std::vector<LinearField> &fields,
             CertifiedSide                  &side);
} // namespace geocone::GEOCONE_DIM

#endif
