// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_pressure_functions_h
#define geocone_problem_pressure_functions_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Excess pore pressures of Consolidation, continuous and linear on triangles,
   * bilinear on quadrilaterals, on the cells that contain points. A pressure is
   * that of a vertex, and is stored at one node of the space: the vertex itself
   * or, for splines, the one of the same number along each direction.
   */
  struct PressureFunctions
  {
    unsigned int n_vertices = 0; ///< of a cell

    /** Local nodes at which the pressures of a cell are stored, n_vertices per
     *  cell. */
    std::vector<unsigned int> nodes;

    std::vector<double> N; ///< n_vertices values per point

    /** Matrices L of the cells, n_vertices^2 values each: flow per pressure,
     *  through the soil and out of it (m^4/(N s)). */
    std::vector<double> flow;

    /** Flow per volume and local pressure of a point (1/(Pa s)), see
     *  Consolidation; empty without local pressures. */
    std::vector<double> leakage;

    /** Matrices S of the cells, which smooth the changes of the pressures
     *  (m^4/N); empty where velocities and pressures are inf-sup stable. */
    std::vector<double> smoothing;

    bool
    smooths() const
    {
      return !smoothing.empty();
    }

    std::vector<bool> is_drained; ///< whether p = 0, by local node
  };

  /** Pressures on a mesh with fixed quadrature points. With velocities of degree
   *  2 and 3 they are Taylor-Hood elements, which satisfy the inf-sup condition.
   *  Local pressures leak at the rate of the slowest pressure between drained
   *  edges in half of a cell, which velocities of degree 2 resolve: (2 pi)^2
   *  times the trace of the mobility k/gamma in unit coordinates, exact in
   *  rectangles, and twice as much on triangles, exact in equilateral ones.
   *  @param is_drained by local node
   *  @throws InputError for a material without pore fluid or permeability */
  PressureFunctions
  pressures_of_elements(const Scene          &scene,
                        const BackgroundMesh &mesh,
                        const Space          &space,
                        const MaterialPoints &points,
                        std::vector<bool>     is_drained);

  /** Whether a side of the mesh is drained at a place. */
  using DrainedAt = std::function<bool(const dealii::types::boundary_id side,
                                       const dealii::Point<dim>        &place)>;

  /**
   * Pressures on a background mesh with particles. The flow is that through
   * whole cells, whose mobility k/gamma is the mean over their particles. Faces
   * towards cells without particles, and those of drained sides, are surfaces
   * of the soil where p = 0 is imposed by an outflow per area c p (m/s) with
   *   c = alpha (k/gamma)/d
   * for cells of size d. The part f of a cell at a free surface is filled;
   * functions are those of this part, and gradients towards the surface are
   * scaled such that the flow from the inner vertices, and out, is that over the
   * distance f d. Where k tends to zero, so does the outflow. Collective.
   *
   * Velocities of splines and pressures of the vertices are not inf-sup stable.
   * The changes of the pressures are smoothed by
   *   S = beta/(2G) int (N - mean N)' (N - mean N)
   * in each cell (Bochev, Dohrmann and Gunzburger 2006, White and Borja 2008).
   * @param is_drained of a side and a place on it
   * @throws InputError for a material without pore fluid or permeability
   */
  PressureFunctions
  pressures_of_particles(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space,
                         const MaterialPoints &points,
                         const DrainedAt      &is_drained);
} // namespace geocone::GEOCONE_DIM

#endif
