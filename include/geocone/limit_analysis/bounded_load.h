// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bounded_load_h
#define geocone_limit_analysis_bounded_load_h

#include <geocone/limit_analysis/bound_problem.h>
#include <geocone/limit_analysis/load_choice.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Variants of Davis's factor (1968) in strength reduction by F, which differ in the
   * friction angle phi and the dilatancy angle theta; equal for F = 1. A: given angles.
   * B: both reduced, tan(phi)/F and tan(theta)/F. C: phi reduced; theta reduced only as
   * far as it would exceed phi.
   */
  enum class DavisVariant
  {
    A,
    B,
    C
  };

  /** Load bounded by a limit analysis: loads multiplied by the load factor, strength of
   *  the materials, and scaled units in which both are of order one. */
  class BoundedLoad : public LoadChoice
  {
  public:
    /**
     * Selects the loads multiplied by the load factor, and the scaled units.
     * @param scene prepared scene
     * @param triangles of the first mesh
     * @throws InputError if there is no load to bound, more than one, or a rigid motion
     * of the body is free
     */
    void
    prepare(const Scene &scene, const Triangles &triangles);

    /**
     * Prepares strength reduction, in which the load factor multiplies all loads, i.e.
     * self-weight and tractions.
     * @throws InputError also for cohesionless soil, whose load factor is zero or
     * infinite
     */
    void
    prepare_reduction(const Scene &scene, const Triangles &triangles);

    /** Returns the input of upper_problem() and lower_problem() on a mesh. */
    BoundScene
    on(const Scene &scene, const Triangles &triangles) const;

    /** Returns the input on a mesh for reduced strength, c/F and tan(phi)/F. */
    BoundScene
    reduced(const Scene     &scene,
            const Triangles &triangles,
            const double     F) const;

    /** Returns the input on a mesh for Davis's equivalent material, with associated flow
     *  and the strength q c/F and q tan(phi)/F, where
     *  q = cos(theta) cos(phi)/(1 - sin(theta) sin(phi)). */
    BoundScene
    by_davis(const Scene       &scene,
             const Triangles   &triangles,
             const double       F,
             const DavisVariant variant) const;

  private:
    /** Checks strength that increases with depth. @throws InputError if the strength is
     *  negative at some vertex */
    void
    check_strength(const Scene &scene, const Triangles &triangles) const;
    void
    check_loads(const Scene &scene, const Triangles &triangles);
    void
    take_cones(const Scene &scene);
    /** Prescribed non-zero velocity of the scene, if any.
     *  @throws InputError for several different velocities */
    std::optional<dealii::Tensor<1, dim>>
    prescribed_velocity(const Scene &scene, const Triangles &triangles) const;
    void
    choose_units(const Scene &scene, const Triangles &triangles);

    std::vector<FlowCone> flow_cones;
    /** Increase of each material's k with depth (Pa/m). */
    std::vector<Material::Growth> growth;
  };
} // namespace geocone::GEOCONE_DIM

#endif
