// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_fields_h
#define geocone_output_fields_h

#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/space.h>
#include <geocone/time_stepping/implicit_fem.h>

#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Fields as VTU files, for ParaView and for scripts/plot:
   *  - cells-NNNN.vtu: displacement and velocity on the mesh (cells of degree p
   *    as p^2 linear ones), and per cell the material, the mean stress, the mean
   *    plastic strain rate and the mean cumulative plastic strain;
   *  - points-NNNN.vtu: the material points with their stress (Pa), plastic
   *    strain, plastic strain rate (1/s) and cumulative plastic strain;
   *  - cells.pvd, points.pvd: the series in time.
   * On several ranks a file per rank, and .pvtu records that join them.
   */
  class Fields
  {
  public:
    void
    write(const std::string    &folder,
          const unsigned int    number,
          const double          time,
          const BackgroundMesh &mesh,
          const Space          &space,
          const MaterialPoints &points,
          const Kinematics     &kinematics);

  private:
    using Series = std::vector<std::pair<double, std::string>>;
    Series cells, point_clouds;
  };
} // namespace geocone

#endif
