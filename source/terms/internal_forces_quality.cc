// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// State of the points after a solution, its works, and checks that are independent of
// the solver.
#include <geocone/base/log.h>
#include <geocone/terms/internal_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  SpatialMandel
  InternalForces::plastic_strain_increment(const unsigned int p) const
  {
    if (mode[p] == Mode::elastic)
      return SpatialMandel::Zero();
    return whole_strain(p) -
           materials[points.material[p]].elastic_strain(
             whole_stress_n(p), whole_stress(p), points.history_of(p));
  }

  SpatialMandel
  InternalForces::whole_stress(const unsigned int p) const
  {
    return extended(stress[p], stress_zz.empty() ? 0. : stress_zz[p]);
  }

  SpatialMandel
  InternalForces::whole_stress_n(const unsigned int p) const
  {
    // Plane-strain laws do not need s_zz, and frozen problems do not have it.
    const Material &law = materials[points.material[p]];
    return law.is_spatial()
             ? law.whole_stress(points.stress[p], points.history_of(p))
             : extended(points.stress[p], 0.);
  }

  SpatialMandel
  InternalForces::whole_strain(const unsigned int p) const
  {
    return extended(strain[p], is_axisymmetric() ? strain_zz[p] : 0.);
  }

  InternalForces::Work
  InternalForces::work(const unsigned int p) const
  {
    const SpatialMandel s = whole_stress(p);
    double elastic        = s.dot(materials[points.material[p]].elastic_strain(
      whole_stress_n(p), s, points.history_of(p)));
    if (is_undrained())
      elastic -= pressure[p] * trace(whole_strain(p));
    return {elastic, s.dot(plastic_strain_increment(p))};
  }

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
  InternalForces::excess_work() const
  {
    double sum = 0.;
    for (const Run &run : runs)
      {
        const Material &material = materials[run.material];
        if (!(material.friction_memory() > 0.) &&
            !(friction_lag > 0. && material.non_associativity() > 0.))
          continue;
        for (unsigned int p = run.begin; p < run.end; ++p)
          {
            if (mode[p] == Mode::elastic)
              continue;
            const SpatialMandel plastic = plastic_strain_increment(p);
            if (material.is_spatial())
              {
                sum += points.weight[p] *
                       material.excess_work_density(
                         plastic, whole_stress(p), points.history_of(p));
                continue;
              }
            const Mandel z    = to_cone_axes(Mandel(plastic.head<n_mandel>()));
            const Mandel s    = to_cone_axes(stress[p]);
            const double slip = FlowCone::tangential_norm(z);
            const auto   exact =
              material.exact_end_cone(points.history_of(p), slip);
            if (!exact)
              break; // nor has any other point of the law
            sum += points.weight[p] * slip * std::abs(exact->yield_function(s));
          }
      }
    return Utilities::MPI::sum(sum, comm);
  }

  double
  InternalForces::excess_share(const double excess_work) const
  {
    if (excess_work == 0.)
      return 0.;
    double plastic = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      plastic += points.weight[p] * work(p).plastic;
    plastic = Utilities::MPI::sum(plastic, comm);
    return plastic > 0. ? excess_work / plastic
                        : std::numeric_limits<double>::infinity();
  }

  Quality
  InternalForces::quality(const double excess_work) const
  {
    FlowCheck largest;
    for (const Run &run : runs)
      for (unsigned int p = run.begin; p < run.end; ++p)
        {
          const Material &law  = materials[run.material];
          const auto      here = law.check_flow({whole_strain(p),
                                                 whole_stress_n(p),
                                                 whole_stress(p),
                                                 points.history_of(p)},
                                           step_law());
          if (!here)
            break; // nor has any other point of the law
          largest.take_worse(*here);
        }
    std::array<double, FlowCheck::n_numbers> of_ranks;
    for (std::size_t i = 0; i < of_ranks.size(); ++i)
      of_ranks[i] = largest.*FlowCheck::numbers()[i];
    Utilities::MPI::max(
      ArrayView<const double>(of_ranks.data(), of_ranks.size()),
      comm,
      ArrayView<double>(of_ranks.data(), of_ranks.size()));
    for (std::size_t i = 0; i < of_ranks.size(); ++i)
      largest.*FlowCheck::numbers()[i] = of_ranks[i];
    // y is rounding without plastic flow.
    const double stress_scale = largest.stress + largest.size,
                 strain_scale =
                   std::max(largest.flow, stress_scale * largest.compliance);
    if (stress_scale == 0.)
      return {};
    return {largest.natural_map / stress_scale,
            largest.violation / stress_scale,
            largest.dual / strain_scale,
            largest.complementary / (strain_scale * stress_scale),
            largest.excess,
            largest.exact_map / stress_scale,
            excess_share(excess_work)};
  }
} // namespace geocone::GEOCONE_DIM
