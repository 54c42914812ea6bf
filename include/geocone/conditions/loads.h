// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_loads_h
#define geocone_conditions_loads_h

#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/surfaces/face_points.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Computes the nodal masses int rho N_i (density times shape function),
   * integrated over all cells that contain material points. Each integral is
   * stored for all components of a node.
   * @param[out] weight_per_g  int rho N_i, which times g is the weight (kg/m)
   * @param[out] lumped_mass  diagonal mass: the row sums int rho N_i, which are
   * positive for P1, P3, Q1, Q2, Q3 (vertex, edge, centre of P3: 1/30, 3/40,
   * 9/20 of the cell); for P2, whose vertices would have zero mass, the diagonal
   * of the consistent mass matrix scaled to the mass of the cell
   */
  void
  integrate_density(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    const MaterialPoints &points,
                    Vector               &weight_per_g,
                    Vector               &lumped_mass);

  struct CellValues;

  /**
   * External nodal forces F(t): self-weight, surface tractions and hydrostatic water
   * forces. Forces act on the cells with points. Only loads of the scene are stored.
   */
  class Loads
  {
  public:
    /** Collects the loads that the scene defines. @param points in the loaded
     *  cells */
    Loads(const Scene          &scene,
          const BackgroundMesh &mesh,
          const Space          &space,
          const MaterialPoints &points);

    /**
     * Evaluates the external nodal forces F at time t (N/m).
     * @param stage null: all loads; otherwise, loads that the load factor of the
     * stage scales, if @p scaled, or all other loads
     */
    void
    evaluate(Vector       &force,
             const Vector &weight_per_g,
             const double  t,
             const Stage  *stage  = nullptr,
             const bool    scaled = false) const;

    bool
    exist() const
    {
      return scene.gravity.acts() || !scene.tractions.list.empty();
    }

  private:
    /** Adds the power of the suction stress, the integral of chi u div v, to the
     *  forces of each flow. */
    void
    add_suction(const BackgroundMesh &mesh,
                const Space          &space,
                const MaterialPoints &points,
                CellValues           &values);

    /** A quadrature point of a loaded face. */
    struct LoadedPoint
    {
      unsigned int condition;
      FacePoint    point;
    };

    const Scene             &scene;
    std::vector<LoadedPoint> loaded;
    /** Nodal forces due to the pressure of each water surface at full gravity
     *  (N/m). */
    std::vector<Vector> of_water;
  };
} // namespace geocone::GEOCONE_DIM

#endif
