// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_consolidation_h
#define geocone_problem_consolidation_h

#include <geocone/laws/material_library.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/points/material_points.h>
#include <geocone/problem/pressure_functions.h>
#include <geocone/terms/pore_pressures.h>
#include <geocone/terms/turned_dofs.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Excess pore pressures of consolidating soil (Biot 1941), in plane strain and
   * axisymmetry. With the bulk modulus K_w/n of the pore fluid, hydraulic
   * conductivity k and unit weight gamma of water, backward Euler gives
   *   tr(e - e_n) + (n/K_w) (p - p_n) = h div((k/gamma) grad p).
   * The pressures are those of PressureFunctions at the vertices, P, and with
   * finite elements local ones besides: a point has p = N P + q, where
   *   tr(e - e_n) + (n/K_w) (p - p_n) = -h l q
   * with the leakage l of the cell. Water that cannot leave a cell in the step is
   * kept by each point, as in undrained soil; without local pressures it is kept
   * in the mean with the functions N. With a = h l/(n/K_w + h l), 1 without local
   * pressures, the matrices of PorePressures are sums over the points,
   *   G = sum V a (B' 1) N',   M = sum V a (n/K_w) N' N,   A = M + S + h L,
   *   f = sum V a (n/K_w) N' p_n + S p_n,
   * with the pressures p_n of the points at t_n, and of the vertices in S p_n.
   * The stiffness matrix has the modulus 1/(n/K_w + h l) of the water.
   * Pressures are stored as the first components of nodes in vectors with the
   * layout of the velocities.
   */
  class Consolidation : public PorePressures
  {
  public:
    /** @param layout of the velocities
     *  @param at_vertices pressures at t_n to which those of the step are
     *  smoothed, which must outlive the object; null where none are */
    Consolidation(
      const Materials      &materials,
      const MaterialPoints &points,
      const Unknowns       &unknowns,
      PressureFunctions     functions,
      const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout,
      Vector *at_vertices = nullptr);

    void
    begin_step(const double h) override;
    void
    update(const Vector &v) override;
    double
    at(const unsigned int point) const override
    {
      return of_point[point];
    }
    double
    fluid_modulus(const unsigned int point) const override
    {
      return has_local() ? 1. / (storage(point) + h * functions.leakage[point])
                         : 0.;
    }
    void
    add_tangent(Vector &dst, const Vector &dv) const override;
    SparseMatrix
    make_pattern(const SparseMatrix &stiffness) override;
    void
    assemble(const SparseMatrix &stiffness,
             SparseMatrix       &matrix) const override;
    unsigned int
    n_rows() const override
    {
      return A.n_global;
    }
    WaterBalance
    commit() override;

  private:
    /** Assigns rows to the pressures and creates the pattern of A.
     *  Collective. */
    void
    number_rows();

    /** Divergence at the points, with ghosts of v (1/s). */
    std::vector<double>
    divergence(const Vector &v) const;

    /** Computes sum V N' f of a function f of the points, in all
     *  owned pressures. */
    template <typename ValueOf>
    Vector
    integral(const ValueOf &f) const;

    /** Computes the sum of matrices of the cells times pressures p with ghosts,
     *  in all owned pressures. */
    Vector
    products(const std::vector<double> &matrices, const Vector &p) const;

    /** Pressure at a point of a cell, from a vector with ghosts (Pa). */
    double
    value(const Vector      &p,
          const unsigned int cell,
          const unsigned int point) const;

    /** Solves A x = b, with x = 0 on drained sides. Collective.
     *  @return x with its ghosts */
    Vector
    solve(const Vector &b) const;

    /** Computes the matrices G of all cells, along the coordinate axes. */
    void
    compute_coupling();

    /** Returns the matrix G of a cell, in rotated dofs, by columns: one for each
     *  pressure. */
    std::vector<double>
    coupling_of_cell(const unsigned int c) const;

    /** Row of a dof of a cell in the coupled system; -1 unless it is free. */
    int
    row_of_dof(const unsigned int cell, const unsigned int i) const;

    /** n/K_w of a point (1/Pa). */
    double
    storage(const unsigned int point) const
    {
      return 1. / materials.law(points.material[point]).fluid_modulus();
    }

    /** Whether points have local pressures. */
    bool
    has_local() const
    {
      return !functions.leakage.empty();
    }

    /** The factor a of a point. */
    double
    share(const unsigned int point) const
    {
      return has_local() ? h * functions.leakage[point] * fluid_modulus(point)
                         : 1.;
    }

    /** Local node of a vertex of a cell. */
    unsigned int
    node_of(const unsigned int cell, const unsigned int vertex) const
    {
      return functions.nodes[cell * functions.n_vertices + vertex];
    }

    const MaterialPoints         &points;
    const Materials              &materials;
    const Unknowns               &unknowns;
    const TurnedDofs              turned;
    const PressureFunctions       functions;
    Vector *const                 at_vertices; ///< p_n at the vertices
    Vector                        smoothed_n;  ///< S p_n
    Vector                        trial;       ///< P(v)
    std::vector<double>           rate; ///< divergence of v at the points
    std::vector<double>           of_point;    ///< p(v) at the points
    std::vector<double>           of_point_n;  ///< p_n at the points
    std::vector<double>           coupling;    ///< G by cell and column
    std::vector<int>              row; ///< in A, by local node; -1: none
    SparseMatrix                  A;
    std::unique_ptr<LinearSolver> solver;
    double                        h = 0.; ///< of the factorised A (s)

    /** @name Rows of the coupled system, by local row of K and of A */
    /** @{ */
    std::vector<int> row_of_velocity, row_of_pressure;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
