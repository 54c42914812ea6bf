// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_problem_h
#define geocone_reduced_reduced_problem_h

#include <geocone/cone/second_order_cone.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Incremental problem with stresses as unknowns (Guillet et al. 2025, eqs 61, 74).
   * Find s and lambda such that
   *   z = W s - C lambda + q, 0 = -C' s + L lambda + d,
   * and (s_p, z_p) satisfies the law of cone p (FlowCone), in cone axes, for each of the
   * n cones. With M, B, S, H of eq (71) and a time step h,
   *   W = S + h^2 B M^-1 B', q = -q_sigma - h B M^-1 q_v,
   *   C = h B M^-1 H', L = H M^-1 H', d = H M^-1 q_v - q_BC.
   * Without constraints C, L and d are empty. s is a stress (Pa); z is a strain increment
   * or, if W and q contain the volumes of the points, a strain increment times volume.
   *
   * W is stored as a matrix or, for a lumped mass, by the factors G, m and H,
   *   W = S + G diag(m) G', C = G diag(m) H', L = H diag(m) H',
   * which couple two points only if the points share a node: the matrix W would have a
   * hundred times as many entries. Sizes below: n cones, f free dofs, m multipliers.
   */
  struct ReducedProblem
  {
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    std::vector<FlowCone> cones; ///< size n
    Matrix                W; ///< 3n x 3n, symmetric positive definite, or empty
    Eigen::VectorXd       q; ///< size 3n
    Eigen::VectorXd       S; ///< size 3n, diagonal part of W; empty if unknown
    Matrix                G; ///< 3n x f, or empty
    Matrix                H; ///< m x f, or empty
    Eigen::VectorXd       m; ///< size f, positive
    Eigen::MatrixXd       C; ///< 3n x m, or empty
    Eigen::MatrixXd       L; ///< m x m, symmetric positive definite
    Eigen::VectorXd       d; ///< size m

    unsigned int
    n_cones() const
    {
      return cones.size();
    }

    unsigned int
    n_multipliers() const
    {
      return d.size();
    }

    /** Returns true if the matrix W is stored by its factors. */
    bool
    has_factors() const
    {
      return m.size() > 0;
    }

    /** Nodal vector diag(m) G's due to stresses s, with the factors G and m of
     *  the matrix W = S + G diag(m) G'. */
    Eigen::VectorXd
    nodal(const Eigen::VectorXd &s) const;

    /** Product W s. */
    Eigen::VectorXd
    multiply(const Eigen::VectorXd &s) const;

    /** Diagonal 3 x 3 block W_pp of the matrix W for cone p. */
    MandelMatrix
    diagonal_block(const unsigned int p) const;

    /** Dual variable z = W s - C lambda + q, for given stresses s and
     *  multipliers lambda. */
    Eigen::VectorXd
    z(const Eigen::VectorXd &s, const Eigen::VectorXd &lambda) const;

    /**
     * Lagrange multipliers lambda = L^-1 (C' s - d) of the constraints, for given
     * stresses s.
     */
    Eigen::VectorXd
    multipliers(const Eigen::VectorXd &s) const;

    /**
     * Equivalent problem after elimination of the multipliers (Guillet et al. 2025, eqs
     * 74, 75). It has W - C L^-1 C' and q + C L^-1 d, with W stored as a matrix, dense
     * where C is dense.
     * @throws RunError if L is not positive definite (redundant constraints)
     */
    ReducedProblem
    projected() const;

    /**
     * Relative residual of the natural map for stresses s, evaluated
     * independently of the solver. It is (Guillet et al. 2025, eq 59)
     *   max_p |s_p - P_C(s_p - rho_p Psi(z_p))| / (max_p |s_p| + max_p k_p),
     * with rho_p = 3/trace(W_pp) and lambda = multipliers(s). Dimensionless; infinite for
     * s = 0 without cohesion, unless s = 0 is the solution.
     */
    double
    natural_map_error(const Eigen::VectorXd &s) const;
  };

  /** Scale rho = 3/trace(W_pp) in the natural map of one cone. */
  inline double
  natural_scale(const MandelMatrix &W)
  {
    return 3. / W.trace();
  }

  /** Norm of the natural map of one cone, |s - P_C(s - rho Psi(z))| (Pa). */
  inline double
  natural_map_norm(const FlowCone &cone,
                   const Mandel   &s,
                   const Mandel   &z,
                   const double    rho)
  {
    return natural_map(cone, s, Mandel(cone.psi(z)), rho).norm();
  }
} // namespace geocone::GEOCONE_DIM

#endif
