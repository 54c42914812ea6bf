// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_cell_pressures_h
#define geocone_problem_cell_pressures_h

#include <geocone/materials/material_library.h>
#include <geocone/points/material_points.h>

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * The mean stress of a cell as one polynomial, for B-bar where soil dilates. B-bar
   * takes the volumetric strains of a cell from polynomials of a degree, a constant
   * with Q1 and splines, but a point that dilates has to grow as it is sheared, and
   * where points of a cell are not sheared alike their stresses then rise until those
   * of the next cells can follow: the soil locks. Here only the projection of the
   * volumetric strains onto the polynomials M_j is given, and a point may grow by t_p
   * more, such that
   *   sum_p V_p M_j(x_p) t_p = 0,   pi_p = sum_j M_j(x_p) m_j,
   *   pi_p = tr(s_p)/n + K_f tr(e_p) - p_p,   e_p = h B_p v + t_p I/n,
   * with n the dimension, K_f and p_p those of the pore fluid where soil is undrained,
   * and B_p that of B-bar: the stationary point of the functional of strains, where it
   * has one, with the mean stress such a polynomial in each cell. Without dilatancy and
   * with one elasticity the changes of pi_p are such a polynomial already, and this is
   * B-bar. Around an axis n = 2 too: hoop strains are those of the points, and tr(e) has
   * them.
   *
   * The t_p follow from Newton's method in the cell, with k_p = I'C_p I/n^2 and steps
   * that are shortened where they go too far:
   *   m = G^-1 sum (V/k) M pi_p,   G = sum (V/k) M M',   t_p <- t_p + (M'm - pi_p)/k_p.
   */
  class CellPressures
  {
  public:
    /** Whether there are such pressures: B-bar, and soil that dilates; the same on
     *  all ranks. */
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
     * @param strain_zz hoop strains, empty but around an axis
     */
    void
    equalise(
      const std::function<void(const unsigned int, const unsigned int)> &update,
      const std::vector<Mandel>                                         &stress,
      const std::vector<MandelMatrix> &tangent,
      std::vector<Mandel>             &strain,
      const std::vector<double>       &strain_zz);

    /** What is left of the differences from polynomials, over the greatest stress of
     *  the points of this rank, after equalise(). */
    double
    difference() const
    {
      return largest_difference;
    }

    /** Of the rates of the points of a cell by B-bar: adds those of t_p I/n. */
    void
    equalise_rates(const unsigned int                    cell,
                   const std::vector<MandelMatrix>      &tangent,
                   const std::vector<OutOfPlaneTangent> &tangent_zz,
                   std::vector<Mandel>                  &rate,
                   const std::vector<double>            &rate_zz);

    /** Q3 has the most polynomials in a cell, those of degree 2. */
    static constexpr int most_modes = dim == 2 ? 6 : 10;

    /** A basis of the polynomials of a cell and their G, with 1/k_p of its points. */
    struct Basis
    {
      using Matrix = Eigen::Matrix<double,
                                   Eigen::Dynamic,
                                   Eigen::Dynamic,
                                   0,
                                   most_modes,
                                   most_modes>;

      /** M_j at the points of a cell, one of which has M_j = 1 and no other M_i. */
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
        modes;
      /** Number of that point in the cell; -1 where M_j = 0 at all points. */
      std::vector<int>    point;
      Eigen::LDLT<Matrix> compliance; ///< G
    };

    /** A cell's tangent without its t_p, see condense(). */
    struct Condensed
    {
      std::vector<Mandel> left, right; ///< a_p/k_p, b_p/k_p, times the weight
      std::vector<double> left_zz, right_zz; ///< around an axis, along the hoop
      Basis               basis;
    };

    /**
     * Eliminates the t_p of a cell from its tangents,
     *   C_p <- C_p - a_p b_p'/k_p,   a_p = C_p I/n,   b_p = C_p' I/n,
     * which then are blind to volume; what is left is, with a column for each M_j,
     *   L G^-1 R',   L_j = sum_p B_p' (V/k M_j)_p a_p,   R_j = sum_p B_p' (V/k M_j)_p b_p.
     * @param C tangents, with the fluid's part, times a factor and the weight V of
     * their points; @p factor is that factor
     * @param C_zz those out of the plane around an axis, treated alike; else empty
     */
    void
    condense(const unsigned int              cell,
             const double                    factor,
             std::vector<MandelMatrix>      &C,
             std::vector<OutOfPlaneTangent> &C_zz,
             Condensed                      &result) const;

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
             const double        volumetric_strain);

    /**
     * Chooses the points with M_j = 1 where the soil is softest, so that large and
     * small 1/k_p do not mix in G, and a t_p found there from those of the others
     * keeps sum V M t = 0 to the last digit.
     * @param softness V/k of the points of the cell from the first
     */
    void
    choose_basis(const unsigned int         cell,
                 const std::vector<double> &softness,
                 Basis                     &result) const;

    /** Finds the polynomial that is closest to the pi_p of a cell by G.
     *  @return the largest difference of a pi_p from it (Pa); NaN if one is */
    double
    fit(const unsigned int cell);

    /** One step of Newton's method in a cell that was fitted. */
    void
    shift(const unsigned int cell);

    /** Takes back all of the last step but a part of it. */
    void
    shorten(const unsigned int cell, const double part);

    /** The derivative along the last step of the functional of the t_p that is least
     *  where the pi_p are a polynomial, sum_p V_p pi_p dt_p. It is convex, as pi_p
     *  never falls where a point grows. */
    double
    slope(const unsigned int cell) const;

    const MaterialPoints     &points;
    const Materials          &materials;
    std::vector<double>       least_modulus; ///< of points (Pa)
    std::vector<double>       mean;          ///< pi_p (Pa)
    std::vector<double>       k;             ///< k_p (Pa)
    std::vector<double>       growth;        ///< t_p
    std::vector<double>       change;        ///< of t_p in the last step
    std::vector<double>       first_slope;   ///< of a cell where that began
    std::vector<double>       first_difference;
    std::vector<Mandel>       given;    ///< strains without t_p
    std::vector<unsigned int> unequal;  ///< cells that are not done
    Basis                     basis;    ///< of the cell fitted last
    Eigen::VectorXd           fitted;   ///< its polynomial at its points (Pa)
    std::vector<double>       softness; ///< V/k of its points
    double                    largest_difference = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
