// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Sums and extrema of the points of the explicit material point method, over
// all ranks.
#include <geocone/base/over_ranks.h>
#include <geocone/explicit/explicit_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  double
  ExplicitPoints::kinetic_energy(const PointArrays &group,
                                 const unsigned int p) const
  {
    const double energy =
      group.mass[p] * group.velocity.of(p).norm_square() / 2.;
    return water.acts() ? energy + water.relative_energy(group, p) : energy;
  }

  Tensor<1, dim>
  ExplicitPoints::momentum(const PointArrays &group, const unsigned int p) const
  {
    Tensor<1, dim> sum = group.mass[p] * group.velocity.of(p);
    if (water.acts())
      sum += water.relative_momentum(group, p);
    return sum;
  }

  double
  ExplicitPoints::kinetic_energy() const
  {
    double energy = 0.;
    for (const PointArrays &group : all_groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        energy += kinetic_energy(group, p);
    return Utilities::MPI::sum(energy, comm);
  }

  unsigned long
  ExplicitPoints::n_of_rank() const
  {
    unsigned long n = 0;
    for (const PointArrays &group : all_groups)
      n += group.n_points();
    return n;
  }

  double
  ExplicitPoints::mass_of_rank() const
  {
    double mass = 0.;
    for (const PointArrays &group : all_groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        mass += group.mass[p];
    return mass;
  }

  namespace
  {
    /** Replaces sums and maxima of each rank by those of all ranks.
     *  Collective. */
    void
    gather_totals(ExplicitState &s, const MPI_Comm comm)
    {
      s.n_points           = Utilities::MPI::sum(s.n_points, comm);
      s.mass               = Utilities::MPI::sum(s.mass, comm);
      s.volume             = Utilities::MPI::sum(s.volume, comm);
      s.energies.kinetic   = Utilities::MPI::sum(s.energies.kinetic, comm);
      s.energies.potential = Utilities::MPI::sum(s.energies.potential, comm);
      s.momentum           = Utilities::MPI::sum(s.momentum, comm);
      s.angular_momentum   = Utilities::MPI::sum(s.angular_momentum, comm);
      s.largest_speed      = Utilities::MPI::max(s.largest_speed, comm);
      s.saturated_volume   = Utilities::MPI::sum(s.saturated_volume, comm);
      s.stored_water       = Utilities::MPI::sum(s.stored_water, comm);
      s.largest_plastic_strain =
        Utilities::MPI::max(s.largest_plastic_strain, comm);
    }

    /** Replaces the limiting point of each rank by that of all ranks.
     *  Collective.
     *  @param fastest its c^2, < 0 without points */
    void
    find_limiting_point(double fastest, const MPI_Comm comm, ExplicitState &s)
    {
      std::array<double, 2 + dim> limit = {{fastest, double(s.limiting_id)}};
      for (unsigned int d = 0; d < dim; ++d)
        limit[2 + d] = s.limiting_place[d];
      for (const auto &w : Utilities::MPI::all_gather(comm, limit))
        if (w[0] >= fastest)
          {
            fastest       = w[0];
            s.limiting_id = static_cast<unsigned int>(w[1]);
            for (unsigned int d = 0; d < dim; ++d)
              s.limiting_place[d] = w[2 + d];
          }
      s.limiting_wave_speed = std::sqrt(std::max(fastest, 0.));
    }
  } // namespace

  ExplicitState
  ExplicitPoints::state() const
  {
    ExplicitState s;
    // With the full gravity, also while it increases.
    const Tensor<1, dim> g = scene->gravity.at(1e300);
    double               bounds[2 * dim];
    std::fill_n(bounds, 2 * dim, 1e300);
    double fastest = -1.;
    for (const PointArrays &group : all_groups)
      {
        const ConstitutiveLaw &law = scene->materials.law(group.of_material);
        std::vector<double>    values(group.n_history());
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            const double     m = group.mass[p];
            const Point<dim> x = group.position.of(p);
            if (!(m > 0.))
              continue; // has left the mesh
            ++s.n_points;
            const Tensor<1, dim> v = group.velocity.of(p);
            s.mass += m;
            s.volume += group.volume[p];
            s.energies.kinetic += kinetic_energy(group, p);
            s.energies.potential -= m * (g * (x - datum));
            s.momentum += momentum(group, p);
            for (unsigned int i = 0; i < n_rotations; ++i)
              {
                const auto [a, b] = plane_of_rotation[i];
                s.angular_momentum[i] += m * (x[a] * v[b] - x[b] * v[a]);
              }
            for (unsigned int d = 0; d < dim; ++d)
              {
                bounds[d]       = std::min(bounds[d], x[d]);
                bounds[dim + d] = std::min(bounds[dim + d], -x[d]);
              }
            s.largest_speed          = std::max(s.largest_speed, v.norm());
            s.largest_plastic_strain = std::max(
              s.largest_plastic_strain, group.cumulative_plastic_strain[p]);
            group.copy_history(p, values.data());
            double modulus = law.wave_modulus(
              law.full_stress(group.stress_components(p), values.data()),
              values.data());
            if (water.acts() && water.is_saturated(group, p))
              {
                modulus = water.wave_modulus(group.of_material, modulus);
                s.saturated_volume += group.volume[p];
                s.stored_water += water.stored_water(group, p);
              }
            const double c2 = modulus * group.volume[p] / m;
            if (c2 > fastest)
              {
                fastest          = c2;
                s.limiting_id    = group.id[p];
                s.limiting_place = x;
              }
          }
      }
    gather_totals(s, comm);
    Utilities::MPI::min(bounds, comm, bounds);
    for (unsigned int d = 0; d < dim; ++d)
      {
        s.lower[d] = bounds[d];
        s.upper[d] = -bounds[dim + d];
      }

    find_limiting_point(fastest, comm, s);

    s.left_front  = mass_quantile(0.01 * s.mass, s.lower[0], s.upper[0]);
    s.right_front = mass_quantile(0.99 * s.mass, s.lower[0], s.upper[0]);
    return s;
  }

  double
  ExplicitPoints::mass_quantile(const double wanted,
                                double       left,
                                double       right) const
  {
    // Refines the interval that contains the quantile, in equal parts.
    double before = 0.;
    for (unsigned int round = 0; round < 2 && right > left; ++round)
      {
        std::vector<double> part(1000, 0.);
        const double        per_width = part.size() / (right - left);
        for (const PointArrays &group : all_groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            {
              const double place = (group.position[0][p] - left) * per_width;
              if (place >= 0. && place <= part.size())
                part[std::min<std::size_t>(place, part.size() - 1)] +=
                  group.mass[p];
            }
        Utilities::MPI::sum(part, comm, part);
        std::size_t i = 0;
        while (i + 1 < part.size() && before + part[i] < wanted)
          before += part[i++];
        left += i / per_width;
        right = left + 1. / per_width;
      }
    return right;
  }

  LawCounts
  ExplicitPoints::law_counts() const
  {
    LawCounts all = counts;
    all.updates   = Utilities::MPI::sum(counts.updates, comm);
    all.substeps  = Utilities::MPI::sum(counts.substeps, comm);
    all.forced    = Utilities::MPI::sum(counts.forced, comm);
    all.limited   = Utilities::MPI::sum(counts.limited, comm);
    all.most      = Utilities::MPI::max(counts.most, comm);
    return all;
  }

  std::size_t
  ExplicitPoints::memory() const
  {
    std::size_t bytes = transfer->memory() + water.memory();
    for (const PointArrays &group : all_groups)
      bytes += group.memory();
    return bytes;
  }
} // namespace geocone::GEOCONE_DIM
