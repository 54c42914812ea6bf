// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/implicit/scaled_loads.h>

namespace geocone::GEOCONE_DIM
{
  void
  ScaledLoads::check(const Scene &scene)
  {
    if (scene.loading.scales_loads())
      scene.refuse_contact("stages with 'Scaled loads'",
                           "leave one of them out; bodies that press are "
                           "held by 'Boundary conditions'");
  }

  void
  ScaledLoads::add_row(const Stage  &stage,
                       const Vector &force,
                       const Vector &prescribed,
                       Constraints  &constraints)
  {
    scaled = force;
    if (!constraints.multipliers.add_loads(
          scaled, stage.control_velocity, constraints, prescribed))
      throw StepFailure(
        "'Loading/" + stage.name +
        "/Scaled loads': they exert no force on what can move\n"
        "  remedy:  check their values in this stage, and whether their "
        "places are held");
  }

  double
  ScaledLoads::add_scaled_loads(const Constraints     &constraints,
                                const Eigen::VectorXd &lambda,
                                Vector                &force,
                                Vector                &residual) const
  {
    if (scaled.size() == 0)
      return 1.;
    const double factor = constraints.multipliers.load_factor(lambda);
    force.add(factor, scaled);
    for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
      if (constraints.is_prescribed(i))
        residual.local_element(i) -= factor * scaled.local_element(i);
    return factor;
  }
} // namespace geocone::GEOCONE_DIM
