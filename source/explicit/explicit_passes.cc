// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Passes over the points of the explicit material point method, block by block: they
// gather from the nodes, update stresses, move, and scatter to the nodes.
#include <geocone/base/log.h>
#include <geocone/explicit/explicit_points.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  TransferBlock
  ExplicitPoints::block(const unsigned int g, const unsigned int first)
  {
    PointArrays       &group = all_groups[g];
    const unsigned int n =
      std::min(PointBlock::capacity, group.n_padded() - first);
    TransferBlock points = {n,
                            g,
                            first,
                            {},
                            {},
                            {},
                            group.volume.data() + first,
                            group.mass.data() + first,
                            {},
                            transfer->keeps_cells() ? group.cell.data() + first
                                                    : nullptr};
    for (unsigned int d = 0; d < dim; ++d)
      {
        points.x[d] = group.position[d] + first;
        points.v[d] = group.velocity[d] + first;
      }
    for (int i = 0; i < n_mandel; ++i)
      points.s[i] = group.stress[i] + first;
    for (unsigned int i = 0; i < dim * dim && rule.is_affine(); ++i)
      points.c[i] = group.affine[i] + first;
    return points;
  }

  void
  ExplicitPoints::pass(const Update        update,
                       const ScatteredData scattered,
                       const double        dt)
  {
    const bool gives_force =
      scattered == ScatteredData::force || scattered == ScatteredData::all;
    if (gives_force)
      hoop = 0.;
    const PoreWater::Loop loop =
      [this](const std::function<void(const TransferBlock &)> &action) {
        for_each_block(action);
      };
    if (water.acts())
      water.update_points(update, dt, loop, all_groups, scratch);
    // Cell means of the stress need the stress at all points.
    const bool later = b_bar && gives_force;
    if (b_bar && update.strain)
      average_in_cells([&](const TransferBlock &points) {
        transfer->gather(points, scratch);
        kernels->find_divergence(points, scratch);
        if (axisymmetric)
          for (unsigned int k = 0; k < points.n; ++k)
            scratch.divergence[k] += hoop_rate(k, points.x[0][k]);
        return scratch.divergence;
      });
    for_each_block([&](const TransferBlock &points) {
      gather(update, dt, points);
      if (scattered != ScatteredData::nothing && !later)
        scatter(scattered, points);
    });
    for (const PointArrays &group : all_groups)
      if (update.strain)
        point_steps += group.n_points();
    if (later)
      {
        average_in_cells([&](const TransferBlock &points) {
          find_mean_stress(points);
          return scratch.mean_stress;
        });
        for_each_block(
          [&](const TransferBlock &points) { scatter(scattered, points); });
      }
    if (water.acts() && scattered != ScatteredData::nothing)
      water.scatter(scattered != ScatteredData::force,
                    gives_force,
                    scattered == ScatteredData::all ||
                      scattered == ScatteredData::momentum_and_mass,
                    loop,
                    all_groups,
                    scratch);
  }

  void
  ExplicitPoints::gather(const Update         update,
                         const double         dt,
                         const TransferBlock &points)
  {
    if (update.strain || update.velocity || update.position)
      {
        if (update.strain)
          transfer->gather(points, scratch);
        else
          transfer->gather_values(points, scratch);
        if (update.velocity && rule.is_affine())
          transfer->gather_affine(points, scratch);
        if (update.strain && b_bar)
          transfer->average(points, scratch.divergence);
        kernels->update_points(update, dt, rule.flip_part(), points, scratch);
      }
    if (update.strain)
      update_stresses(update, dt, points);
    if (update.position)
      {
        bound_positions(points);
        // The pass that moves points is the last of a step.
        if (all_groups[points.group].ramped)
          fade_points(points);
      }
  }

  void
  ExplicitPoints::update_stresses(const Update         update,
                                  const double         dt,
                                  const TransferBlock &points)
  {
    PointArrays           &group = all_groups[points.group];
    const ConstitutiveLaw &law   = scene->materials.law(group.of_material);
    if (axisymmetric)
      strain_around_axis(update, dt, points);
    if (b_bar)
      kernels->replace_divergence(dt, points, scratch);
    history.resize(group.n_history());
    for (unsigned int k = 0; k < group.n_history(); ++k)
      history[k] = group.history[k] + points.first;
    std::array<const double *, dim * dim> l;
    for (unsigned int i = 0; i < dim * dim; ++i)
      l[i] = scratch.l[i];
    law.advance({std::min(points.n, group.n_points() - points.first),
                 l,
                 points.s,
                 history.data(),
                 group.cumulative_plastic_strain.data() + points.first,
                 scratch.work,
                 scratch.wave_modulus,
                 dt,
                 axisymmetric ? scratch.l_zz : nullptr},
                counts);
    if (water.acts())
      water.stiffen(points, group, scratch.wave_modulus);
    kernels->finish(points, scratch, sums);
  }

  void
  ExplicitPoints::bound_positions(const TransferBlock &points)
  {
    PassSums here;
    kernels->bound(points, here);
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = here.lower[d];
        upper[d] = here.upper[d];
      }
    if (!std::isfinite(here.check) || !transfer->covers(lower) ||
        !transfer->covers(upper))
      {
        correct_positions(points);
        here = PassSums();
        kernels->bound(points, here);
      }
    sums.add(here);
  }

  void
  ExplicitPoints::for_each_block(
    const std::function<void(const TransferBlock &)> &action)
  {
    for (unsigned int g = 0; g < all_groups.size(); ++g)
      for (unsigned int first = 0; first < all_groups[g].n_padded();
           first += PointBlock::capacity)
        action(block(g, first));
  }

  void
  ExplicitPoints::average_in_cells(
    const std::function<const double *(const TransferBlock &)> &values_at)
  {
    transfer->clear_cells();
    for_each_block([&](const TransferBlock &points) {
      transfer->add_to_cells(points, values_at(points));
    });
    transfer->exchange_cells();
  }

  namespace
  {
    /** Mean stress tr s/dim of a point of a block (Pa). */
    double
    mean_stress(const TransferBlock &points, const unsigned int k)
    {
      double mean = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        mean += points.s[index_of_component[d][d]][k] / dim;
      return mean;
    }
  } // namespace

  void
  ExplicitPoints::find_mean_stress(const TransferBlock &points)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      scratch.mean_stress[k] = mean_stress(points, k);
    if (water.acts())
      for (unsigned int k = 0; k < points.n; ++k)
        scratch.mean_stress[k] -=
          water.excess_pressure(all_groups[points.group], points.first + k);
  }

  void
  ExplicitPoints::scatter(const ScatteredData  scattered,
                          const TransferBlock &points)
  {
    const bool force =
      scattered == ScatteredData::force || scattered == ScatteredData::all;
    const bool mass = scattered == ScatteredData::momentum_and_mass ||
                      scattered == ScatteredData::all;
    const bool momentum = scattered != ScatteredData::force;
    if (b_bar && force)
      transfer->average(points, scratch.mean_stress);
    if (axisymmetric && force)
      force_around_axis(points);
    kernels->prepare_scatter(momentum, force, points, scratch);
    if (b_bar && force)
      kernels->replace_mean_stress(points, scratch);
    else if (water.acts() && force)
      water.add_pressure(points, all_groups[points.group], scratch);
    if (force)
      transfer->scatter(points, scratch, mass);
    else
      transfer->scatter_values(points, scratch, mass);
    if (rule.is_affine() && momentum)
      transfer->scatter_affine(points, scratch);
  }

  double
  ExplicitPoints::hoop_rate(const unsigned int k, const double r) const
  {
    return scratch.gathered[BlockScratch::n_gathered * k] /
           std::max(r, least_radius);
  }

  void
  ExplicitPoints::strain_around_axis(const Update         update,
                                     const double         dt,
                                     const TransferBlock &points)
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        double r = points.x[0][k]; // before the step
        if (update.position)
          r -= dt * scratch.gathered[BlockScratch::n_gathered * k];
        const double rate = hoop_rate(k, r);
        scratch.l_zz[k]   = dt * rate;
        if (b_bar) // included in the mean
          scratch.divergence[k] -= rate;
      }
  }

  void
  ExplicitPoints::force_around_axis(const TransferBlock &points)
  {
    const PointArrays     &group = all_groups[points.group];
    const ConstitutiveLaw &law   = scene->materials.law(group.of_material);
    point_history.resize(group.n_history());
    for (unsigned int k = 0; k < points.n; ++k)
      {
        group.copy_history(points.first + k, point_history.data());
        double s_zz = law.stress_zz(group.stress_components(points.first + k),
                                    point_history.data());
        if (b_bar)
          s_zz += scratch.mean_stress[k] - mean_stress(points, k);
        else if (water.acts())
          s_zz -= water.excess_pressure(group, points.first + k);
        scratch.hoop_force[k] =
          -points.volume[k] * s_zz / std::max(points.x[0][k], least_radius);
        hoop += scratch.hoop_force[k];
      }
  }

  std::string
  ExplicitPoints::lost_point_message(const PointArrays &group,
                                     const unsigned int p) const
  {
    return format("point %u has left the background mesh at (%s)\n"
                  "  remedy:  enlarge 'Mesh/Box', hold the side, or set "
                  "'Particles/Outflow' = count",
                  group.id[p],
                  text_of_place(group.position.of(p)).c_str());
  }

  void
  ExplicitPoints::correct_positions(const TransferBlock &points)
  {
    PointArrays       &group = all_groups[points.group];
    const unsigned int end =
      std::min(points.first + points.n, group.n_points());
    const double tolerance = 1e-6 * transfer->cell_size();
    for (unsigned int p = points.first; p < points.first + points.n; ++p)
      {
        const Point<dim> place = group.position.of(p);
        const bool       is_finite =
          std::isfinite(place.square()) &&
          std::isfinite(group.velocity.of(p).norm_square());
        if (is_finite && transfer->covers(place))
          continue;
        Point<dim> nearest;
        if (!is_finite)
          {
            if (error_message.empty() && p < end)
              error_message =
                format("the velocity of point %u is not a number\n"
                       "  remedy:  take a smaller 'Explicit/Courant number' "
                       "or 'Explicit/Time step', splines, or the order MUSL",
                       group.id[p]);
            nearest = transfer->stored_place();
            for (unsigned int d = 0; d < dim; ++d)
              {
                group.velocity[d][p] = 0.;
                group.position[d][p] = nearest[d];
              }
            continue;
          }
        nearest            = transfer->nearest_in_domain(place);
        const bool outside = nearest.distance(place) > tolerance;
        if (!transfer->covers(nearest))
          {
            if (error_message.empty() && p < end)
              error_message =
                format("point %u at (%s) moved through more than a cell "
                       "in one step\n"
                       "  remedy:  take a smaller 'Explicit/Courant number' "
                       "or 'Explicit/Time step'",
                       group.id[p],
                       text_of_place(place).c_str());
            nearest = transfer->stored_place(); // the run terminates anyway
          }
        else if (outside && p < end)
          {
            if (outflow.is_error() && error_message.empty())
              error_message = lost_point_message(group, p);
            remove_point(group, p);
            some_left = true;
          }
        for (unsigned int d = 0; d < dim; ++d)
          group.position[d][p] = nearest[d];
      }
  }
} // namespace geocone::GEOCONE_DIM
