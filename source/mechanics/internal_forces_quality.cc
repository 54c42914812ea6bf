// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What is checked of a state that a solver has found, whichever it was.
#include <geocone/base/log.h>
#include <geocone/mechanics/internal_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** The stress scale (Pa) and the strain scale of Quality. */
    struct Scales
    {
      double stress, strain;
    };

    /** Of a point, but for the excess of the exact cone. @param cone that was solved
     *  for @param z,s in its axes, in the plane or in space */
    template <typename Vector>
    Quality
    quality_of(const FlowCone &cone,
               const Vector   &z,
               const Vector   &s,
               const double    two_G,
               const Scales   &scales)
    {
      Quality here;
      here.cone_violation = cone.yield_function(s) / scales.stress;
      // The complementarity law is that of a cone without a cut-off.
      if (s[0] > -cone.tension + 1e-12 * scales.stress)
        {
          const auto y = cone.psi(z);
          here.natural_map =
            natural_map(cone, s, y, two_G).norm() / scales.stress;
          if (scales.strain > 0.)
            {
              here.dual_violation = cone.dual_violation(y) / scales.strain;
              here.complementarity =
                std::abs(cone.complementarity_product(y, s)) /
                (scales.strain * scales.stress);
            }
        }
      return here;
    }
  } // namespace

  std::string
  InternalForces::not_a_number() const
  {
    std::string where;
    for (unsigned int p = 0; p < points.n_points() && where.empty(); ++p)
      if (!strain[p].allFinite() || !stress[p].allFinite() ||
          (!stress_zz.empty() && !std::isfinite(stress_zz[p])))
        where =
          format(" at the point %u (", points.id.empty() ? p : points.id[p]) +
          text_of_place(points.position[p]) + ")";
    return text_of_any_rank(comm, where);
  }

  double
  InternalForces::memory_work() const
  {
    double sum = 0.;
    for (const Run &run : runs)
      {
        const Material &material = materials[run.material];
        if (!(material.friction_memory() > 0.))
          continue;
        for (unsigned int p = run.begin; p < run.end; ++p)
          {
            if (mode[p] == Mode::elastic)
              continue;
            const SpatialMandel plastic = plastic_strain_increment(p);
            if (material.is_spatial())
              {
                sum += points.weight[p] *
                       material.power_beyond_strength(plastic, whole_stress(p));
                continue;
              }
            const Mandel z    = to_cone_axes(Mandel(plastic.head<n_mandel>()));
            const Mandel s    = to_cone_axes(stress[p]);
            const double slip = FlowCone::tangential_norm(z);
            const auto   exact =
              material.exact_end_cone(points.history_of(p), slip);
            sum += points.weight[p] * slip * std::abs(exact->yield_function(s));
          }
      }
    return Utilities::MPI::sum(sum, comm);
  }

  template <typename Function>
  void
  InternalForces::for_each_cone(const Function &f) const
  {
    for (const Run &run : runs)
      {
        const Material   &law     = materials[run.material];
        const Elasticity &elastic = law.elasticity();
        const bool        is_cone =
          law.flow_cone(points.history_of(run.begin)).has_value();
        for (unsigned int p = run.begin; p < run.end; ++p)
          if (law.is_spatial())
            {
              const SpatialMandel s = whole_stress(p), s_n = whole_stress_n(p);
              if (const auto solved = law.spatial_step_cone(
                    s_n, points.history_of(p), step_law()))
                f(SpatialMandel(
                    spatial_axes() *
                    (elastic.strain(SpatialMandel(s - s_n)) - whole_strain(p))),
                  SpatialMandel(spatial_axes() * s),
                  *solved,
                  *law.spatial_cone(),
                  elastic.two_G);
            }
          else if (is_cone)
            {
              const Mandel z = to_cone_axes(
                Mandel(elastic.strain(Mandel(stress[p] - points.stress[p])) -
                       strain[p]));
              const double slip = FlowCone::tangential_norm(z);
              f(z,
                to_cone_axes(stress[p]),
                *law.end_cone(
                  points.stress[p], points.history_of(p), step_law(), slip),
                *law.exact_end_cone(points.history_of(p), slip),
                elastic.two_G);
            }
      }
  }

  Quality
  InternalForces::quality() const
  {
    // Two passes: the scales of all ranks first.
    double stress_scale = 0., k_scale = 0., y_scale = 0., compliance = 0.;
    for_each_cone([&](const auto     &z,
                      const auto     &s,
                      const FlowCone &solved,
                      const FlowCone &exact,
                      const double    two_G) {
      compliance   = std::max(compliance, 1. / two_G);
      k_scale      = std::max(k_scale, exact.k);
      stress_scale = std::max(stress_scale, s.norm());
      y_scale      = std::max(y_scale, solved.psi(z).norm());
    });
    Scales scales;
    scales.stress = Utilities::MPI::max(stress_scale, comm) +
                    Utilities::MPI::max(k_scale, comm);
    scales.strain =
      std::max(Utilities::MPI::max(y_scale, comm),
               scales.stress * Utilities::MPI::max(compliance, comm));

    Quality worst;
    for_each_cone([&](const auto     &z,
                      const auto     &s,
                      const FlowCone &solved,
                      const FlowCone &exact,
                      const double    two_G) {
      Quality here     = quality_of(solved, z, s, two_G, scales);
      here.cone_excess = exact.yield_function(s);
      worst.take_worse(here);
    });
    // Of laws with another surface, its excess alone.
    for (const Run &run : runs)
      for (unsigned int p = run.begin;
           p < run.end && materials[run.material].is_spatial();
           ++p)
        if (const auto f =
              materials[run.material].yield_function(whole_stress(p)))
          worst.cone_excess = std::max(worst.cone_excess, *f);
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
