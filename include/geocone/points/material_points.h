// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_material_points_h
#define geocone_points_material_points_h

#include <geocone/points/point_state.h>

#include <deal.II/grid/tria.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Discretised continuum on this rank: contiguous arrays over points sorted by
   * cell, with the shape functions at the points. The incremental problem uses
   * only these data of FEM or MPM. All data belong to t_n and are constant
   * during a step.
   */
  struct MaterialPoints : PointState<PointValues>
  {
    unsigned int
    n_points() const
    {
      return volume.size();
    }
    unsigned int
    n_cells() const
    {
      return first_point.size() - 1;
    }

    /** Number of nodes per cell. */
    unsigned int n_nodes = 0;

    /** Cells that contain points. */
    std::vector<dealii::Triangulation<dim>::active_cell_iterator> cells;

    /** The points of cell c are first_point[c] ... first_point[c + 1] - 1. */
    std::vector<unsigned int> first_point = {0};

    /** Integration weight of a point (m^2; in axisymmetry m^3): the volume of
     *  the point, unless changed by make_consistent(). */
    std::vector<double> weight;

    /** Local node numbers of the cells: n_nodes per cell. */
    std::vector<unsigned int> nodes;

    /** Gradients of the shape functions N at a point: n_nodes values of dN/dx,
     *  then n_nodes values of dN/dy (1/m). */
    std::vector<double> gradients;

    /** Shape functions divided by the radius, N/r, at a point, for the hoop
     *  strain due to v_x: n_nodes values (1/m). Empty in plane strain. */
    std::vector<double> hoop;

    /** Shape functions N at a point: n_nodes values. Empty for fixed points. */
    std::vector<double> values;

    /**
     * B-bar gradients, which replace grad N in the volumetric strain at a
     * point; layout as of gradients. In axisymmetry they include the hoop
     * strain. Empty without B-bar.
     */
    std::vector<double> volumetric_gradients;
    /** Number of polynomials per cell for the projection of the B-bar
     *  gradients, the same on all ranks; 0 without projection. */
    unsigned int n_volumetric_modes = 0;
    /** Values at a point of an orthonormal polynomial basis M_i for the B-bar
     *  projection, with sum_p V_p M_i M_j = delta_ij in each cell. M_j is 0 at
     *  all points of a cell if it is linearly dependent there on preceding
     *  basis functions. */
    std::vector<double> volumetric_modes;

    /** History variables of a point; null if there are none. */
    const double *
    history_of(const unsigned int point) const
    {
      return history.data() + static_cast<std::size_t>(n_history()) * point;
    }
    double *
    history_of(const unsigned int point)
    {
      return history.data() + static_cast<std::size_t>(n_history()) * point;
    }

    /** Excess pore pressure p (Pa), the last history variable if there is
     *  undrained soil (LawTraits::undrained). */
    double
    excess_pressure(const unsigned int point) const
    {
      return history_of(point + 1)[-1];
    }

    /** Selects the variables in use: fixed points have neither mass nor
     *  velocity, nor variables derived from mass or velocity. */
    void
    use(const bool moving, const unsigned int n_history);

    /** Appends a point with the values of a row, in the order of variables(). */
    void
    append(const double *row);
  };

  /** Computes the B-bar gradients: in each cell the volume-weighted projection
   *  of grad N (in axisymmetry of dN/dr + N/r) onto polynomials of x of the
   *  given degree; degree 0 is the mean. Cells without more points than
   *  polynomials do not change. */
  void
  project_gradients(const unsigned int degree, MaterialPoints &points);
} // namespace geocone::GEOCONE_DIM

#endif
