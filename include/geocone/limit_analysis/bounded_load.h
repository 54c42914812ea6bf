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
   * What a limit analysis bounds: the load that a factor multiplies, the strengths
   * of the materials, and the units in which both are of order one.
   */
  class BoundedLoad
  {
  public:
    /** Declares "Load factor of" in a section. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** @param scene prepared @param triangles its first mesh
     *  @throws InputError if there is nothing to be bounded, too much, or a body
     *  that is not held */
    void
    prepare(const Scene &scene, const Triangles &triangles);

    /** The same where the strength is reduced: the factor is that of all loads,
     *  weight and tractions. @throws InputError also for soil without cohesion,
     *  whose load factor is zero or infinite */
    void
    prepare_reduction(const Scene &scene, const Triangles &triangles);

    /** The scene on a mesh, as upper_problem() and lower_problem() take it. */
    BoundScene
    on(const Scene &scene, const Triangles &triangles) const;

    /** The same with c/F and tan(phi)/F in place of c and tan(phi). */
    BoundScene
    reduced(const Scene     &scene,
            const Triangles &triangles,
            const double     F) const;

    /**
     * The same with the strength of Davis (1968), whose flow is associated:
     *   tan(phi*) = cos(theta) sin(phi)/(1 - sin(theta) sin(phi)),
     * and c* alike with c cos(phi); both divided by F.
     */
    BoundScene
    by_davis(const Scene     &scene,
             const Triangles &triangles,
             const double     F) const;

    /** What the factor multiplies, never automatic. */
    LoadFactor
    factor() const
    {
      return chosen;
    }

    std::string
    word() const;

    /** The load of a problem's 1: (N/m) for a reaction, else 1. */
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

    /** The unit after a blank, if there is one. */
    std::string
    after_number() const
    {
      return chosen == LoadFactor::velocity ? " N/m" : "";
    }

    /** Whether some material dilates less than its friction. */
    bool
    non_associated() const
    {
      return less_dilatant;
    }

    BoundUnits units;

  private:
    /** @throws InputError where strength that grows with depth is not there */
    void
    check_strength(const Scene &scene, const Triangles &triangles) const;
    void
    check_loads(const Scene &scene, const Triangles &triangles);
    void
    take_cones(const Scene &scene);
    /** The velocity that is prescribed, where it is not zero.
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
    /** How their k grow with depth (Pa/m). */
    std::vector<Material::Growth> growth;
    bool                          less_dilatant = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
