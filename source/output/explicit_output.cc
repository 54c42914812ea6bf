// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/explicit_output.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  ExplicitOutput::prepare(const RunOptions &options,
                          const Scene      &of_run,
                          const PoreWater  &of_points)
  {
    begin(options, of_run);
    water       = of_points.acts() ? &of_points : nullptr;
    point_files = std::make_unique<FieldFiles>("points", fields_format);
    obstacle_files = std::make_unique<FieldFiles>("obstacles", fields_format);
    add_step_columns();
    add_body_columns();
    add_balance_columns();
    add_observed_columns();
    if (water != nullptr)
      add_observed_pressures();
    open_table("statistics.csv");
  }

  void
  ExplicitOutput::add_step_columns()
  {
    add_time_columns();
    add("explicit steps (-)", [](const Record &r) { return r.report.n_steps; });
    add("CPU time of rank 0 (s)", [](const Record &r) { return r.cpu; });
    add("smallest step (s)",
        [](const Record &r) { return r.report.smallest_step; });
    add("largest step (s)",
        [](const Record &r) { return r.report.largest_step; });
    add("limiting point (-)",
        [](const Record &r) { return r.last.limiting_id; });
    for (unsigned int d = 0; d < dim; ++d)
      add(std::string("limiting point ") + coordinate[d] + " (m)",
          [d](const Record &r) { return r.last.limiting_place[d]; });
    add("limiting wave speed (m/s)",
        [](const Record &r) { return r.last.limiting_wave_speed; });
  }

  void
  ExplicitOutput::add_body_columns()
  {
    const auto add_state = [&](const std::string &column,
                               double ExplicitState::*member) {
      add(column, [member](const Record &r) { return r.last.*member; });
    };
    add("points (-)", [](const Record &r) { return r.last.n_points; });
    add_state("mass (kg/m)", &ExplicitState::mass);
    add_state(dim == 2 ? "volume (m^2)" : "volume (m^3)",
              &ExplicitState::volume);
    add("x least (m)", [](const Record &r) { return r.last.lower[0]; });
    add("x largest (m)", [](const Record &r) { return r.last.upper[0]; });
    add("y largest (m)", [](const Record &r) { return r.last.upper[1]; });
    if (dim == 3)
      {
        add("z least (m)", [](const Record &r) { return r.last.lower[2]; });
        add("z largest (m)", [](const Record &r) { return r.last.upper[2]; });
      }
    add_state("x of 1 % of the mass (m)", &ExplicitState::left_front);
    add_state("x of 99 % of the mass (m)", &ExplicitState::right_front);
    add_state("largest speed (m/s)", &ExplicitState::largest_speed);
    add_strain_columns();
    add("unbalanced force (N/m)",
        [](const Record &r) { return r.report.unbalanced_force; });
    add_energy_columns(false);
  }

  void
  ExplicitOutput::add_balance_columns()
  {
    const auto add_exchange = [&](const std::string &column,
                                  double Exchange::*member) {
      add(column, [member](const Record &r) { return r.exchange.*member; });
    };
    add_exchange("stress work (J/m)", &Exchange::stress_work);
    add_exchange("gravity work (J/m)", &Exchange::gravity_work);
    add_exchange("support work (J/m)", &Exchange::support_work);
    add_exchange("damping work (J/m)", &Exchange::damping_work);
    if (has_obstacles())
      add_exchange("contact dissipation (J/m)", &Exchange::contact_dissipation);
    if (water != nullptr)
      add_exchange("seepage work (J/m)", &Exchange::seepage_work);
    add_exchange("stopped energy (J/m)", &Exchange::stopped_energy);
    add_exchange("removed kinetic energy (J/m)", &Exchange::removed_energy);
    add_loss_columns();
    for (unsigned int d = 0; d < dim; ++d)
      add(std::string("momentum ") + coordinate[d] + " (N s/m)",
          [d](const Record &r) { return r.last.momentum[d]; });
    for (unsigned int d = 0; d < dim; ++d)
      add(std::string("momentum residual ") + coordinate[d] + " (N s/m)",
          [this, d](const Record &r) { return momentum_residual(r)[d]; });
    for (unsigned int i = 0; i < n_rotations; ++i)
      add(std::string("angular momentum") +
            (dim == 2 ? "" : " " + axis_of_rotation(i)) + " (N m s/m)",
          [i](const Record &r) { return r.last.angular_momentum[i]; });
    add_exchange("removed mass (kg/m)", &Exchange::removed_mass);
    if (water != nullptr)
      {
        add_exchange(scene->geometry.is_axisymmetric()
                       ? "outflow of water (m^3)"
                       : "outflow of water (m^2)",
                     &Exchange::outflow);
        add("error of the water balance (-)",
            [this](const Record &r) { return water_error(r); });
      }
    const auto supports = scene->supports();
    for (unsigned int i = 0; i < dim * supports.size(); ++i)
      table.add("force " + supports[i / dim] + " " + coordinate[i % dim] +
                  unit(" (N/m)"),
                [i](const Record &r) {
                  return r.last.reactions[i / dim].force[i % dim];
                });
    const auto &obstacles = scene->obstacles.list;
    for (unsigned int i = 0; i < dim * obstacles.size(); ++i)
      add("displacement " + obstacles[i / dim]->name + " " +
            coordinate[i % dim] + " (m)",
          [i](const Record &r) {
            return r.moved_obstacles[i / dim].centre[i % dim];
          });
  }

  void
  ExplicitOutput::state_of_run(StateRow &row)
  {
    SceneOutput::state_of_run(row);
    row(initial, *point_files, *obstacle_files, largest_impulse);
  }

  void
  ExplicitOutput::set_initial(const ExplicitState &state)
  {
    initial = state;
    balance.begin(state.energies);
  }

  void
  ExplicitOutput::update_balance(const ExplicitRecord &record)
  {
    const Exchange &e = record.exchange;
    Works           works;
    works.external = e.support_work;
    // If the weight changes, its work differs from the loss of potential energy: the
    // difference is the work of an external force.
    if (scene->gravity.is_ramped())
      works.external +=
        e.gravity_work - (initial.energies.potential - e.removed_potential -
                          record.last.energies.potential);
    works.dissipation = e.stress_work + e.damping_work + e.contact_dissipation +
                        e.seepage_work + e.stopped_energy;
    balance.set(record.last.energies,
                works,
                e.removed_energy + e.removed_potential,
                e.removed_potential);
  }

  double
  ExplicitOutput::water_error(const ExplicitRecord &record) const
  {
    constexpr double rounding = 1e-12; // of the volume: water at rest
    const Exchange  &e        = record.exchange;
    const double     volume   = record.last.saturated_volume -
                          initial.saturated_volume + e.removed_volume,
                 stored = record.last.stored_water - initial.stored_water +
                          e.removed_stored,
                 size = std::abs(volume) + std::abs(stored);
    return size > rounding * initial.saturated_volume
             ? (e.outflow + volume + stored) / size
             : 0.;
  }

  Tensor<1, dim>
  ExplicitOutput::momentum_residual(const ExplicitRecord &record) const
  {
    return record.last.momentum - initial.momentum +
           record.exchange.removed_momentum - record.exchange.impulse;
  }

  void
  ExplicitOutput::add_step(const ExplicitRecord &record)
  {
    const ExplicitState &s           = record.last;
    const double         work_before = balance.works().external;
    update_balance(record);
    largest_impulse = std::max(
      {largest_impulse,
       record.exchange.impulse.norm(),
       s.mass * scene->gravity.at(1e300).norm() * record.time,
       std::sqrt(2. * s.mass *
                 std::max(s.energies.kinetic, initial.energies.kinetic))});
    add_record(record);

    // The initial turnover is almost zero; its lower limit is a hundred-thousandth of
    // the work of the weight over the size of the body. Velocities are known half a
    // step before stresses, so that growing energies are off by their change in a step:
    // twice its mean is tolerated.
    const double turned_by_weight = 1e-5 * initial.mass *
                                    scene->gravity.at(record.time).norm() *
                                    initial.lower.distance(initial.upper);
    const double of_a_step = std::abs(balance.works().external - work_before) /
                             std::max(1u, record.report.n_steps);
    balance.warn_if_created(
      log,
      record.time,
      unit("J/m"),
      std::max(turned_by_weight, 2. * of_a_step / EnergyBalance::tolerance),
      "take a smaller 'Explicit/Courant number', splines, or the order MUSL");
  }

  namespace
  {
    /** Adds the columns of the pore water. @param add adds a column, a function of the
     *  group, the point and a component */
    template <typename Add>
    void
    add_pore_water(const Add &add, const PoreWater *const water)
    {
      using Group = PointArrays;
      using Index = unsigned int;
      add("pore_pressure", [water](const Group &g, const Index p, Index) {
        return water->pressure(g, p);
      });
      add("excess_pore_pressure",
          [water](const Group &g, const Index p, Index) {
            return water->excess_pressure(g, p);
          });
      add(
        "water_velocity",
        [water](const Group &g, const Index p, const Index d) {
          return water->velocity(g, p)[d];
        },
        dim);
    }
  } // namespace

  void
  ExplicitOutput::write_points(const double                    time,
                               const std::vector<PointArrays> &groups)
  {
    if (!with_fields)
      return;
    FieldTable table;
    for (const PointArrays &group : groups)
      table.n_nodes += group.n_points();
    // Generates a column from a function of the group, the point and a component.
    const auto filled = [&](const unsigned int n_components,
                            const auto        &value) {
      return [&, n_components, value](std::vector<double> &to) {
        double *next = to.data();
        for (const PointArrays &group : groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            for (unsigned int d = 0; d < n_components; ++d)
              *next++ = value(group, p, d);
      };
    };
    const auto add = [&](const std::string &name,
                         const auto        &value,
                         const unsigned int n_components = 1) {
      table.columns.push_back(
        {name, n_components, filled(n_components, value)});
    };
    using Group = PointArrays;
    using Index = unsigned int;
    table.positions =
      filled(dim, [](const Group &g, const Index p, const Index d) {
        return g.position[d][p];
      });
    add(
      "velocity",
      [](const Group &g, const Index p, const Index d) {
        return g.velocity[d][p];
      },
      dim);
    add(
      "displacement",
      [](const Group &g, const Index p, const Index d) {
        return g.position[d][p] - g.start[d][p];
      },
      dim);
    add("material", [](const Group &g, Index, Index) { return g.of_material; });
    add("volume",
        [](const Group &g, const Index p, Index) { return g.volume[p]; });
    if (scene->geometry.is_axisymmetric()) // section of a point in the plane
      add("area", [this](const Group &g, const Index p, Index) {
        return g.volume[p] /
               Geometry::measure(scene->geometry.symmetry, g.position.of(p));
      });
    for (int i = 0; i < n_mandel; ++i)
      add(std::string("stress_") + tensor_component[i],
          [i](const Group &g, const Index p, Index) { return g.stress[i][p]; });
    add("cumulative_plastic_strain", [](const Group &g, const Index p, Index) {
      return g.cumulative_plastic_strain[p];
    });

    if (water != nullptr)
      add_pore_water(add, water);
    // Output quantities of all laws; not a number where a law has none.
    for (const std::string &name : scene->materials.shown_names())
      table.columns.push_back({name, 1, [&, name](std::vector<double> &to) {
                                 double *next = to.data();
                                 for (const PointArrays &group : groups)
                                   {
                                     show(name, group, next);
                                     next += group.n_points();
                                   }
                               }});
    point_files->write(table, path, time, comm);
  }

  void
  ExplicitOutput::write_obstacles(const double                    time,
                                  const std::vector<RigidMotion> &moved)
  {
    if (!with_fields || !has_obstacles())
      return;
    BoundingBox<dim> box = scene->geometry.bounding_box();
    if (!records.empty())
      box.merge_with(BoundingBox<dim>(
        {records.back().last.lower, records.back().last.upper}));
    for (unsigned int o = 0; o < moved.size(); ++o)
      if (const Obstacle &obstacle = *scene->obstacles.list[o];
          std::isfinite(obstacle.width()))
        {
          const Point<dim> centre = obstacle.centre() + moved[o].centre;
          box.merge_with(BoundingBox<dim>({centre, centre}));
        }
    obstacle_files->write(
      table_of_obstacles(scene->obstacles, moved, box, comm), path, time, comm);
  }

  void
  ExplicitOutput::show(const std::string &name,
                       const PointArrays &group,
                       double            *values) const
  {
    ShownValue          shown(scene->materials.law(group.of_material), name);
    std::vector<double> history(group.n_history());
    for (unsigned int p = 0; p < group.n_points(); ++p)
      {
        group.copy_history(p, history.data());
        values[p] = shown(group.stress_components(p), history.data());
      }
  }

  Json
  ExplicitOutput::results(const LawCounts &counts) const
  {
    Json json = Json::object();
    if (records.empty())
      return json;
    const ExplicitState &last = records.back().last;
    add_pressures(json);
    add_points(json);
    json["explicit"] = steps();
    json["state"]    = body();
    json["motion"]   = {{"front_x_m", last.upper[0]},
                        {"front_y_m", last.upper[1]}};
    json["energy"]   = energy();
    if (water != nullptr)
      json["water"] = {
        {scene->geometry.is_axisymmetric() ? "outflow_m3" : "outflow_m2",
         records.back().exchange.outflow},
        {"balance_error", water_error(records.back())}};
    json["momentum"] = momentum();
    if (has_obstacles())
      json["obstacles"] = obstacles();
    json["law"]      = {
           {"updates", counts.updates},
           {"substeps", counts.substeps},
           {"substeps_per_update",
       counts.updates > 0 ? double(counts.substeps) / counts.updates : 0.},
           {"most_substeps", counts.most},
           {"forced_substeps", counts.forced},
           {"limited_stresses", counts.limited}};
    return json;
  }

  Json
  ExplicitOutput::steps() const
  {
    unsigned long n     = 0;
    double        least = 1e300, largest = 0.;
    for (const ExplicitRecord &record : records)
      {
        n += record.report.n_steps;
        least   = std::min(least, record.report.smallest_step);
        largest = std::max(largest, record.report.largest_step);
      }
    return {{"time_s", records.back().time},
            {"steps", n},
            {"smallest_step_s", least},
            {"largest_step_s", largest},
            {"massless_nodes", records.back().exchange.small_masses}};
  }

  Json
  ExplicitOutput::body() const
  {
    const ExplicitState &s    = records.back().last;
    Json                 json = {
                      {"points", s.n_points},
                      {unit("mass_kg_per_m"), s.mass},
                      {dim == 2 ? "volume_m2" : "volume_m3", s.volume},
                      {"x_least_m", s.lower[0]},
                      {"x_largest_m", s.upper[0]},
                      {"y_largest_m", s.upper[1]},
                      {"left_front_m", s.left_front},
                      {"right_front_m", s.right_front},
                      {"largest_speed_m_per_s", s.largest_speed},
                      {"largest_plastic_strain", s.largest_plastic_strain},
                      {unit("removed_mass_kg_per_m"), records.back().exchange.removed_mass}};
    if (dim == 3)
      {
        json["z_least_m"]   = s.lower[2];
        json["z_largest_m"] = s.upper[2];
      }
    return json;
  }

  Json
  ExplicitOutput::energy() const
  {
    const Exchange &e                  = records.back().exchange;
    Json            json               = SceneOutput::energy(false);
    json[unit("stress_work_J_per_m")]  = e.stress_work;
    json[unit("gravity_work_J_per_m")] = e.gravity_work;
    json[unit("support_work_J_per_m")] = e.support_work;
    json[unit("damping_work_J_per_m")] = e.damping_work;
    if (has_obstacles())
      json[unit("contact_dissipation_J_per_m")] = e.contact_dissipation;
    if (water != nullptr)
      json[unit("seepage_work_J_per_m")] = e.seepage_work;
    return json;
  }

  Json
  ExplicitOutput::obstacles() const
  {
    Json               json  = Json::object();
    const auto        &list  = scene->obstacles.list;
    const unsigned int first = scene->dirichlet.list.size();
    for (unsigned int o = 0; o < list.size(); ++o)
      {
        const auto force_of = [&](const ExplicitRecord &record) {
          return record.last.reactions[first + o].force;
        };
        double largest = 0.;
        for (const ExplicitRecord &record : records)
          largest = std::max(largest, force_of(record).norm());
        Json &own = json[list[o]->name];
        for (unsigned int d = 0; d < dim; ++d)
          {
            own[std::string("force_") + coordinate[d] + unit("_N_per_m")] =
              force_of(records.back())[d];
            own[std::string("displacement_") + coordinate[d] + "_m"] =
              records.back().moved_obstacles[o].centre[d];
          }
        own[unit("largest_force_N_per_m")] = largest;
      }
    return json;
  }

  Json
  ExplicitOutput::momentum() const
  {
    const ExplicitState &s       = records.back().last;
    double               largest = 0.;
    for (const ExplicitRecord &record : records)
      largest = std::max(largest, momentum_residual(record).norm());
    // Angular momentum scale of a rotating body of this size and energy.
    const double turning =
      std::sqrt(2. * initial.mass * initial.energies.kinetic) *
      (initial.lower.norm() + initial.upper.norm());
    const double angular = initial.angular_momentum.norm();
    Json         json    = {
                 {"angular_change_relative",
       angular > 1e-9 * turning ? Json(s.angular_momentum.norm() / angular - 1.)
                                           : Json()},
                 {"residual_max_relative", largest / std::max(largest_impulse, 1e-300)}};
    for (unsigned int d = 0; d < dim; ++d)
      json[coordinate[d] + unit("_N_s_per_m")] = s.momentum[d];
    for (unsigned int i = 0; i < n_rotations; ++i)
      json["angular_" + (dim == 2 ? "" : axis_of_rotation(i) + "_") +
           unit("N_m_s_per_m")] = s.angular_momentum[i];
    return json;
  }

  void
  ExplicitOutput::print_result() const
  {
    if (!writes)
      return;
    const ExplicitRecord &last = records.back();
    const ExplicitState  &s    = last.last;
    warn_of_untouched();
    log.print(
      format("%lu explicit steps of %.3g to %.3g s; the body reaches from x = "
             "%.4g to %.4g m, up to y = %.4g m",
             summary["explicit"]["steps"].get<unsigned long>(),
             summary["explicit"]["smallest_step_s"].get<double>(),
             summary["explicit"]["largest_step_s"].get<double>(),
             s.lower[0],
             s.upper[0],
             s.upper[1]));
    log.print(format(
      "kinetic energy %.4g %s (at most %.4g), stress work %.4g, released "
      "%.4g, numerical loss %.2g %s; momentum to %.1e",
      s.energies.kinetic,
      unit("J/m").c_str(),
      balance.largest_kinetic(),
      last.exchange.stress_work,
      balance.released(),
      balance.loss(),
      unit("J/m").c_str(),
      summary["momentum"]["residual_max_relative"].get<double>()));
    if (summary["law"]["substeps"].get<unsigned long long>() > 0)
      log.print(
        format("soil model: %.3f substeps per update (at most %u), "
               "%llu forced, %llu stresses limited",
               summary["law"]["substeps_per_update"].get<double>(),
               summary["law"]["most_substeps"].get<unsigned int>(),
               summary["law"]["forced_substeps"].get<unsigned long long>(),
               summary["law"]["limited_stresses"].get<unsigned long long>()));
    const Json &cost = summary["cost"];
    log.print(format("%.1f s in all; %.1f ns per point and step (CPU, all "
                     "ranks), %.0f bytes per point",
                     cost["total_s"].get<double>(),
                     cost["cpu_ns_per_point_step"].get<double>(),
                     cost["bytes_per_point"].get<double>()));
  }

  void
  ExplicitOutput::report_results(std::ostream &out) const
  {
    out << "time  kinetic  stress work  gravity work  x  y  plastic\n";
    for (const ExplicitRecord &record : records)
      out << format("%.6g %.7g %.7g %.7g %.7g %.7g %.7g %.7g\n",
                    record.time,
                    record.last.energies.kinetic,
                    record.exchange.stress_work,
                    record.exchange.gravity_work,
                    record.last.lower[0],
                    record.last.upper[0],
                    record.last.upper[1],
                    record.last.largest_plastic_strain);
    out << "explicit steps " << summary["explicit"]["steps"] << " points "
        << records.back().last.n_points << "\n";
  }
} // namespace geocone::GEOCONE_DIM
