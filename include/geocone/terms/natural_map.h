// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_natural_map_h
#define geocone_terms_natural_map_h

#include <geocone/laws/material_library.h>
#include <geocone/points/material_points.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Local equations of the incremental problem in the form of the natural map s
   * - P_C(s - rho Psi(z)) (Guillet et al. 2025, eq 60). At each point
   *   z = S (s - s_n) - e,   R = s - P_C(s - rho Psi(z)),   e = h B v,
   * where s is an additional unknown, and a Newton step from (v, s) has
   *   A ds = rho J Psi' de - R,   A = I - J + rho J Psi' S,
   * J and Psi' the generalised Jacobians of P_C and Psi. Eliminated point by
   * point, this leaves the momentum balance of the stress s - A^-1 R with the
   * tangent T = A^-1 rho J Psi' for v alone. z always belongs to (v, s), and s
   * satisfies the momentum balance after each full step. If |z_t| hardens the
   * cone, rho J Psi' has the further term - dP_C/d|z_t| (z_t/|z_t|)'. Points of
   * materials without a cone have s = s_n + D e. For laws with edges these
   * local steps may alternate between a plane and an edge for ever, whatever e
   * is; such points are solved by the return map of the law.
   */
  class NaturalMap
  {
  public:
    /**
     * Creates the natural map with an initial guess for the stresses s.
     * @param step for Material::step_cone(), the cones of the points
     * @param rho as a multiple of 2G of each point
     * @param start initial guess of s, by point (Pa)
     */
    NaturalMap(const MaterialPoints      &points,
               const Materials           &materials,
               const StepData            &step,
               const double               rho,
               const std::vector<Mandel> &start);

    /** Largest residual norm |R| of the natural map over all points, and the
     *  reference stress (Pa). */
    struct Error
    {
      double largest_residual = 0.;
      double stress_scale     = 0.; ///< max |s| + max k

      /** Adds the residual and the stress of a point. */
      void
      add(const Mandel &R, const Mandel &s)
      {
        largest_residual = std::max(largest_residual, R.norm());
        stress_scale     = std::max(stress_scale, s.norm());
      }
    };

    /**
     * Updates the stresses by one Newton step of the natural map for given
     * strain increments. Then the natural map is linearised at the new (v, s).
     * @param[out] mode region of s - rho Psi(z): inside C, projected onto the
     * smooth part of C, or projected onto the apex
     */
    Error
    update(const std::vector<Mandel> &strain, std::vector<Mode> &mode);

    /** Stress of each point after the last call to update() (Pa): s - A^-1 R,
     *  with the residual R of the natural map and its Jacobian A. Before the
     *  first update() it is the initial guess. */
    const std::vector<Mandel> &
    stress() const
    {
      return iterate;
    }

    /** Copies the tangent stiffness of the points [begin, end) after the last
     *  call to update() (Pa). */
    void
    copy_tangents(const unsigned int begin,
                  const unsigned int end,
                  MandelMatrix      *tangent) const;

  private:
    /** Updates the stress and the slope of a point by the projection onto its
     *  cone, unless that leaves s unchanged (elastic).
     *  @param s, z stress (Pa) and plastic strain of the last linearisation
     *  @param[in,out] largest_k over the points so far (Pa) */
    Mode
    update_on_cone(const unsigned int p,
                   const Elasticity  &elasticity,
                   const Mandel      &s,
                   const Mandel      &z,
                   MandelMatrix      &slope,
                   Error             &error,
                   double            &largest_k);

    /** As update_on_cone(), by the projection of a law whose yield surface has
     *  edges; elastic for laws without one. A point whose residual stalls is
     *  mapped back() from then on. @param strain increment e */
    Mode
    update_with_edges(const unsigned int p,
                      const Elasticity  &elasticity,
                      const Mandel      &s,
                      const Mandel      &z,
                      const Mandel      &strain,
                      MandelMatrix      &slope,
                      Error             &error);

    /** Solves the law of a point by its return map, for the strain increment
     *  e. */
    Mode
    map_back(const unsigned int p, const Mandel &strain, MandelMatrix &slope);

    /** Slopes ds/de of the points of a block that flow, in the order of their
     *  numbers. The others have their elastic stiffness. */
    struct Slopes
    {
      std::vector<unsigned int> point;
      std::vector<MandelMatrix> slope;
    };

    /** Number of points of a block. */
    static constexpr unsigned int block_size = 4096;

    /** Progress of the residual of a point: its least norm (Pa), and the number
     *  of updates since it was halved. */
    struct Progress
    {
      double       least = std::numeric_limits<double>::infinity();
      unsigned int since = 0;
    };

    const MaterialPoints                &points;
    const Materials                     &materials;
    const StepData                       step;
    const double                         rho;
    std::vector<std::optional<FlowCone>> cones;      ///< by material
    std::vector<char>                    varies;     ///< cone differs by point
    std::vector<MandelMatrix>            compliance; ///< by material
    std::vector<Mandel>                  iterate;
    std::vector<Slopes>                  slopes;      ///< by block of points
    std::vector<Mandel>                  last_strain; ///< empty before update()
    std::vector<Progress> progress; ///< by point; empty without laws with edges
  };
} // namespace geocone::GEOCONE_DIM

#endif
