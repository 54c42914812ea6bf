// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_observation_h
#define geocone_scene_observation_h

#include <geocone/base/choice.h>
#include <geocone/materials/material_library.h>
#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/loading.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Exact bearing capacity factor of a weightless half-plane under a strip
   * footing (Prandtl 1920, Reissner 1924; paper eq 77):
   *   Nq = exp(pi tan(phi)) tan^2(pi/4 + phi/2),  Nc = (Nq - 1)/tan(phi),
   * and Nc = 2 + pi for phi = 0.
   * @param phi friction angle (degrees)
   */
  double
  bearing_capacity_factor_q(const double phi);
  double
  bearing_capacity_factor_c(const double phi);

  /**
   * Observed quantities of a run: the reactions of some boundary conditions,
   * the first of which is the load of the load-displacement curve, and the
   * reference value for its limit.
   */
  class Observation : public dealii::ParameterAcceptor
  {
  public:
    Observation();

    void
    prepare(const std::vector<std::string> &supports,
            const Materials                &materials,
            const Gravity                  &gravity,
            const bool                      raises_loads);

    /** Whether there is a load-displacement curve: of the first condition or,
     *  without conditions, of load stepping. */
    bool
    has_load() const
    {
      return !conditions.empty() || of_raised_loads;
    }
    bool of_raised_loads = false;

    /** Indices of the observed conditions and obstacles in Scene::supports(). */
    std::vector<unsigned int> conditions;

    /** 0 for x, 1 for y, 2 for z. */
    unsigned int component = 1;

    /** Load = factor x reaction, e.g. -2 for a downward load on a half; or
     *  |factor| x load factor, for load stepping. */
    double factor = -1.;

    /** Positions whose displacement is reported. */
    std::vector<dealii::Point<dim>> points;

    /** Reference point of the moments of the reactions; no value: the centre of
     *  the initial bounding box of each condition. */
    std::optional<dealii::Point<dim>>
    moment_centre() const
    {
      return centre.empty() ? std::nullopt : std::make_optional(centre[0]);
    }

    /** Reference load (N/m). */
    std::optional<double> reference;
    std::string           reference_name;

    /** Largest relative drift of the load over a plateau. */
    double plateau_tolerance = 0.01;

  private:
    /** Sets the reference to Prandtl's load. @throws InputError if there is
     *  none */
    void
    take_prandtl(const Materials &materials, const Gravity &gravity);

    std::vector<dealii::Point<dim>> centre;

    std::vector<std::string> names;

    enum class Component
    {
      x,
      y,
      z
    };
    Choice<Component> observed =
      dim == 2
        ? Choice<Component>({{"y", Component::y}, {"x", Component::x}})
        : Choice<Component>(
            {{"y", Component::y}, {"x", Component::x}, {"z", Component::z}});

    std::string value = "none";
    std::string material;
    double      width     = 0.2;
    double      surcharge = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
