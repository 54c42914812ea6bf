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
   * Material points of this rank with their shape functions, as contiguous
   * arrays sorted by cell. Together they form the discretised continuum. The
   * incremental problem uses only these data of FEM or MPM. All data belong to
   * t_n and are constant during a step.
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

    /** Index of the first material point of each cell. Cell c contains the
     *  points first_point[c] to first_point[c + 1] - 1. */
    std::vector<unsigned int> first_point = {0};

    /** Integration weight of each material point (m^2; m^3 in axisymmetry). It
     *  is the volume of the point unless changed by make_consistent(). */
    std::vector<double> weight;

    /** Local node numbers of each cell, n_nodes per cell. */
    std::vector<unsigned int> nodes;

    /** Gradients of the shape functions N at each material point (1/m). For a
     *  point they are n_nodes values of dN/dx, then n_nodes values of dN/dy. */
    std::vector<double> gradients;

    /** Shape functions divided by the radius, N/r, at each material point in
     *  axisymmetry (1/m). They yield the hoop strain due to v_x; n_nodes values
     *  per point. Empty in plane strain. */
    std::vector<double> hoop;

    /** Values of the n_nodes shape functions N at each material point. Empty for
     *  fixed points. */
    std::vector<double> values;

    /**
     * Gradients of the B-bar method, which replace grad N in the volumetric
     * strain. Their layout is the layout of gradients. In axisymmetry they
     * include the hoop strain. Empty without B-bar.
     */
    std::vector<double> volumetric_gradients;
    /** Number of polynomials per cell onto which the B-bar gradients are
     *  projected; 0 without projection. It is the same on all ranks. */
    unsigned int n_volumetric_modes = 0;
    /** Values of the orthonormal polynomials M_i of the B-bar projection at each
     *  material point. In each cell sum_p V_p M_i M_j = delta_ij. M_j is 0 at
     *  all points of a cell if it is linearly dependent there on preceding basis
     *  functions. */
    std::vector<double> volumetric_modes;

    /** History variables of a material point; null without history variables. */
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

    /** Excess pore pressure p of a material point (Pa). It is the last history
     *  variable if there is undrained soil (LawTraits::undrained). */
    double
    excess_pressure(const unsigned int point) const
    {
      return history_of(point + 1)[-1];
    }

    /** Selects the state variables to be stored. Fixed points have neither mass
     *  nor velocity, nor variables derived from mass or velocity. */
    void
    use(const bool moving, const unsigned int n_history);

    /** Appends a point, given the values of its state variables in the order of
     *  variables(). */
    void
    append(const double *row);
  };

  /** Computes the gradients of the B-bar method. In each cell they are the
   *  volume-weighted projection of grad N (in axisymmetry of dN/dr + N/r) onto
   *  polynomials of x of the given degree; degree 0 is the mean. Cells without
   *  more points than polynomials do not change. */
  void
  project_gradients(const unsigned int degree, MaterialPoints &points);
} // namespace geocone::GEOCONE_DIM

#endif
