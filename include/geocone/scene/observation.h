// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_observation_h
#define geocone_scene_observation_h

#include <geocone/base/choice.h>
#include <geocone/boundary/boundary_conditions.h>
#include <geocone/boundary/loading.h>
#include <geocone/laws/material_library.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Returns the exact bearing capacity factor Nq of a strip footing on a
   * weightless half-plane with surcharge. The factor of Reissner (1924),
   * equation (77) of Guillet et al. (2025), is
   *   Nq = exp(pi tan(phi)) tan^2(pi/4 + phi/2).
   * @param phi friction angle (degrees)
   */
  double
  bearing_capacity_factor_q(const double phi);
  /** Returns the exact bearing capacity factor Nc of a strip footing on a
   *  weightless half-plane with cohesion. The factor of Prandtl (1920) is Nc =
   *  (Nq - 1)/tan(phi), and 2 + pi for phi = 0.
   *  @param phi friction angle (degrees) */
  double
  bearing_capacity_factor_c(const double phi);

  /**
   * Observed quantities of a run: reactions of selected supports, displacements
   * of selected points and a reference value of the limit load. The reaction of
   * the first support is the load of the load-displacement curve.
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

    /** Returns true if the run has a load-displacement curve. It belongs to the
     *  first observed support or, if none is observed, to load stepping. */
    bool
    has_load() const
    {
      return !conditions.empty() || of_scaled_loads;
    }
    bool of_scaled_loads = false;

    /** Indices of the observed supports in the list Scene::supports(). */
    std::vector<unsigned int> conditions;

    /** Component of the reaction used as the load: 0 for x, 1 for y, 2 for
     *  z. */
    unsigned int component = 1;

    /** Factor that converts the reaction to the load, e.g. -2 for a downward
     *  load on half of a symmetric body. In load stepping the load is |factor|
     *  times the load factor. */
    double factor = -1.;

    /** Positions (m) at which displacements are reported. */
    std::vector<dealii::Point<dim>> points;

    /** Returns the reference point for moments of the reactions. Without a
     *  value, the point is the centre of the initial bounding box of each
     *  support. */
    std::optional<dealii::Point<dim>>
    moment_centre() const
    {
      return centre.empty() ? std::nullopt : std::make_optional(centre[0]);
    }

    /** Reference value of the limit load (N/m), for comparison with the
     *  result. */
    std::optional<double> reference;
    std::string           reference_name;

    /** Largest relative change of the load over a plateau of the
     *  load-displacement curve (-). */
    double plateau_tolerance = 0.01;

  private:
    /** Sets the reference value to Prandtl's limit load. @throws InputError if
     *  this load does not exist for the material */
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
