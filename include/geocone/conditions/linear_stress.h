// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_linear_stress_h
#define geocone_conditions_linear_stress_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/points/material_points.h>
#include <geocone/space/space.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Integrals int N_i n dA over faces of a cell and int N_i n (x - c)_k dA by k,
   *  with the shape function N_i, the normal n and the centre c of the cell. */
  struct FaceMoments
  {
    dealii::Tensor<1, dim>                  normal; ///< (m)
    std::array<dealii::Tensor<1, dim>, dim> along;  ///< by k (m^2)
  };

  /**
   * Stress in a cell, linear in x: the weighted least-squares fit to the stresses
   * of its material points. It is constant if the points do not determine a
   * slope or do not fill the cell. Empty parts of the cell have no stress.
   */
  class LinearStress
  {
  public:
    /** @param c number of the cell in MaterialPoints::cells */
    LinearStress(const MaterialPoints      &points,
                 const unsigned int         c,
                 const BackgroundMesh      &mesh,
                 const Space               &space,
                 const std::vector<Mandel> &stress);

    /** Component of the nodal force int N_i sigma n dA on faces of the cell
     *  (N/m, N). */
    double
    force(const unsigned int component, const FaceMoments &faces) const;

  private:
    Mandel                  at_centre; ///< (Pa)
    std::array<Mandel, dim> slope;     ///< (Pa/m)
  };
} // namespace geocone::GEOCONE_DIM

#endif
