// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bounded_load_h
#define geocone_limit_analysis_bounded_load_h

#include <geocone/limit_analysis/bound_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Angles in Davis's factor (1968) for strength reduction by F. All are the
   * same for F = 1. A: those that are given. B: both are reduced, tan(phi)/F
   * and tan(theta)/F. C: phi is, and theta as far as it would exceed it.
   */
  enum class DavisVariant
  {
    A,
    B,
    C
  };

  /** The load bounded by a limit analysis: the choice of the load factor, the strengths
   *  of the materials, and the units in which both are of order one. */
  class BoundedLoad
  {
  public:
    /** Declares "Load factor of" in a section. */
    void
    declare(dealii::ParameterAcceptor &section);

    /**
     * @param scene prepared
     * @param triangles of its first mesh
     * @throws InputError if there is no load to bound, more than one, or a rigid motion
     * of the body is free
     */
    void
    prepare(const Scene &scene, const Triangles &triangles);

    /**
     * Prepares strength reduction: the factor multiplies all loads, weight and
     * tractions.
     * @throws InputError also for cohesionless soil, whose load factor is zero or
     * infinite
     */
    void
    prepare_reduction(const Scene &scene, const Triangles &triangles);

    /** Input of upper_problem() and lower_problem() on a mesh. */
    BoundScene
    on(const Scene &scene, const Triangles &triangles) const;

    /** The same with c/F and tan(phi)/F instead of c and tan(phi). */
    BoundScene
    reduced(const Scene     &scene,
            const Triangles &triangles,
            const double     F) const;

    /** The same with the strength of Davis, whose flow is associated: q c/F and
     *  q tan(phi)/F with q = cos(theta) cos(phi)/(1 - sin(theta) sin(phi)). */
    BoundScene
    by_davis(const Scene       &scene,
             const Triangles   &triangles,
             const double       F,
             const DavisVariant variant) const;

    /** Loads multiplied by the factor, never automatic. */
    LoadFactor
    factor() const
    {
      return chosen;
    }

    std::string
    word() const;

    /** Load for the load factor 1 of a problem: (N/m) for a reaction, else
     *  1. */
    double
    value_of_unit() const
    {
      return load_unit;
    }

    std::string
    unit() const
    {
      return chosen == LoadFactor::velocity ? "N/m" : "-";
    }

    /** The unit, if any, after a blank. */
    std::string
    after_number() const
    {
      return chosen == LoadFactor::velocity ? " N/m" : "";
    }

    /** Whether the dilatancy of some material is smaller than its friction. */
    bool
    non_associated() const
    {
      return less_dilatant;
    }

    BoundUnits units;

  private:
    /** @throws InputError where strength that grows with depth becomes negative */
    void
    check_strength(const Scene &scene, const Triangles &triangles) const;
    void
    check_loads(const Scene &scene, const Triangles &triangles);
    void
    take_cones(const Scene &scene);
    /** The prescribed non-zero velocity, if any.
     *  @throws InputError if there are several */
    std::optional<dealii::Tensor<1, dim>>
    prescribed_velocity(const Scene &scene, const Triangles &triangles) const;
    void
    choose_factor(const Scene &scene, const Triangles &triangles);
    void
    choose_units(const Scene &scene, const Triangles &triangles);

    Choice<LoadFactor>    asked     = {{{"automatic", LoadFactor::automatic},
                                        {"velocity", LoadFactor::velocity},
                                        {"weight", LoadFactor::weight},
                                        {"tractions", LoadFactor::tractions}}};
    LoadFactor            chosen    = LoadFactor::automatic;
    double                load_unit = 1.;
    std::vector<FlowCone> flow_cones;
    /** Growth of their k with depth (Pa/m). */
    std::vector<Material::Growth> growth;
    bool                          less_dilatant = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
