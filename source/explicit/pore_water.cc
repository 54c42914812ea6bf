// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/explicit/pore_water.h>
#include <geocone/materials/retention.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Places of the values of PoreWater::shares at a node. */
    enum Share : unsigned int
    {
      drag,
      displaced_by_mixture,
      displaced_by_water
    };
  } // namespace

  class PoreWater::Exchanged
  {
  public:
    Exchanged(GridTransfer &transfer, Nodes &nodes)
      : transfer(transfer)
      , nodes(nodes)
    {
      exchange();
    }
    ~Exchanged()
    {
      exchange();
    }
    Exchanged(const Exchanged &) = delete;

  private:
    void
    exchange()
    {
      transfer.read.swap(nodes.read);
      transfer.write.swap(nodes.write);
      transfer.mass.swap(nodes.mass);
    }

    GridTransfer &transfer;
    Nodes        &nodes;
  };

  void
  PoreWater::prepare(const Scene            &of_run,
                     const ParticleTransfer &rule,
                     const bool              averages)
  {
    if (!acts())
      return;
    check(of_run, rule);
    scene        = &of_run;
    b_bar        = averages;
    flip_part    = rule.flip_part();
    axisymmetric = scene->geometry.is_axisymmetric();
    kernels      = &transfer_kernels();
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      soils.push_back(soil(*scene, m));
    for (const auto &condition : scene->dirichlet.list)
      {
        const std::vector<std::string> &sides = condition->sides;
        const unsigned int              n     = std::count_if(
          sides.begin(), sides.end(), [&](const std::string &name) {
            return std::count(
                     drainage.sides.begin(), drainage.sides.end(), name) > 0;
          });
        if ((n > 0 && n < sides.size()) ||
            (!drainage.sides.empty() && condition->is_on_side("all")))
          throw InputError(condition->parameter("Sides"),
                           Patterns::Tools::to_string(sides),
                           std::string("either all or none of them in '") +
                             Drainage::parameter_of_sides +
                             "', with explicit MPM",
                           "prescribe the velocity of drained and of "
                           "impervious sides by two conditions");
        is_drained.push_back(n > 0);
      }
  }

  void
  PoreWater::check(const Scene &of_run, const ParticleTransfer &rule) const
  {
    const std::string what =
      std::string(Drainage::parameter) + " and explicit MPM";
    if (dim == 3)
      throw InputError(Drainage::parameter,
                       "true",
                       "false in three dimensions",
                       "compute a plane or axisymmetric scene");
    if (rule.is_affine())
      throw InputError(ParticleTransfer::parameter,
                       rule.name(),
                       "FLIP | PIC with " + what,
                       "take FLIP: the water of a point has no affine "
                       "velocity");
    of_run.absorbing.refuse(what, "move the sides farther away");
    of_run.water.seepage.refuse(what, "give a level 'Water/Table'");
    if (!of_run.water.is_level())
      of_run.water.refuse(what + " where it is not level",
                          "give a level 'Water/Table'");
    if (of_run.water.acts() && of_run.gravity.is_ramped())
      throw InputError("Gravity/Ramp duration",
                       ParameterFile::value("Gravity/Ramp duration"),
                       "0 with a water table, " + what,
                       "give the initial stress, and damp the first stage");
  }

  PoreWater::Soil
  PoreWater::soil(const Scene &of_run, const unsigned int material)
  {
    const ConstitutiveLaw &law = of_run.materials.law(material);
    const std::string      section =
      "Materials/" + of_run.materials.name(material) + "/";
    const std::string with = std::string("with ") + Drainage::parameter;
    const double      g    = of_run.gravity.at(1e300).norm(),
                 gamma     = of_run.water.weight(),
                 rho_w     = gamma / (g > 0. ? g : 9.81);
    const bool has_table   = of_run.water.acts();
    const auto k           = law.permeability();
    require(law.fluid_modulus() > 0.,
            section + "Pore fluid bulk modulus",
            law.fluid_modulus(),
            "> 0 Pa " + with,
            "water has 2.2 GPa; divide it by the porosity");
    if (k[0][0] != k[1][1] || k[0][1] != 0.)
      throw InputError(section + "Permeability",
                       ParameterFile::value(section + "Permeability"),
                       "one value for all directions with explicit MPM",
                       "give one value, or set Discretisation/Method = FEM");
    Soil all;
    all.modulus  = law.fluid_modulus();
    all.porosity = law.retention().saturated_content();
    require(all.porosity > 0. && all.porosity < 1.,
            section + "Saturated water content",
            all.porosity,
            "> 0, < 1 " + with + " and explicit MPM",
            "it is the porosity, e.g. 0.4");
    all.density = has_table ? law.saturated_density() : law.density();
    all.water   = all.porosity * rho_w / all.density;
    require(all.water < 1.,
            section + "Density",
            all.density,
            format("more than the water in the pores, %g kg/m^3",
                   all.porosity * rho_w),
            "it is the density of the saturated soil");
    all.drag = all.porosity * all.porosity * gamma / (k[0][0] * all.density);
    all.displaced = has_table ? rho_w / all.density : 0.;
    return all;
  }

  void
  PoreWater::use(GridTransfer &of_points, const std::vector<std::string> &names)
  {
    if (!acts())
      return;
    transfer     = &of_points;
    least_radius = 1e-6 * transfer->cell_size();
    for (const std::string &side : drainage.sides)
      if (std::count(names.begin(), names.end(), side) == 0)
        throw InputError(Drainage::parameter_of_sides,
                         side,
                         Patterns::Tools::to_string(names) +
                           ": sides of the background mesh",
                         "leave it out where no water leaves");
  }

  void
  PoreWater::initialise(const Point<dim>     &place,
                        const Tensor<1, dim> &velocity,
                        double               *variables) const
  {
    const double u = scene->water.pressure(place);
    variables[0]   = u;
    for (unsigned int d = 0; d < dim; ++d)
      variables[1 + d] = velocity[d];
    variables[1 + dim] = !scene->water.acts() || u > 0.;
  }

  double
  PoreWater::wave_modulus(const unsigned int material,
                          const double       skeleton) const
  {
    // Largest eigenvalue of the stiffness of both phases, with their masses.
    const Soil  &s = soils[material];
    const double n = s.porosity, Q = s.modulus, solid = 1. - s.water,
                 a = (skeleton + (1. - n) * (1. - n) * Q) / solid,
                 b = n * n * Q / s.water,
                 c = n * (1. - n) * Q / std::sqrt(solid * s.water);
    return (a + b) / 2. + std::hypot((a - b) / 2., c);
  }

  double
  PoreWater::excess_pressure(const PointArrays &group,
                             const unsigned int p) const
  {
    return is_saturated(group, p)
             ? pressure(group, p) - scene->water.pressure(group.position.of(p))
             : 0.;
  }

  Tensor<1, dim>
  PoreWater::velocity(const PointArrays &group, const unsigned int p) const
  {
    Tensor<1, dim> w = group.velocity.of(p);
    if (is_saturated(group, p))
      for (unsigned int d = 0; d < dim; ++d)
        w[d] = group.history[first(group) + 1 + d][p];
    return w;
  }

  Tensor<1, dim>
  PoreWater::relative_momentum(const PointArrays &group,
                               const unsigned int p) const
  {
    return soils[group.of_material].water * group.mass[p] *
           (velocity(group, p) - group.velocity.of(p));
  }

  double
  PoreWater::relative_energy(const PointArrays &group,
                             const unsigned int p) const
  {
    return (velocity(group, p) + group.velocity.of(p)) *
           relative_momentum(group, p) / 2.;
  }

  void
  PoreWater::stiffen(const TransferBlock &points,
                     const PointArrays   &group,
                     double              *moduli) const
  {
    for (unsigned int k = 0; k < points.n; ++k)
      if (is_saturated(group, points.first + k))
        moduli[k] = wave_modulus(group.of_material, moduli[k]);
  }

  void
  PoreWater::stop(std::vector<PointArrays> &groups) const
  {
    for (PointArrays &group : groups)
      for (unsigned int d = 0; d < dim; ++d)
        std::fill_n(group.history[first(group) + 1 + d], group.n_padded(), 0.);
  }

  void
  PoreWater::find_divergence(const TransferBlock &points,
                             BlockScratch        &scratch) const
  {
    kernels->find_divergence(points, scratch);
    for (unsigned int k = 0; k < points.n && axisymmetric; ++k)
      scratch.divergence[k] += scratch.gathered[BlockScratch::n_gathered * k] /
                               std::max(points.x[0][k], least_radius);
  }

  void
  PoreWater::find_rates(const double         dt,
                        const TransferBlock &points,
                        const PointArrays   &group,
                        BlockScratch        &scratch)
  {
    const double n = soils[group.of_material].porosity;
    transfer->gather(points, scratch);
    find_divergence(points, scratch);
    double of_soil[BlockScratch::size];
    std::copy_n(scratch.divergence, points.n, of_soil);
    {
      const Exchanged nodes(*transfer, water);
      transfer->gather(points, scratch);
    }
    find_divergence(points, scratch);
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const double relative = is_saturated(group, points.first + k)
                                  ? n * (scratch.divergence[k] - of_soil[k])
                                  : 0.;
        totals.outflow += dt * points.volume[k] * relative;
        scratch.divergence[k] = of_soil[k] + relative;
      }
  }

  void
  PoreWater::update_pressures(const double         dt,
                              const TransferBlock &points,
                              PointArrays         &group,
                              const double        *rates)
  {
    const double  K = soils[group.of_material].modulus;
    double *const u = group.history[first(group)];
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const unsigned int p = points.first + k;
        if (!is_saturated(group, p))
          continue;
        const double before = excess_pressure(group, p), strain = dt * rates[k];
        u[p] -= K * strain;
        totals.pressure_work -=
          points.volume[k] * (before - K * strain / 2.) * strain;
      }
  }

  void
  PoreWater::update_points(const Update              update,
                           const double              dt,
                           const Loop               &for_each_block,
                           std::vector<PointArrays> &groups,
                           BlockScratch             &scratch)
  {
    if (update.strain && b_bar)
      {
        transfer->clear_cells();
        for_each_block([&](const TransferBlock &points) {
          find_rates(dt, points, groups[points.group], scratch);
          transfer->add_to_cells(points, scratch.divergence);
        });
        transfer->exchange_cells();
      }
    if (update.strain)
      for_each_block([&](const TransferBlock &points) {
        PointArrays &group = groups[points.group];
        if (b_bar)
          transfer->average(points, scratch.divergence);
        else
          find_rates(dt, points, group, scratch);
        update_pressures(dt, points, group, scratch.divergence);
      });
    if (!update.velocity)
      return;
    const Exchanged nodes(*transfer, water);
    for_each_block([&](const TransferBlock &points) {
      PointArrays  &group    = groups[points.group];
      TransferBlock of_water = points;
      for (unsigned int d = 0; d < dim; ++d)
        of_water.v[d] = group.history[first(group) + 1 + d] + points.first;
      transfer->gather_values(points, scratch);
      kernels->update_points(
        {false, true, false}, dt, flip_part, of_water, scratch);
    });
  }

  void
  PoreWater::add_pressure(const TransferBlock &points,
                          const PointArrays   &group,
                          BlockScratch        &scratch) const
  {
    constexpr unsigned int forces = change_of_node % 4;
    for (unsigned int k = 0; k < points.n; ++k)
      {
        double *const out = scratch.scattered + BlockScratch::n_scattered * k;
        const double  f =
          points.volume[k] * excess_pressure(group, points.first + k);
        for (unsigned int d = 0; d < dim; ++d)
          out[4 + 4 * d + forces + d] += f;
      }
  }

  void
  PoreWater::average_pressures(const Loop               &for_each_block,
                               std::vector<PointArrays> &groups)
  {
    double p[BlockScratch::size], volume[BlockScratch::size];
    transfer->clear_cells();
    for_each_block([&](const TransferBlock &points) {
      const PointArrays &group     = groups[points.group];
      TransferBlock      saturated = points;
      saturated.volume             = volume;
      for (unsigned int k = 0; k < points.n; ++k)
        {
          p[k] = excess_pressure(group, points.first + k);
          volume[k] = is_saturated(group, points.first + k)
                        ? points.volume[k] / soils[group.of_material].modulus
                        : 0.;
        }
      transfer->add_to_cells(saturated, p);
    });
    transfer->exchange_cells();
    for_each_block([&](const TransferBlock &points) {
      PointArrays &group = groups[points.group];
      transfer->average(points, p);
      for (unsigned int k = 0; k < points.n; ++k)
        if (const unsigned int i = points.first + k; is_saturated(group, i))
          group.history[first(group)][i] =
            p[k] + scene->water.pressure(group.position.of(i));
    });
  }

  void
  PoreWater::scatter(const bool                momentum,
                     const bool                force,
                     const bool                mass,
                     const Loop               &for_each_block,
                     std::vector<PointArrays> &groups,
                     BlockScratch             &scratch)
  {
    if (b_bar && force)
      average_pressures(for_each_block, groups);
    for_each_block([&](const TransferBlock &points) {
      PointArrays  &group = groups[points.group];
      const Soil   &soil  = soils[group.of_material];
      TransferBlock block = points;
      double        masses[BlockScratch::size], stress[BlockScratch::size],
        zero[BlockScratch::size] = {};
      for (unsigned int k = 0; k < points.n; ++k)
        {
          masses[k] = is_saturated(group, points.first + k)
                        ? soil.water * points.mass[k]
                        : 0.;
          stress[k] =
            force ? -soil.porosity * excess_pressure(group, points.first + k)
                  : 0.;
          if (axisymmetric)
            scratch.hoop_force[k] = -points.volume[k] * stress[k] /
                                    std::max(points.x[0][k], least_radius);
        }
      block.mass = masses;
      for (unsigned int d = 0; d < dim; ++d)
        block.v[d] = group.history[first(group) + 1 + d] + points.first;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          block.s[index_of_component[c][d]] = c == d ? stress : zero;
      kernels->prepare_scatter(momentum, force, block, scratch);
      {
        const Exchanged nodes(*transfer, water);
        if (force)
          transfer->scatter(block, scratch, mass);
        else
          transfer->scatter_values(block, scratch, mass);
      }
      if (!mass)
        return;
      for (unsigned int k = 0; k < points.n; ++k)
        {
          double *const out = scratch.scattered + BlockScratch::n_scattered * k;
          const bool    is_below =
            soil.displaced > 0. && masses[k] > 0. &&
            scene->water.pressure(group.position.of(points.first + k)) > 0.;
          std::fill_n(out, 4, 0.);
          out[drag] = masses[k] > 0. ? soil.drag * points.mass[k] : 0.;
          out[displaced_by_mixture] =
            is_below ? soil.displaced * points.mass[k] : 0.;
          out[displaced_by_water] = soil.porosity * out[displaced_by_mixture];
        }
      const Exchanged nodes(*transfer, shares);
      transfer->scatter_values(points, scratch, false);
    });
  }

  void
  PoreWater::reset_nodes()
  {
    for (Nodes *nodes : {&water, &shares})
      {
        for (auto *values : {&nodes->read, &nodes->write})
          {
            values->resize_fast(transfer->read.size());
            values->fill(0.);
          }
        nodes->mass.resize_fast(transfer->mass.size());
        nodes->mass.fill(0.);
      }
  }

  void
  PoreWater::exchange(const bool with_mass)
  {
    {
      const Exchanged nodes(*transfer, water);
      transfer->exchange(with_mass);
    }
    if (!with_mass)
      return;
    const Exchanged nodes(*transfer, shares);
    transfer->exchange(false);
  }

  void
  PoreWater::add_buoyancy(const double dt, const Tensor<1, dim> &gravity)
  {
    for (unsigned int i = 0; i < transfer->n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        transfer->write[node_size * i + change_of_node + d] -=
          shares.write[node_size * i + displaced_by_mixture] * gravity[d];
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        totals.impulse -=
          dt * shares.write[node_size * i + displaced_by_mixture] * gravity;
  }

  double
  PoreWater::relative_velocity(const unsigned int i, const unsigned int d) const
  {
    return water.write[node_size * i + d] / water.mass[i] -
           transfer->read[node_size * i + d];
  }

  void
  PoreWater::advance(const unsigned int i,
                     const unsigned int d,
                     const double       dt,
                     const double       after)
  {
    const double change           = after - relative_velocity(i, d);
    water.read[node_size * i + d] = after;
    water.read[node_size * i + change_of_node + d] = change;
    transfer->write[node_size * i + change_of_node + d] -=
      water.mass[i] * change / dt;
  }

  void
  PoreWater::advance_relative(const double                      dt,
                              const Tensor<1, dim>             &gravity,
                              const double                      least_mass,
                              const std::vector<unsigned char> &is_prescribed)
  {
    water.read.fill(0.);
    for (unsigned int i = 0; i < transfer->n_nodes(); ++i)
      {
        const double m = transfer->mass[i], m_w = water.mass[i];
        if (!(m > least_mass) || !(m_w > least_mass))
          continue;
        const double part = m_w / m, reduced = m_w * (1. - part),
                     c = shares.write[node_size * i + drag],
                     sinking =
                       m_w - shares.write[node_size * i + displaced_by_water];
        for (unsigned int d = 0; d < dim; ++d)
          if (!is_prescribed[dim * i + d])
            {
              const unsigned int place = node_size * i + change_of_node + d;
              const double       f = water.write[place] + sinking * gravity[d] -
                               part * transfer->write[place];
              advance(i,
                      d,
                      dt,
                      (relative_velocity(i, d) + dt * f / reduced) /
                        (1. + dt * c / reduced));
            }
      }
  }

  void
  PoreWater::advance_relative_at(const PrescribedNode &node,
                                 const double          dt,
                                 const Tensor<1, dim> &gravity,
                                 const double          change)
  {
    const unsigned int i = node.node, d = node.component;
    const double       m_w = water.mass[i];
    if (!(m_w > 0.))
      return;
    double after = 0.;
    if (is_drained[node.condition])
      {
        const double f =
          water.write[node_size * i + change_of_node + d] +
          (m_w - shares.write[node_size * i + displaced_by_water]) * gravity[d];
        after = (relative_velocity(i, d) + dt * f / m_w - change) /
                (1. + dt * shares.write[node_size * i + drag] / m_w);
      }
    advance(i, d, dt, after);
  }

  void
  PoreWater::add_velocity_of_soil(const double dt)
  {
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          totals.loss += dt * shares.write[node_size * i + drag] *
                         std::pow(water.read[node_size * i + d], 2);
    for (unsigned int i = 0; i < water.read.size(); ++i)
      water.read[i] += transfer->read[i];
  }

  void
  PoreWater::divide_momentum(const double least_mass)
  {
    for (unsigned int i = 0; i < transfer->n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int place           = node_size * i + d;
          water.read[place]                  = water.mass[i] > least_mass
                                                 ? water.write[place] / water.mass[i]
                                                 : transfer->read[place];
          water.read[place + change_of_node] = 0.;
        }
    for (const PrescribedNode &node : transfer->prescribed)
      if (!is_drained[node.condition])
        {
          const unsigned int place = node_size * node.node + node.component;
          water.read[place]        = transfer->read[place];
        }
  }

  void
  PoreWater::count_work(const double dt, const Tensor<1, dim> &gravity)
  {
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        {
          const double *share = &shares.write[node_size * i];
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double v = transfer->read[node_size * i + d];
              totals.work += dt * gravity[d] *
                             ((water.mass[i] - share[displaced_by_water]) *
                                (water.read[node_size * i + d] - v) -
                              share[displaced_by_mixture] * v);
            }
        }
  }

  void
  PoreWater::clear(const bool keep_mass)
  {
    water.write.fill(0.);
    if (keep_mass)
      return;
    water.mass.fill(0.);
    shares.write.fill(0.);
  }

  PoreWater::Totals
  PoreWater::take_totals()
  {
    return std::exchange(totals, Totals());
  }

  std::size_t
  PoreWater::memory() const
  {
    std::size_t bytes = 0;
    for (const Nodes *nodes : {&water, &shares})
      bytes += nodes->read.memory_consumption() +
               nodes->write.memory_consumption() +
               nodes->mass.memory_consumption();
    return bytes;
  }
} // namespace geocone::GEOCONE_DIM
