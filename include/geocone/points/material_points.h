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
   * Discretised continuum on this rank: contiguous arrays over points that are
   * sorted by cell, with the shape functions there. It is the incremental
   * problem's only view of FEM or MPM. Everything here belongs to t_n and is
   * constant during a step.
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

    /** Nodes per cell. */
    unsigned int n_nodes = 0;

    /** Cells with points. */
    std::vector<dealii::Triangulation<dim>::active_cell_iterator> cells;

    /** The points of cell c are first_point[c] ... first_point[c + 1] - 1. */
    std::vector<unsigned int> first_point = {0};

    /** Weight of a point in integrals over the body (m^2; in axisymmetry m^3):
     *  its volume, unless make_consistent() has changed it. */
    std::vector<double> weight;

    /** Local numbers of the nodes of a cell: n_nodes per cell. */
    std::vector<unsigned int> nodes;

    /** grad N at a point: n_nodes values of d/dx, then n_nodes of d/dy (1/m). */
    std::vector<double> gradients;

    /** N/r at a point, for the hoop strain of v_x: n_nodes values (1/m). Empty
     *  in plane strain. */
    std::vector<double> hoop;

    /** N at a point: n_nodes values. Empty for fixed points. */
    std::vector<double> values;

    /**
     * Gradients for the volumetric strain at a point in place of grad N, in the
     * layout of gradients (B-bar); in axisymmetry including the hoop strain.
     * Empty without B-bar.
     */
    std::vector<double> volumetric_gradients;
    /** Number of polynomials per cell that they are projected onto, the same on
     *  all ranks; 0 without projection. */
    unsigned int n_volumetric_modes = 0;
    /** Values at a point of a basis of these polynomials, with sum_p V_p M_i
     *  M_j = delta_ij in each cell. M_j is 0 at all points of a cell if they
     *  cannot distinguish it from those before it. */
    std::vector<double> volumetric_modes;

    /** History of a point, or null. */
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
     *  velocity, nor variables derived from them. */
    void
    use(const bool moving, const unsigned int n_history);

    /** Appends a point with the numbers of a row. */
    void
    append(const double *row);
  };

  /** Computes the volumetric gradients: in each cell the volume-weighted
   *  projection of grad N (in axisymmetry of d/dr + 1/r) onto the polynomials
   *  of x of a degree, 0 being the mean. Cells without more points than
   *  polynomials do not change. */
  void
  project_gradients(const unsigned int degree, MaterialPoints &points);
} // namespace geocone::GEOCONE_DIM

#endif
