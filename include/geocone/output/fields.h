// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_fields_h
#define geocone_output_fields_h

#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/space.h>
#include <geocone/time_stepping/time_stepper.h>

#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Fields as files for ParaView, and, the VTU files, for scripts/plot:
   *  - cells-NNNN.vtu: displacement and velocity on the mesh (cells of degree p
   *    as p^2 linear ones), and per cell the material, the mean stress, the mean
   *    plastic strain rate and the mean cumulative plastic strain. Of points
   *    that move: only the cells with points, and the velocity only;
   *  - points-NNNN.vtu: the material points with their volume per unit thickness
   *    (m^2), stress (Pa), plastic strain, plastic strain rate (1/s) and
   *    cumulative plastic strain; of points that move also their velocity and
   *    displacement;
   *  - cells.pvd, points.pvd: the series in time.
   * On several ranks a file per rank, and .pvtu records that join them. Or, one
   * file of all ranks for each time, cells-NNNN.h5 and points-NNNN.h5 with the
   * series cells.xdmf and points.xdmf.
   */
  class Fields
  {
  public:
    /** Chooses the files: vtu (what is written without choice), hdf5 or both.
     *  @throws InputError for anything else */
    void
    set_format(const std::string &name);

    void
    write(const std::string    &folder,
          const unsigned int    number,
          const double          time,
          const BackgroundMesh &mesh,
          const Space          &space,
          const MaterialPoints &points,
          const Kinematics     &kinematics);

  private:
    /** What cells.pvd and cells.xdmf, or those of the points, list. */
    struct Series
    {
      std::vector<std::pair<double, std::string>> vtu;
      std::vector<std::string>                    hdf5;
    };
    Series cells, point_clouds;
    bool   vtu = true, hdf5 = false;
  };
} // namespace geocone

#endif
