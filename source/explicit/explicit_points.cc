// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Material points of the explicit material point method: seeds, order, removal.
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/stop_request.h>
#include <geocone/explicit/explicit_points.h>
#include <geocone/points/history_start.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  ExplicitPoints::ExplicitPoints(const MPI_Comm comm, Exchange &sum)
    : comm(comm)
    , sum(sum)
  {}

  void
  ExplicitPoints::prepare(const Scene &scene_, const bool b_bar_)
  {
    scene        = &scene_;
    b_bar        = b_bar_;
    axisymmetric = scene->geometry.is_axisymmetric();
    kernels      = &transfer_kernels();
    water.prepare(*scene, rule, b_bar);
  }

  void
  ExplicitPoints::use(std::unique_ptr<GridTransfer>   transfer_,
                      const Point<dim>               &datum_,
                      const std::vector<std::string> &sides)
  {
    transfer     = std::move(transfer_);
    datum        = datum_;
    least_radius = 1e-6 * transfer->cell_size();
    water.use(*transfer, sides);
  }

  PointArrays
  ExplicitPoints::make_group(const unsigned int material) const
  {
    return {material,
            scene->materials.law(material).n_history() + water.n_variables(),
            rule.is_affine(),
            transfer->keeps_cells()};
  }

  double
  ExplicitPoints::seed(
    const std::vector<std::size_t>                   &n,
    const std::function<void(const Seeding::Take &)> &for_each,
    const Space                                      &space,
    std::vector<std::string>                         &remarks)
  {
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      {
        all_groups.push_back(make_group(m));
        all_groups.back().set_capacity(n[m]);
      }
    unsigned int       next = 0;
    const unsigned int here =
      std::accumulate(n.begin(), n.end(), std::size_t(0));
    MPI_Exscan(&here, &next, 1, MPI_UNSIGNED, MPI_SUM, comm);
    HistoryStart start;
    double       largest_mass = 0.;
    for_each([&](const Seed &seed) {
      if (start.is_refused())
        return;
      PointArrays       &group = all_groups[seed.material];
      const unsigned int p     = group.append();
      group.id[p]              = next++;
      set_point(group, p, seed);
      largest_mass = std::max(largest_mass, group.mass[p]);
      start_history(group, p, seed, space.band_width(seed.cell), start);
    });
    start.check<InputError>(comm);
    start.remark(comm, remarks);
    for (PointArrays &group : all_groups)
      group.pad();
    sums.wave_speed2 = Utilities::MPI::max(sums.wave_speed2, comm);
    sums.speed2      = Utilities::MPI::max(sums.speed2, comm);
    return Utilities::MPI::max(largest_mass, comm);
  }

  void
  ExplicitPoints::set_point(PointArrays       &group,
                            const unsigned int p,
                            const Seed        &seed) const
  {
    if (transfer->keeps_cells())
      group.cell[p] = numbers::invalid_unsigned_int;
    for (unsigned int d = 0; d < dim; ++d)
      {
        group.position[d][p] = seed.position[d];
        group.start[d][p]    = seed.position[d];
        group.velocity[d][p] = seed.velocity[d];
      }
    const auto components = components_of(seed.stress);
    for (int i = 0; i < n_mandel; ++i)
      group.stress[i][p] = components[i];
    group.volume[p] = seed.volume;
    group.mass[p] = seed.volume * scene->density(seed.material, seed.position);
    if (rule.is_affine())
      {
        const Tensor<2, dim> gradient = scene->initial_velocity.gradient(
          seed.position,
          scene->geometry.size_of_point(seed.position, seed.volume));
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            group.affine[dim * c + d][p] = gradient[c][d];
      }
  }

  void
  ExplicitPoints::start_history(PointArrays       &group,
                                const unsigned int p,
                                const Seed        &seed,
                                const double       band_width,
                                HistoryStart      &start)
  {
    if (!std::isfinite(seed.velocity.norm()) ||
        !std::isfinite(seed.stress.norm()))
      {
        start.refuse(format("the initial stress or velocity at (%s) is "
                            "not a finite number\n  remedy:  check the "
                            "formulas in 'Initial stress' and 'Initial "
                            "velocity'",
                            text_of_place(seed.position).c_str()));
        return;
      }
    const ConstitutiveLaw        &law = scene->materials.law(seed.material);
    const ConstitutiveLaw::Stress stress =
      stress_of(extended(seed.stress, seed.stress_zz));
    std::vector<double> values(group.n_history());
    start.set(law, stress, band_width, seed.position, values.data());
    if (water.acts())
      water.initialise(seed.position, seed.velocity, &values[law.n_history()]);
    for (unsigned int k = 0; k < values.size(); ++k)
      group.history[k][p] = values[k];
    double modulus = law.wave_modulus(stress, values.data());
    if (water.acts() && water.is_saturated(group, p))
      modulus = water.wave_modulus(seed.material, modulus);
    sums.wave_speed2 = std::max(sums.wave_speed2, modulus / law.density());
    sums.speed2      = std::max(sums.speed2, seed.velocity.norm_square());
  }

  std::array<unsigned long, 2>
  ExplicitPoints::n_removed_by(const Stage &stage) const
  {
    unsigned long n_removed = 0;
    for (const PointArrays &group : all_groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        n_removed += stage.removes(group.position.of(p));
    return {{Utilities::MPI::sum(n_removed, comm),
             Utilities::MPI::sum(n_of_rank(), comm)}};
  }

  std::string
  ExplicitPoints::remove(const Stage &stage)
  {
    const auto [n_removed, n_all] = n_removed_by(stage);
    const std::string text = stage.removal_text(n_removed, n_all, "points");

    double                   removed_mass = 0.;
    Tensor<1, dim>           lost;
    const bool               at_once = stage.removal_duration == 0.;
    std::vector<PointArrays> ramped;
    for (PointArrays &group : all_groups)
      {
        std::vector<unsigned int> staying;
        ramped.push_back(make_group(group.of_material));
        ramped.back().ramped = true;
        std::vector<double> row(group.n_numbers());
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            if (!stage.removes(group.position.of(p)))
              {
                staying.push_back(p);
                continue;
              }
            removed_mass += group.mass[p];
            lost += momentum(group, p);
            if (at_once)
              remove_point(group, p);
            else
              {
                group.get(p, row.data());
                ramped.back().append(row.data());
              }
          }
        if (staying.size() < group.n_points())
          group.reorder(staying);
      }
    removed_mass = Utilities::MPI::sum(removed_mass, comm);
    lost         = Utilities::MPI::sum(lost, comm);
    if (!at_once)
      for (PointArrays &group : ramped)
        {
          group.pad();
          all_groups.push_back(group);
        }
    return text + format(": %.6g %s, momentum (%s) %s",
                         removed_mass,
                         unit("kg/m").c_str(),
                         text_of_vector(lost, "%.3g").c_str(),
                         unit("N s/m").c_str());
  }

  void
  ExplicitPoints::reset_displacements()
  {
    for (PointArrays &group : all_groups)
      {
        for (unsigned int d = 0; d < dim; ++d)
          std::copy_n(group.position[d], group.n_padded(), group.start[d]);
        std::fill(group.cumulative_plastic_strain.begin(),
                  group.cumulative_plastic_strain.end(),
                  0.);
      }
  }

  void
  ExplicitPoints::reset_velocity()
  {
    stop();
    sums.speed2 = 0.;
  }

  void
  ExplicitPoints::reset_history(std::vector<std::string> &remarks)
  {
    HistoryStart start;
    for (PointArrays &group : all_groups)
      {
        const ConstitutiveLaw &law = scene->materials.law(group.of_material);
        const unsigned int     n   = group.n_history();
        std::vector<double>    values(n);
        for (unsigned int p = 0; p < group.n_points() && n > 0; ++p)
          {
            group.copy_history(p, values.data());
            start.set(
              law,
              law.full_stress(group.stress_components(p), values.data()),
              law.size(values.data()),
              group.start.of(p),
              values.data());
            for (unsigned int k = 0; k < n; ++k)
              group.history[k][p] = values[k];
          }
        group.pad();
      }
    start.check<StepFailure>(comm);
    start.remark(comm, remarks);
  }

  void
  ExplicitPoints::count_removal(const PointArrays &group,
                                const unsigned int p,
                                const double       part)
  {
    const double m = part * group.mass[p];
    sum.removed_mass += m;
    sum.removed_momentum += m * group.velocity.of(p);
    sum.removed_energy += part * kinetic_energy(group, p);
    sum.removed_potential -=
      m * (scene->gravity.at(1e300) * (group.position.of(p) - datum));
    if (water.acts() && water.is_saturated(group, p))
      {
        sum.removed_momentum += part * water.relative_momentum(group, p);
        sum.removed_volume += part * group.volume[p];
        sum.removed_stored += part * water.stored_water(group, p);
      }
  }

  void
  ExplicitPoints::remove_point(PointArrays &group, const unsigned int p)
  {
    count_removal(group, p, 1.);
    group.mass[p]   = 0.;
    group.volume[p] = 0.;
  }

  void
  ExplicitPoints::fade_points(const TransferBlock &points)
  {
    PointArrays &group = all_groups[points.group];
    for (unsigned int k = 0; k < points.n; ++k)
      {
        // The remaining cross-section shrinks; the removed part is counted.
        const unsigned int p = points.first + k;
        count_removal(group, p, 1. - mass_ratio);
        group.mass[p] *= mass_ratio;
        group.volume[p] *= mass_ratio;
      }
  }

  void
  ExplicitPoints::remove_massless()
  {
    for (PointArrays &group : all_groups)
      {
        std::vector<unsigned int> staying;
        for (unsigned int p = 0; p < group.n_points(); ++p)
          if (group.mass[p] > 0.)
            staying.push_back(p);
        if (staying.size() < group.n_points())
          group.reorder(staying);
      }
    some_left = false;
  }

  void
  ExplicitPoints::stop()
  {
    for (PointArrays &group : all_groups)
      {
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            sum.stopped_energy += kinetic_energy(group, p);
            sum.impulse -= momentum(group, p);
          }
        for (unsigned int d = 0; d < dim; ++d)
          std::fill_n(group.velocity[d], group.n_padded(), 0.);
        if (rule.is_affine())
          for (unsigned int i = 0; i < dim * dim; ++i)
            std::fill_n(group.affine[i], group.n_padded(), 0.);
      }
    if (water.acts())
      water.stop(all_groups);
  }

  void
  ExplicitPoints::end_removal()
  {
    // Remainders of the points by rounding are removed with them.
    for (PointArrays &group : all_groups)
      if (group.ramped)
        for (unsigned int p = 0; p < group.n_points(); ++p)
          remove_point(group, p);
    std::vector<PointArrays> staying;
    for (PointArrays &group : all_groups)
      if (!group.ramped)
        staying.push_back(std::move(group));
    all_groups.swap(staying);
  }

  bool
  ExplicitPoints::sort()
  {
    if (Utilities::MPI::logical_or(some_left, comm))
      remove_massless();
    if (Utilities::MPI::sum(n_of_rank(), comm) == 0)
      throw StepFailure("all points have left the background mesh\n"
                        "  remedy:  end the loading earlier, or enlarge "
                        "'Mesh/Box'");
    const unsigned int before = transfer->n_repartitions();
    transfer->sort(all_groups);
    for (const auto &[g, p] : transfer->lost)
      {
        PointArrays &group = all_groups[g];
        if (outflow.is_error() && error_message.empty())
          error_message = lost_point_message(group, p);
        remove_point(group, p);
        some_left = true;
      }
    if (Utilities::MPI::logical_or(!error_message.empty(), comm))
      throw StepFailure(text_of_any_rank(comm, error_message));
    return transfer->n_repartitions() > before;
  }

  void
  ExplicitPoints::begin_step(const double mass_ratio_)
  {
    sums       = PassSums();
    mass_ratio = mass_ratio_;
  }

  double
  ExplicitPoints::stability_limit() const
  {
    return transfer->cell_size() /
           (std::sqrt(sums.wave_speed2) + std::sqrt(sums.speed2));
  }

  ExplicitPoints::Decisions
  ExplicitPoints::combine(const bool must_sort)
  {
    if (error_message.empty() && !(sums.least_volume > 0.))
      for (const PointArrays &group : all_groups)
        for (unsigned int p = 0; p < group.n_points() && error_message.empty();
             ++p)
          if (!(group.volume[p] > 0.) && group.mass[p] > 0.)
            error_message =
              format("the volume of point %u at (%s) has become "
                     "zero or negative\n"
                     "  remedy:  take a smaller 'Explicit/Courant "
                     "number' or 'Explicit/Time step', or splines",
                     group.id[p],
                     text_of_place(group.position.of(p)).c_str());
    double largest[6] = {
      sums.wave_speed2,
      sums.speed2,
      sums.strain,
      double(must_sort || some_left || transfer->must_sort(sums)),
      double(!error_message.empty()),
      double(stop_request_of_rank())};
    Utilities::MPI::max(largest, comm, largest);
    sums.wave_speed2 = largest[0];
    sums.speed2      = largest[1];
    sums.strain      = largest[2];
    if (largest[4] > 0.)
      throw StepFailure(text_of_any_rank(comm, error_message));
    return {largest[3] > 0., static_cast<int>(largest[5])};
  }
} // namespace geocone::GEOCONE_DIM
