// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_cell_pressures_h
#define geocone_mechanics_cell_pressures_h

#include <geocone/discretisation/material_points.h>
#include <geocone/materials/material_library.h>

#include <functional>
#include <vector>

namespace geocone
{
  /**
   * One mean stress in each cell, for B-bar where soil dilates. B-bar gives all points
   * of a cell the same volumetric strain, but a point that dilates has to grow as it is
   * sheared, and where points of a cell are not sheared alike their stresses then rise
   * until those of the next cells can follow: the soil locks. Here only the mean of the
   * volumetric strains is given, and a point may grow by t_p more, such that
   *   sum_p V_p t_p = 0,   pi_p = pi in the cell,
   *   pi_p = tr(s_p)/n + (K_w/n) tr(e_p) - p_p,   e_p = h B_p v + t_p I/n,
   * with n the dimension, the pore pressure where soil is undrained, and B_p that of
   * B-bar: the stationary point of the functional of strains, where it has one, with
   * the mean stress constant in each cell. Without dilatancy and with one elasticity
   * all pi_p change alike, and this is B-bar.
   *
   * The t_p follow from Newton's method in the cell, with k_p = I'C_p I/n^2:
   *   pi = sum (V/k) pi_p / sum (V/k),   t_p <- t_p + (pi - pi_p)/k_p.
   */
  class CellPressures
  {
  public:
    /** Whether cells have one pressure: B-bar by means of cells, and soil that
     *  dilates; the same on all ranks. */
    static bool
    are_those_of(const MaterialPoints &points, const Materials &materials);

    CellPressures(const MaterialPoints &points, const Materials &materials);

    /** Takes the elasticity of t_n. */
    void
    begin_step();

    /**
     * Adds t_p I/n to the strains.
     * @param update finds stresses and tangents of the strains of points from the
     * first to before the second number
     */
    void
    equalise(
      const std::function<void(const unsigned int, const unsigned int)> &update,
      const std::vector<Mandel>                                         &stress,
      const std::vector<MandelMatrix> &tangent,
      std::vector<Mandel>             &strain);

    /** What is left of the differences in a cell, over the greatest stress of the
     *  points of this rank, after equalise(). */
    double
    difference() const
    {
      return largest_difference;
    }

    /** Of the rates of the points of a cell by B-bar: adds those of t_p I/n. */
    void
    equalise_rates(const unsigned int               cell,
                   const std::vector<MandelMatrix> &tangent,
                   std::vector<Mandel>             &rate);

    /** A cell's tangent without its t_p, see condense(). */
    struct Condensed
    {
      std::vector<Mandel> left, right; ///< of its points (Pa times weight)
      double              sum = 0.;    ///< sum V/k
    };

    /**
     * Eliminates the t_p of a cell from its tangents,
     *   C_p <- C_p - a_p b_p'/k_p,   a_p = C_p I/n,   b_p = C_p' I/n,
     * which then are blind to volume; the rest is of rank one,
     *   l r'/sum (V/k),   l = sum_p B_p' (V/k)_p a_p,   r = sum_p B_p' (V/k)_p b_p.
     * @param C tangents, with the fluid's part, times a factor and the weight V of
     * their points; @p factor is that factor
     */
    void
    condense(const unsigned int         cell,
             const double               factor,
             std::vector<MandelMatrix> &C,
             Condensed                 &result) const;

  private:
    /** p_n of a point (Pa); 0 where no soil is undrained. */
    double
    pore_pressure(const unsigned int point) const;

    /** Finds pi_p and k_p, which has a lower bound: it is 0 at the apex of a cone.
     *  @param mean_stress pi_p without the part of the strain (Pa) */
    void
    evaluate(const unsigned int  point,
             const double        mean_stress,
             const MandelMatrix &tangent,
             const Mandel       &strain);

    /** One step of Newton's method in a cell, from its pi_p and k_p. */
    void
    shift(const unsigned int cell);

    const MaterialPoints &points;
    const Materials      &materials;

    std::vector<double>       least_modulus; ///< of points (Pa)
    std::vector<double>       mean;          ///< pi_p (Pa)
    std::vector<double>       k;             ///< k_p (Pa)
    std::vector<double>       growth;        ///< t_p
    std::vector<Mandel>       given;         ///< strains without t_p
    std::vector<double>       difference_in; ///< of pi_p in a cell (Pa)
    std::vector<unsigned int> unequal;       ///< cells that are not done
    double                    largest_difference = 0.;
  };
} // namespace geocone

#endif
