// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_cell_pressures_h
#define geocone_terms_cell_pressures_h

#include <geocone/laws/material_library.h>
#include <geocone/points/material_points.h>

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Polynomial mean stress in each cell, for the B-bar method with dilatant soil. B-bar
   * takes the volumetric strains of a cell from polynomials of a degree, a constant
   * with Q1 and splines, but dilatant points must expand under shear. If the points of
   * a cell are sheared unequally, their stresses then rise until the next cells can
   * follow: the soil locks. Here only the projection of the volumetric strains onto the
   * polynomials M_j is prescribed, and a point may expand by an additional t_p, such
   * that
   *   sum_p V_p M_j(x_p) t_p = 0,   pi_p = sum_j M_j(x_p) m_j,
   *   pi_p = tr(s_p)/n + K_f tr(e_p) - p_p,   e_p = h B_p v + t_p I/n,
   * with n the dimension, K_f and p_p those of the pore fluid in undrained
   * soil, and B_p that of B-bar. If a functional of strains exists, this is its
   * stationary point with such a polynomial mean stress in each cell. Without
   * dilatancy and with uniform elasticity the changes of pi_p are such a
   * polynomial already, and this is B-bar. Around an axis n = 2 too: hoop
   * strains are those of the points, included in tr(e).
   *
   * The t_p follow from Newton's method in the cell, with k_p = I'C_p I/n^2 and
   * steps shortened if they are too long:
   *   m = G^-1 sum (V/k) M pi_p,   G = sum (V/k) M M',   t_p <- t_p + (M'm - pi_p)/k_p.
   */
  class CellPressures
  {
  public:
    /** Returns true if the B-bar method is used with dilatant soil, for which
     *  the mean stress must be polynomial in each cell. The result is the same
     *  on all ranks. */
    static bool
    are_those_of(const MaterialPoints &points, const Materials &materials);

    CellPressures(const MaterialPoints &points, const Materials &materials);

    /** Sets the elastic moduli of all points to the values at t_n. */
    void
    begin_step();

    /**
     * Adds a volumetric strain t_p to each point p (as t_p I/n, n = dimension),
     * such that the mean stresses pi_p of each cell lie on a polynomial.
     * @param update computes stresses and tangents from the strains of a range
     * of points [first, second)
     * @param strain_zz hoop strains, empty unless axisymmetric
     */
    void
    equalise(
      const std::function<void(const unsigned int, const unsigned int)> &update,
      const std::vector<Mandel>                                         &stress,
      const std::vector<MandelMatrix> &tangent,
      std::vector<Mandel>             &strain,
      const std::vector<double>       &strain_zz);

    /** Largest relative difference between the mean stresses pi_p of the points
     *  and the polynomials fitted by equalise(). It is relative to the largest
     *  stress of the points of this rank. */
    double
    difference() const
    {
      return largest_difference;
    }

    /** Adds the volumetric strain rates t_p (as t_p I/n, n = dimension) to the
     *  B-bar strain rates at the points of a cell. */
    void
    equalise_rates(const unsigned int                    cell,
                   const std::vector<MandelMatrix>      &tangent,
                   const std::vector<OutOfPlaneTangent> &tangent_zz,
                   std::vector<Mandel>                  &rate,
                   const std::vector<double>            &rate_zz);

    /** Maximum number of polynomials M_j in a cell, for degree 2 (elements
     *  Q3). */
    static constexpr int most_modes = dim == 2 ? 6 : 10;

    /** Polynomial basis M_j of a cell, with the Gram matrix G of the basis,
     *  weighted by 1/k_p (bulk stiffness k_p). */
    struct Basis
    {
      using Matrix = Eigen::Matrix<double,
                                   Eigen::Dynamic,
                                   Eigen::Dynamic,
                                   0,
                                   most_modes,
                                   most_modes>;

      /** Values of the basis polynomials M_j at the points of a cell. For each j there
       *  is a point at which M_j = 1 and all other M_i = 0. */
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
        modes;
      /** For each basis polynomial M_j, the index of the point of the cell at
       *  which M_j = 1. The index is -1 if M_j = 0 at all points. */
      std::vector<int>    point;
      Eigen::LDLT<Matrix> compliance; ///< factorisation of G
    };

    /** Terms of a cell's stiffness matrix after elimination of the volumetric
     *  strains t_p, see condense(). */
    struct Condensed
    {
      std::vector<Mandel> left, right; ///< a_p/k_p, b_p/k_p, times the weight
      std::vector<double> left_zz, right_zz; ///< hoop component
      Basis               basis;
    };

    /**
     * Eliminates the volumetric strains t_p of a cell from the tangents C_p of
     * its points (static condensation). The tangents become
     *   C_p <- C_p - a_p b_p'/k_p,   a_p = C_p I/n,   b_p = C_p' I/n,
     * which then have no volumetric stiffness. The remainder of the stiffness is,
     * with a column for each M_j,
     *   L G^-1 R',   L_j = sum_p B_p' (V/k M_j)_p a_p,   R_j = sum_p B_p' (V/k M_j)_p b_p.
     * @param C tangents, including the fluid's part, times a factor and the
     * weight V of their points; @p factor is that factor
     * @param C_zz out-of-plane tangents of axisymmetric problems, treated
     * alike; else empty
     */
    void
    condense(const unsigned int              cell,
             const double                    factor,
             std::vector<MandelMatrix>      &C,
             std::vector<OutOfPlaneTangent> &C_zz,
             Condensed                      &result) const;

  private:
    /** Excess pore pressure of a point at t_n (Pa); 0 if no material is
     *  undrained. */
    double
    pore_pressure(const unsigned int point) const;

    /** Computes the mean stress pi_p and the bulk stiffness k_p of a point. The latter
     *  is bounded from below, as it would be 0 at the apex of a cone.
     *  @param mean_stress pi_p without the contribution of the strain (Pa) */
    void
    evaluate(const unsigned int  point,
             const double        mean_stress,
             const MandelMatrix &tangent,
             const double        volumetric_strain);

    /**
     * Selects the basis polynomials M_j of a cell, with M_j = 1 at the points
     * where the soil is softest. Then G does not mix large and small 1/k_p, and
     * sum V M t = 0 is satisfied to the last digit if the t_p of these points
     * are computed from all others.
     * @param softness V/k of the points of the cell from the first
     */
    void
    choose_basis(const unsigned int         cell,
                 const std::vector<double> &softness,
                 Basis                     &result) const;

    /** Fits the polynomial closest to the mean stresses pi_p of a cell, in the
     *  metric of the Gram matrix G.
     *  @return the largest difference between pi_p and the polynomial (Pa); NaN if
     *  some pi_p is NaN */
    double
    fit(const unsigned int cell);

    /** Performs a Newton step for the volumetric strains t_p of a cell; to be
     *  called after fit(). */
    void
    shift(const unsigned int cell);

    /** Shortens the last Newton step for the volumetric strains of a cell to a
     *  fraction of its length. */
    void
    shorten(const unsigned int cell, const double part);

    /** Chooses the next change of the volumetric strains of a cell: Newton's
     *  step, its last one shortened, or a start from zero.
     *  @param step of Newton's method @param difference of the mean stresses from
     *  a polynomial (Pa) @param scale largest stress (Pa) */
    void
    next_change(const unsigned int cell,
                const unsigned int step,
                const double       difference,
                const double       scale);

    /** Directional derivative sum_p V_p pi_p dt_p of a cell's potential along
     *  the last Newton step dt_p, with the mean stresses pi_p. The potential, a
     *  function of the t_p, is minimal if the pi_p are a polynomial, and
     *  convex, as pi_p never decreases if a point expands. */
    double
    slope(const unsigned int cell) const;

    const MaterialPoints     &points;
    const Materials          &materials;
    std::vector<double>       least_modulus; ///< lower bound on k_p (Pa)
    std::vector<double>       mean;          ///< pi_p (Pa)
    std::vector<double>       k;             ///< k_p (Pa)
    std::vector<double>       growth;        ///< t_p (-)
    std::vector<double>       change;        ///< dt_p of the last Newton step
    std::vector<double>       first_slope;   ///< slope() before the step
    std::vector<double>       first_difference;
    std::vector<Mandel>       given;    ///< strains without t_p
    std::vector<unsigned int> unequal;  ///< cells not yet converged
    Basis                     basis;    ///< basis of the cell of the last fit()
    Eigen::VectorXd           fitted;   ///< fitted polynomial, by point (Pa)
    std::vector<double>       softness; ///< V/k of the points of that cell
    double                    largest_difference = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
