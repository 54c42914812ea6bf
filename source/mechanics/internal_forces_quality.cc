// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What is checked of a state that a solver has found, whichever it was.
#include <geocone/base/log.h>
#include <geocone/mechanics/internal_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace geocone
{
  using namespace dealii;

  std::string
  InternalForces::not_a_number() const
  {
    std::string where;
    for (unsigned int p = 0; p < points.n_points() && where.empty(); ++p)
      if (!strain[p].allFinite() || !stress[p].allFinite())
        where = format(" at the point %u (%g, %g)",
                       points.id.empty() ? p : points.id[p],
                       points.position[p][0],
                       points.position[p][1]);
    return text_of_any_rank(comm, where);
  }

  double
  InternalForces::memory_work() const
  {
    double sum = 0.;
    for (const Run &run : runs)
      if (const Material &material = materials[run.material];
          material.friction_memory() > 0.)
        for (unsigned int p = run.begin; p < run.end; ++p)
          if (mode[p] != Mode::elastic)
            {
              const Mandel z    = to_cone_axes(plastic_strain_increment(p));
              const Mandel s    = to_cone_axes(stress[p]);
              const double slip = FlowCone::tangential_norm(z);
              const auto   exact =
                material.exact_end_cone(points.history_of(p), slip);
              sum +=
                points.weight[p] * slip * std::abs(exact->yield_function(s));
            }
    return Utilities::MPI::sum(sum, comm);
  }

  Quality
  InternalForces::quality() const
  {
    // Two passes: the scales of all ranks first.
    double     stress_scale = 0., k_scale = 0., y_scale = 0., compliance = 0.;
    const auto z_at = [&](const unsigned int p) {
      const Elasticity &elasticity = materials[points.material[p]].elasticity();
      return to_cone_axes(Mandel(
        elasticity.strain(Mandel(stress[p] - points.stress[p])) - strain[p]));
    };
    // Of the end of the step.
    const auto exact_cone = [&](const unsigned int p, const Mandel &z) {
      return *materials[points.material[p]].exact_end_cone(
        points.history_of(p), FlowCone::tangential_norm(z));
    };
    const auto solved_cone = [&](const unsigned int p, const Mandel &z) {
      return *materials[points.material[p]].end_cone(
        points.stress[p],
        points.history_of(p),
        step_law(),
        FlowCone::tangential_norm(z));
    };
    const auto has_cone = [&](const Run &run) {
      return materials[run.material]
        .flow_cone(points.history_of(run.begin))
        .has_value();
    };
    for (const Run &run : runs)
      if (has_cone(run))
        {
          compliance = std::max(
            compliance, 1. / materials[run.material].elasticity().two_G);
          for (unsigned int p = run.begin; p < run.end; ++p)
            {
              const Mandel z = z_at(p);
              k_scale        = std::max(k_scale, exact_cone(p, z).k);
              stress_scale   = std::max(stress_scale, stress[p].norm());
              y_scale = std::max(y_scale, solved_cone(p, z).psi(z).norm());
            }
        }
    stress_scale = Utilities::MPI::max(stress_scale, comm) +
                   Utilities::MPI::max(k_scale, comm);
    y_scale = std::max(Utilities::MPI::max(y_scale, comm),
                       stress_scale * Utilities::MPI::max(compliance, comm));

    Quality worst;
    for (const Run &run : runs)
      if (has_cone(run))
        for (unsigned int p = run.begin; p < run.end; ++p)
          {
            const double   two_G = materials[run.material].elasticity().two_G;
            const Mandel   z     = z_at(p);
            const FlowCone cone  = solved_cone(p, z);
            const Mandel   s     = to_cone_axes(stress[p]);
            Quality        here;
            here.cone_violation = cone.yield_function(s) / stress_scale;
            here.cone_excess    = exact_cone(p, z).yield_function(s);
            // The complementarity law is that of a cone without a cut-off.
            if (s[0] > -cone.tension + 1e-12 * stress_scale)
              {
                const Mandel y = cone.psi(z);
                here.natural_map =
                  natural_map(cone, s, y, two_G).norm() / stress_scale;
                if (y_scale > 0.)
                  {
                    here.dual_violation = cone.dual_violation(y) / y_scale;
                    here.complementarity =
                      std::abs(cone.complementarity_product(y, s)) /
                      (y_scale * stress_scale);
                  }
              }
            worst.take_worse(here);
          }
    std::array<double, 5> values = {{worst.natural_map,
                                     worst.cone_violation,
                                     worst.dual_violation,
                                     worst.complementarity,
                                     worst.cone_excess}};
    Utilities::MPI::max(ArrayView<const double>(values.data(), values.size()),
                        comm,
                        ArrayView<double>(values.data(), values.size()));
    return {values[0], values[1], values[2], values[3], values[4]};
  }
} // namespace geocone
