// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_quadrature_points_h
#define geocone_points_quadrature_points_h

#include <geocone/points/material_points.h>
#include <geocone/space/space.h>

#include <deal.II/base/quadrature.h>

#include <functional>

namespace geocone::GEOCONE_DIM
{
  /**
   * Quadrature rule that integrates the stiffness matrix B'DB exactly on affine
   * cells. On triangles of degree p it is exact for polynomials of degree 2p - 2
   * (1, 3, 7 points); on quadrilaterals it has (p + 1)^2 Gauss points.
   */
  dealii::Quadrature<dim>
  stress_quadrature(const Space &space, const BackgroundMesh &mesh);

  /** Positions, weights and shape functions at the quadrature points of a cell. */
  struct CellValues
  {
    CellValues(const Space                   &space,
               const BackgroundMesh          &mesh,
               const dealii::Quadrature<dim> &quadrature);
    ~CellValues();

    void
    reinit(const Space::Cell &cell);

    const dealii::Quadrature<dim>   quadrature;
    std::vector<dealii::Point<dim>> position;
    std::vector<double>             weight; ///< JxW times measure() (m^2, m^3)

    /** Value of the shape function N_i at quadrature point q. */
    double
    value(const unsigned int i, const unsigned int q) const
    {
      return reference_value[q * n_nodes + i];
    }

    /** Gradient of the shape function N_i at quadrature point q (1/m). */
    dealii::Tensor<1, dim>
    gradient(const unsigned int i, const unsigned int q) const;

  private:
    const BackgroundMesh               &mesh;
    const Space                        &space;
    const unsigned int                  n_nodes;
    bool                                is_evaluated = false;
    std::vector<double>                 reference_value;
    std::vector<dealii::Tensor<1, dim>> reference_gradient;
    struct Geometry;
    std::unique_ptr<Geometry> geometry;
  };

  /**
   * Creates the material points of the finite element method at the quadrature
   * points of all cells.
   * @throws InputError if a material has no cell
   */
  MaterialPoints
  make_quadrature_points(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space);

  /** Creates the quadrature points of selected cells, in the order of the mesh.
   *  Points with a known state receive a copy of this state. */
  MaterialPoints
  quadrature_points_of(
    const Scene                                             &scene,
    const BackgroundMesh                                    &mesh,
    const Space                                             &space,
    const MaterialPoints                                    &known,
    const std::function<bool(const BackgroundMesh::Cell &)> &is_there);
} // namespace geocone::GEOCONE_DIM

#endif
