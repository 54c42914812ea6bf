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
   * Exact bearing capacity factors Nq and Nc of a weightless half-plane under a
   * strip footing (Prandtl 1920, Reissner 1924; Guillet et al. 2025, equation
   * (77)):
   *   Nq = exp(pi tan(phi)) tan^2(pi/4 + phi/2),  Nc = (Nq - 1)/tan(phi),
   * and Nc = 2 + pi for phi = 0.
   * @param phi friction angle (degrees)
   */
  double
  bearing_capacity_factor_q(const double phi);
  double
  bearing_capacity_factor_c(const double phi);

  /**
   * Observed quantities of a run: reactions of selected supports, the first of
   * which is the load of the load-displacement curve, and a reference value of
   * the limit load.
   */
  class Observation : public dealii::ParameterAcceptor
  {
  public:
    Observation();

    void
    prepare(const std::vector<std::string> &supports,
            const Materials                &materials,
            const Gravity                  &gravity,
            const bool                      scales_loads);

    /** Whether a load-displacement curve exists: of the first observed support
     *  or, if none is observed, of load stepping. */
    bool
    has_load() const
    {
      return !conditions.empty() || of_scaled_loads;
    }
    bool of_scaled_loads = false;

    /** Indices of the observed supports in Scene::supports(). */
    std::vector<unsigned int> conditions;

    /** Component of the reaction that is the load: 0 for x, 1 for y, 2 for
     *  z. */
    unsigned int component = 1;

    /** Factor from the reaction to the load, e.g. -2 for a downward load on
     *  half of a symmetric body; for load stepping, load = |factor| x load
     *  factor. */
    double factor = -1.;

    /** Positions whose displacement is reported. */
    std::vector<dealii::Point<dim>> points;

    /** Reference point of the moments of the reactions; no value: the centre of
     *  the initial bounding box of each support. */
    std::optional<dealii::Point<dim>>
    moment_centre() const
    {
      return centre.empty() ? std::nullopt : std::make_optional(centre[0]);
    }

    /** Reference value of the limit load (N/m). */
    std::optional<double> reference;
    std::string           reference_name;

    /** Tolerance for the relative drift of the load over a plateau (-). */
    double plateau_tolerance = 0.01;

  private:
    /** Sets the reference value to Prandtl's limit load. @throws InputError if
     *  the material does not have one */
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
