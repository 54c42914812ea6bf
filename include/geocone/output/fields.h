// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_fields_h
#define geocone_output_fields_h

#include <geocone/boundary/obstacles.h>
#include <geocone/output/field_files.h>
#include <geocone/points/material_points.h>
#include <geocone/space/space.h>
#include <geocone/time_stepping/time_stepper.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Writer of field files for ParaView. The VTU files are also read by scripts/plot.
   * The files are:
   *  - cells-NNNN.vtu: displacement and velocity on the mesh (cells of degree p as
   *    p^dim linear cells), and per cell the material, the mean stress, the mean
   *    plastic strain
   *    rate, the mean cumulative plastic strain, and for undrained soil the mean excess
   *    pore pressure. With particles: only cells with particles, only the velocity;
   *  - points-NNNN.vtu: the material points with their material, volume (m^dim; if
   *    axisymmetric m^3, and the area in the plane of the picture), stress, excess pore
   *    pressure (Pa), plastic strain, plastic strain rate (1/s), cumulative plastic
   *    strain, and output quantities of the laws; particles also with their number, velocity and
   *    displacement;
   *  - obstacles-NNNN.vtu: positions of the obstacles, with their numbers and
   *    displacements since the start;
   *  - cells.pvd, points.pvd, obstacles.pvd: the series in time.
   * On several ranks: a file per rank, and .pvtu files that join them; or one file of
   * all ranks for each time, cells-NNNN.h5 and points-NNNN.h5 with the series
   * cells.xdmf and points.xdmf.
   */
  class Fields
  {
  public:
    explicit Fields(const FieldsFormat format)
      : cells("cells", format)
      , point_clouds("points", format)
      , solids("obstacles", format)
    {}

    void
    write(const std::string    &folder,
          const double          time,
          const BackgroundMesh &mesh,
          const Space          &space,
          const MaterialPoints &points,
          const Materials      &materials,
          const Kinematics     &kinematics);

    /** Writes the field file with the positions of the obstacles. Collective.
     *  @param moved rigid motion of each obstacle since the start */
    void
    write_obstacles(const std::string              &folder,
                    const double                    time,
                    const BackgroundMesh           &mesh,
                    const Obstacles                &obstacles,
                    const std::vector<RigidMotion> &moved);

    /** Saves the list of field files written so far to a checkpoint, or
     *  restores it from one. */
    void
    state(StateRow &row)
    {
      row(cells, point_clouds, solids);
    }

  private:
    FieldFiles cells, point_clouds, solids;
  };
  /** Surfaces of the obstacles as triangles, on the first rank.
   *  @param moved displacements since the start
   *  @param box that shows infinite obstacles */
  FieldTable
  table_of_obstacles(const Obstacles                &obstacles,
                     const std::vector<RigidMotion> &moved,
                     const dealii::BoundingBox<dim> &box,
                     const MPI_Comm                  comm);
} // namespace geocone::GEOCONE_DIM

#endif
