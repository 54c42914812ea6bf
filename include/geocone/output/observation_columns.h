// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_observation_columns_h
#define geocone_output_observation_columns_h

#include <geocone/output/expectations.h>
#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/observation.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace geocone
{
  /** @name What both kinds of runs report of Scene::observation: columns of
   *  statistics.csv, their values, and a topic of summary.json */
  /** @{ */
  void
  add_observation_columns(const Observation        &observation,
                          const BoundaryConditions &conditions,
                          std::vector<std::string> &columns);
  void
  add_observations(const std::vector<double>                 &moments,
                   const std::vector<dealii::Tensor<1, dim>> &displacements,
                   std::vector<double>                       &line);
  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             Json                                      &summary);
  /** @} */
} // namespace geocone

#endif
