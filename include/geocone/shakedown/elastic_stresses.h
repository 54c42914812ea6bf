// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_elastic_stresses_h
#define geocone_shakedown_elastic_stresses_h

#include <geocone/conic/block_matrix.h>
#include <geocone/plane_bounds/bound_problem.h>

#include <Eigen/Dense>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Stresses or strains at the vertices of all triangles, in cone axes, linear in each
   *  of them. */
  using LinearField = std::vector<Eigen::Vector3d>;

  /** Adds a multiple of a field to another one. */
  void
  add(LinearField &to, const double factor, const LinearField &field);

  LinearField
  difference(const LinearField &a, const LinearField &b);

  /** Elastic stresses of one load with the factor 1, in scaled units. */
  struct ElasticStresses
  {
    LinearField compatible, equilibrated;

    /** Compatible ones, averaged at the vertices of each material. */
    LinearField averaged;
  };

  /** Mean of both elastic stresses, which misses the exact ones by half of their
   *  distance in the energy norm (Prager and Synge 1947). */
  LinearField
  mean_of_both(const ElasticStresses &stresses);

  /**
   * Elastic response of a plane body on the elements of a bound. For the upper bound
   * these are quadratic displacements with the stresses D e (displacement method); for
   * the lower bound linear stresses in equilibrium, those of the least complementary
   * energy (equilibrium method). Displacements vanish where velocities are prescribed.
   */
  class ElasticSolver
  {
  public:
    /** Assembles and factorises the stiffness matrix.
     *  @param problem of the side, without interfaces, structures and cut-offs
     *  @throws StepFailure if the matrix is singular */
    ElasticSolver(const BoundScene   &bound,
                  const BoundProblem &problem,
                  const BoundSide     side);

    /** Returns the stresses due to a load. @param load by dof
     *  @throws StepFailure if no stresses are in equilibrium with the load */
    LinearField
    stresses(const Eigen::VectorXd &load) const;

    /** Returns the compatible strains nearest to given strains in the energy norm. Of
     *  the upper bound only. */
    LinearField
    compatible_part(const LinearField &strains) const;

    /** Integral over the body of two fields of stresses with the compliance, or of two
     *  fields of strains with the stiffness. */
    double
    product_of_stresses(const LinearField &a, const LinearField &b) const;
    double
    product_of_strains(const LinearField &a, const LinearField &b) const;

    /** Work of stresses on strains. */
    double
    work(const LinearField &stresses, const LinearField &strains) const;

    /** Integral over each triangle of a field of stresses with itself. */
    std::vector<double>
    energies(const LinearField &stresses) const;

  private:
    Eigen::VectorXd
    displacements(const Eigen::VectorXd &load) const;

    /** Stresses conjugate to the strains of displacements, whose forces are those of the
     *  stiffness matrix. */
    LinearField
    conjugate_stresses(const LinearField &strains) const;

    /** D e of strains at each point. */
    LinearField
    stresses_of(LinearField strains) const;

    const BoundProblem          &problem;
    const BoundSide              side;
    const unsigned int           n_columns; ///< dofs of a triangle
    std::vector<unsigned int>    dofs;      ///< of all triangles
    std::vector<Eigen::Vector3d> stiffness; ///< D by triangle, diagonal
    BlockMatrix                  matrix;
  };

  /** Elastic stresses of all loads, by both methods. @param upper, lower solvers of both
   *  sides, with the load vectors of all loads */
  std::vector<ElasticStresses>
  elastic_stresses(const Triangles                    &triangles,
                   const ElasticSolver                &upper,
                   const ElasticSolver                &lower,
                   const std::vector<Eigen::VectorXd> &upper_forces,
                   const std::vector<Eigen::VectorXd> &lower_forces);
} // namespace geocone::GEOCONE_DIM

#endif
