// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bounded_load_h
#define geocone_limit_analysis_bounded_load_h

#include <geocone/bounds/load_choice.h>
#include <geocone/plane_bounds/bound_problem.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Variants of Davis's reduction factor (1968) for strength reduction with
   * non-associated flow. They differ in the friction angle phi and the
   * dilatancy angle theta that enter Davis's factor, and are equal for F = 1.
   * A: given angles. B: both reduced, tan(phi)/F and tan(theta)/F. C: phi
   * reduced; theta reduced only as far as it would exceed phi.
   */
  enum class DavisVariant
  {
    A,
    B,
    C
  };

  /** Load bounded by a plane or axisymmetric limit analysis, with the strength of the
   *  materials and scaled units. In scaled units, loads and strengths are of order one. */
  class BoundedLoad : public LoadChoice
  {
  public:
    /**
     * Selects the loads multiplied by the load factor, and the scaled units of the
     * analysis.
     * @param scene prepared scene
     * @param triangles of the first mesh
     * @throws InputError if there is no load to bound, more than one, or a rigid motion
     * of the body is free
     */
    void
    prepare(const Scene &scene, const Triangles &triangles);

    /**
     * Prepares strength reduction. The load factor multiplies all loads, i.e. self-weight
     * and tractions.
     * @param kind of analysis, for messages
     * @throws InputError also for cohesionless soil, whose load factor is zero or
     * infinite
     */
    void
    prepare_reduction(const Scene       &scene,
                      const Triangles   &triangles,
                      const std::string &kind);

    /**
     * Prepares the analysis of tractions that vary; the weight is a dead load.
     * @param kind of analysis, for messages
     * @throws InputError if a velocity is prescribed that is not zero, or a rigid motion
     * of the body is free
     */
    void
    prepare_tractions(const Scene       &scene,
                      const Triangles   &triangles,
                      const std::string &kind);

    /** Returns the input of the upper-bound and lower-bound problems on a given
     *  mesh. */
    BoundScene
    on(const Scene &scene, const Triangles &triangles) const;

    /** Returns the input of a limit analysis for the strength reduced by the factor F,
     *  i.e. c/F and tan(phi)/F. @param bound input on a mesh, of on() */
    BoundScene
    reduced(BoundScene bound, const double F) const;

    /** Returns the input of a limit analysis for Davis's equivalent material.
     *  This material has associated flow and the strength q c/F and q tan(phi)/F, where q
     *  = cos(theta) cos(phi)/(1 - sin(theta) sin(phi)). @param bound input on a mesh, of
     *  on() */
    BoundScene
    by_davis(BoundScene         bound,
             const double       F,
             const DavisVariant variant) const;

  private:
    /** Checks that strength varying with depth is not negative. @throws InputError if the
     *  strength is negative at some vertex */
    void
    check_strength(const Scene &scene, const Triangles &triangles) const;
    void
    check_loads(const Scene &scene, const Triangles &triangles);
    void
    take_cones(const Scene &scene);
    /** Returns the prescribed non-zero velocity of the scene, or no value.
     *  @throws InputError for several different velocities */
    std::optional<dealii::Tensor<1, dim>>
    prescribed_velocity(const Scene &scene, const Triangles &triangles) const;
    void
    choose_units(const Scene &scene, const Triangles &triangles);
    /** Bounds of the cohesions that are formulas, without units. @throws InputError for
     *  cohesions that may be zero or infinite in a triangle */
    EnclosedCohesion
    enclosed_cohesion(const Scene &scene, const Triangles &triangles) const;
    /** Raises the unit of stress to that of dead loads and structures.
     *  @param dead largest dead load (Pa) */
    void
    add_units_of_structures(const Structures &structures, const double dead);

    /** Selects the strengths of the materials, flow_cones or strengths. */
    void
    take_strengths(const Scene &scene);
    /** Checks the loads of an axisymmetric body and selects the scaled units. */
    void
    check_axisymmetric_loads(const Scene &scene, const Triangles &triangles);

    std::vector<SpatialStrength> strengths; ///< of axisymmetric bodies (Pa)

    std::vector<FlowCone>        flow_cones;
    std::vector<StrengthEllipse> ellipses; ///< of the strengths by direction
    /** Increase of the strength k with depth, for each material (Pa/m). */
    std::vector<Material::StrengthGradient> growth;
    /** Cohesion of materials that have a formula of it (Pa). */
    std::vector<std::optional<EnclosedFormula>> formulas;
  };
} // namespace geocone::GEOCONE_DIM

#endif
