// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Setup of the explicit material point method, and its stages beyond stepping:
// resets, removals, kinetic damping, and the required final equilibrium.
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/explicit/explicit_mpm.h>
#include <geocone/points/history_start.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  ExplicitMPM::seed_columns(const CartesianGrid      &grid,
                            std::vector<std::string> &remarks)
  {
    const auto               in_column = seeding.count(*scene, grid, comm);
    std::vector<std::size_t> points_in;
    for (const auto &of_material : in_column)
      points_in.push_back(std::accumulate(
        of_material.begin(), of_material.end(), std::size_t(0)));
    const auto slabs =
      grid.slabs(points_in, Utilities::MPI::n_mpi_processes(comm));
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    const std::array<unsigned int, 2> own = {
      {static_cast<unsigned int>(slabs[rank]),
       static_cast<unsigned int>(slabs[rank + 1])}};
    std::vector<std::size_t> n(scene->materials.size(), 0);
    for (unsigned int column = own[0]; column < own[1]; ++column)
      for (unsigned int m = 0; m < n.size(); ++m)
        n[m] += in_column[column][m];
    seed_points(
      n,
      [&](const Seeding::Take &take) {
        seeding.for_each(*scene, grid, own, take);
      },
      remarks);
  }

  PointArrays
  ExplicitMPM::make_group(const unsigned int material) const
  {
    return {material,
            scene->materials.law(material).n_history() + water.n_variables(),
            affine,
            transfer->keeps_cells()};
  }

  void
  ExplicitMPM::seed_points(
    const std::vector<std::size_t>                   &n,
    const std::function<void(const Seeding::Take &)> &for_each,
    std::vector<std::string>                         &remarks)
  {
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      {
        groups.push_back(make_group(m));
        groups.back().set_capacity(n[m]);
      }
    unsigned int       next = 0;
    const unsigned int here =
      std::accumulate(n.begin(), n.end(), std::size_t(0));
    MPI_Exscan(&here, &next, 1, MPI_UNSIGNED, MPI_SUM, comm);
    HistoryStart        start;
    double              largest_mass = 0.;
    std::vector<double> values;
    for_each([&](const Seed &seed) {
      if (start.is_refused())
        return;
      PointArrays           &group = groups[seed.material];
      const ConstitutiveLaw &law   = scene->materials.law(seed.material);
      const unsigned int     p     = group.append();
      group.id[p]                  = next++;
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
      group.mass[p] =
        seed.volume * scene->density(seed.material, seed.position);
      largest_mass = std::max(largest_mass, group.mass[p]);
      const ConstitutiveLaw::Stress stress =
        stress_of(extended(seed.stress, seed.stress_zz));
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
      values.resize(group.n_history());
      start.set(
        law, stress, space.band_width(seed.cell), seed.position, values.data());
      if (water.acts())
        water.initialise(
          seed.position, seed.velocity, &values[law.n_history()]);
      for (unsigned int k = 0; k < values.size(); ++k)
        group.history[k][p] = values[k];
      double modulus = law.wave_modulus(stress, values.data());
      if (water.acts() && water.is_saturated(group, p))
        modulus = water.wave_modulus(seed.material, modulus);
      sums.wave_speed2 = std::max(sums.wave_speed2, modulus / law.density());
      sums.speed2 = std::max(sums.speed2, seed.velocity.norm_square());
      if (affine)
        {
          const Tensor<2, dim> gradient = scene->initial_velocity.gradient(
            seed.position,
            scene->geometry.size_of_point(seed.position, seed.volume));
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              group.affine[dim * c + d][p] = gradient[c][d];
        }
    });
    start.check<InputError>(comm);
    start.remark(comm, remarks);
    for (PointArrays &group : groups)
      group.pad();
    least_mass       = 1e-14 * Utilities::MPI::max(largest_mass, comm);
    sums.wave_speed2 = Utilities::MPI::max(sums.wave_speed2, comm);
    sums.speed2      = Utilities::MPI::max(sums.speed2, comm);
  }

  std::vector<std::string>
  ExplicitMPM::begin_stage(const Stage &stage, const double t)
  {
    std::vector<std::string> remarks;
    if (stage.reset_displacement)
      for (PointArrays &group : groups)
        {
          for (unsigned int d = 0; d < dim; ++d)
            std::copy_n(group.position[d], group.n_padded(), group.start[d]);
          std::fill(group.cumulative_plastic_strain.begin(),
                    group.cumulative_plastic_strain.end(),
                    0.);
        }
    if (stage.reset_velocity)
      {
        stop_points();
        sums.speed2 = 0.;
      }
    if (stage.reset_history)
      {
        HistoryStart start;
        for (PointArrays &group : groups)
          {
            const ConstitutiveLaw &law =
              scene->materials.law(group.of_material);
            const unsigned int  n = group.n_history();
            std::vector<double> values(n);
            for (unsigned int p = 0; p < group.n_points() && n > 0; ++p)
              {
                group.copy_history(p, values.data());
                start.set(
                  law,
                  law.full_stress(group.stress_components(p), values.data()),
                  law.size(values.data()),
                  group.position.of(p),
                  values.data());
                for (unsigned int k = 0; k < n; ++k)
                  group.history[k][p] = values[k];
              }
            group.pad();
          }
        start.check<StepFailure>(comm);
        start.remark(comm, remarks);
      }
    if (stage.removes())
      remarks.push_back(remove_points(stage, t));
    energy_n    = 0.;
    rising      = false;
    stage_start = exchange();
    return remarks;
  }

  std::string
  ExplicitMPM::remove_points(const Stage &stage, const double t)
  {
    if (fade_end > 0.)
      end_removal(); // of an earlier stage, up to rounding
    unsigned long n_removed = 0, n_all = 0;
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        {
          ++n_all;
          n_removed += stage.removes(group.position.of(p));
        }
    n_removed              = Utilities::MPI::sum(n_removed, comm);
    n_all                  = Utilities::MPI::sum(n_all, comm);
    const std::string text = stage.removal_text(n_removed, n_all, "points");

    double                   removed_mass = 0.;
    Tensor<1, dim>           lost;
    const bool               at_once = stage.removal_duration == 0.;
    std::vector<PointArrays> ramped;
    for (PointArrays &group : groups)
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
      {
        for (PointArrays &group : ramped)
          {
            group.pad();
            groups.push_back(group);
          }
        fade_end = t + stage.removal_duration;
      }
    must_refresh = true;
    return text + format(": %.6g %s, momentum (%s) %s",
                         removed_mass,
                         unit("kg/m").c_str(),
                         text_of_vector(lost, "%.3g").c_str(),
                         unit("N s/m").c_str());
  }

  void
  ExplicitMPM::count_removal(const PointArrays &group,
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
  ExplicitMPM::remove_point(PointArrays &group, const unsigned int p)
  {
    count_removal(group, p, 1.);
    group.mass[p]   = 0.;
    group.volume[p] = 0.;
  }

  void
  ExplicitMPM::fade_points(const TransferBlock &points)
  {
    PointArrays &group = groups[points.group];
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
  ExplicitMPM::stop_points()
  {
    for (PointArrays &group : groups)
      {
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            sum.stopped_energy += kinetic_energy(group, p);
            sum.impulse -= momentum(group, p);
          }
        for (unsigned int d = 0; d < dim; ++d)
          std::fill_n(group.velocity[d], group.n_padded(), 0.);
        if (affine)
          for (unsigned int i = 0; i < dim * dim; ++i)
            std::fill_n(group.affine[i], group.n_padded(), 0.);
      }
    if (water.acts())
      water.stop(groups);
    must_refresh = true;
  }

  void
  ExplicitMPM::stop_at_peak()
  {
    double energy = 0.;
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        energy += kinetic_energy(group, p);
    energy = Utilities::MPI::sum(energy, comm);
    if (rising && energy < energy_n)
      {
        stop_points();
        energy = 0.;
      }
    rising   = energy > energy_n;
    energy_n = energy;
  }

  void
  ExplicitMPM::end_removal()
  {
    // Remainders of the points by rounding are removed with them.
    for (PointArrays &group : groups)
      if (group.ramped)
        for (unsigned int p = 0; p < group.n_points(); ++p)
          remove_point(group, p);
    std::vector<PointArrays> staying;
    for (PointArrays &group : groups)
      if (!group.ramped)
        staying.push_back(std::move(group));
    groups.swap(staying);
    fade_end     = 0.;
    must_refresh = true;
  }

  void
  ExplicitMPM::check_equilibrium(const Stage          &stage,
                                 const ExplicitState  &state,
                                 const ExplicitReport &report) const
  {
    const std::string section = "'Loading/" + stage.name + "/";
    const double      weight  = state.mass * gravity.norm();
    // Work of this stage, at least a thousandth of the work of the weight over
    // a cell, since a stage that starts at rest does almost no work.
    const double work =
      std::max(std::abs(exchange().stress_work - stage_start.stress_work),
               1e-3 * weight * transfer->cell_size());
    if (stage.largest_unbalanced_force > 0. &&
        !(report.unbalanced_force <= stage.largest_unbalanced_force * weight))
      throw StepFailure(
        format("the stage '%s' has not ended in equilibrium: the largest "
               "unbalanced force is %.3g of the weight, not %.3g",
               stage.name.c_str(),
               report.unbalanced_force / weight,
               stage.largest_unbalanced_force) +
        "\n  remedy:  give it more time or damping, or check whether the "
        "body can stand; the limit is " +
        section + "Largest unbalanced force'");
    if (stage.largest_kinetic_energy > 0. &&
        !(state.energies.kinetic <= stage.largest_kinetic_energy * work))
      throw StepFailure(
        format("the stage '%s' has not ended in equilibrium: the kinetic "
               "energy is %.3g of the stress work, not %.3g",
               stage.name.c_str(),
               work > 0. ? state.energies.kinetic / work : 0.,
               stage.largest_kinetic_energy) +
        "\n  remedy:  give it more time or damping, or check whether the "
        "body can stand; the limit is " +
        section + "Largest kinetic energy'");
  }
} // namespace geocone::GEOCONE_DIM
