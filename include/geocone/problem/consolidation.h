// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_consolidation_h
#define geocone_problem_consolidation_h

#include <geocone/linear/linear_solver.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>
#include <geocone/terms/pore_pressures.h>
#include <geocone/terms/turned_dofs.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Excess pore pressures of consolidating soil at small strains (Biot 1941),
   * in plane strain and axisymmetry. With the bulk modulus K_w/n of the pore
   * fluid, hydraulic conductivity k and unit weight gamma of water, backward
   * Euler gives
   *   tr(e - e_n) + (n/K_w) (p - p_n) = h div((k/gamma) grad p),
   * with p = 0 on drained sides and no flow through all others. The pressures
   * are continuous and linear (bilinear on quadrilaterals), the velocities at
   * least quadratic: Taylor-Hood elements, which satisfy the inf-sup condition.
   * The matrices of PorePressures are sums over the points,
   *   G = sum V (B' 1) N',   A = M + h sum V grad N' (k/gamma) grad N,
   *   M = sum V (n/K_w) N' N,   f = M p_n.
   * Pressures are stored as the first components of the vertices in vectors
   * with the layout of the velocities.
   */
  class Consolidation : public PorePressures
  {
  public:
    /** @param is_drained whether p = 0 at each local node
     *  @param pressure p_n, which must outlive the object */
    Consolidation(const Scene             &scene,
                  const BackgroundMesh    &mesh,
                  const Space             &space,
                  const MaterialPoints    &points,
                  const Unknowns          &unknowns,
                  const std::vector<bool> &is_drained,
                  Vector                  &pressure);

    void
    begin_step(const double h) override;
    void
    update(const Vector &v) override;
    double
    at(const unsigned int point) const override
    {
      return of_point[point];
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

    /** Computes G' v with ghosts of v, in all owned pressures (m^2/s). */
    Vector
    divergence(const Vector &v) const;

    /** Computes M p with ghosts of p, in all owned pressures (m^2). */
    Vector
    storage(const Vector &p) const;

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

    /** Local node of a vertex of a cell. */
    unsigned int
    node_of(const unsigned int cell, const unsigned int vertex) const
    {
      return points.nodes[cell * points.n_nodes + vertex];
    }

    const MaterialPoints               &points;
    const Materials                    &materials;
    const Unknowns                     &unknowns;
    const TurnedDofs                    turned;
    const std::vector<bool>             is_drained;
    Vector                             &pressure;   ///< p_n
    Vector                              trial;      ///< p(v)
    Vector                              inflow;     ///< G' v
    std::vector<double>                 of_point;   ///< p(v) at the points
    const unsigned int                  n_vertices; ///< of a cell
    std::vector<double>                 N; ///< vertex functions, by point
    std::vector<dealii::Tensor<1, dim>> gradient;          ///< grad N (1/m)
    std::vector<double>                 coupling; ///< G by cell and column
    std::vector<dealii::SymmetricTensor<2, dim>> mobility; ///< k/gamma
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
