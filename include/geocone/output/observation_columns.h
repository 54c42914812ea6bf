// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_observation_columns_h
#define geocone_output_observation_columns_h

#include <geocone/base/log.h>
#include <geocone/output/expectations.h>
#include <geocone/output/statistics_table.h>
#include <geocone/scene/geometry.h>
#include <geocone/scene/observation.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Adds what both kinds of runs report of Scene::observation to their tables.
   * @param moment of a record, an observed condition and an axis of n_rotations (N m/m);
   * none of a round body, which moments do not turn
   * @param displacement of a record, an observed point and a component (m)
   */
  template <typename Record, typename Moment, typename Displacement>
  void
  add_observations(StatisticsTable<Record>        &table,
                   const Observation              &observation,
                   const std::vector<std::string> &supports,
                   const Geometry                 &geometry,
                   const Moment                   &moment,
                   const Displacement             &displacement)
  {
    for (unsigned int i = 0;
         i < observation.conditions.size() && !geometry.is_axisymmetric();
         ++i)
      for (unsigned int axis = 0; axis < n_rotations; ++axis)
        table.add(
          "moment " + supports[observation.conditions[i]] +
            (dim == 2 ? "" : " " + axis_of_rotation(axis)) +
            geometry.unit(" (N m/m)"),
          [moment, i, axis](const Record &record) {
            return moment(record, i, axis);
          },
          Finite::may_be);
    for (unsigned int i = 0; i < observation.points.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        table.add(
          format("displacement of point %u %c (m)", i + 1, "xyz"[d]),
          [displacement, i, d](const Record &record) {
            return displacement(record, i, d);
          },
          Finite::may_be);
  }

  /** The same for the topic "points" of summary.json. */
  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             const std::vector<double>                 &excess_pressures,
             Json                                      &summary);
} // namespace geocone::GEOCONE_DIM

#endif
