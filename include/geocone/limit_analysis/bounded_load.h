// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bounded_load_h
#define geocone_limit_analysis_bounded_load_h

#include <geocone/limit_analysis/bound_problem.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace geocone
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

    /** The scene on a mesh, as upper_problem() and lower_problem() take it. */
    BoundScene
    on(const Scene &scene, const Triangles &triangles) const;

    /**
     * The same with the strength of Davis (1968), whose flow is associated:
     *   tan(phi*) = cos(theta) sin(phi)/(1 - sin(theta) sin(phi)),
     * and c* alike with c cos(phi).
     */
    BoundScene
    by_davis(const Scene &scene, const Triangles &triangles) const;

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
    void
    take_cones(const Scene &scene);
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
    bool                  less_dilatant = false;
  };
} // namespace geocone

#endif
