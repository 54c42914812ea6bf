// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What the explicit material point method tells of its points: sums and extremes
// of all ranks.
#include <geocone/time_stepping/explicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    using Field = PointArrays::Field;
  }

  ConstitutiveLaw::Stress
  ExplicitMPM::stress_of(const PointArrays &group, const unsigned int p) const
  {
    // The first history variable of a law that has some is s_zz.
    return {{group[Field::s_xx][p],
             group[Field::s_yy][p],
             group.n_history > 0 ? group[group.first_history()][p] : 0.,
             group[Field::s_xy][p]}};
  }

  double
  ExplicitMPM::kinetic_energy(const PointArrays &group,
                              const unsigned int p) const
  {
    const double vx = group[Field::vx][p], vy = group[Field::vy][p];
    return group[Field::mass][p] * (vx * vx + vy * vy) / 2.;
  }

  double
  ExplicitMPM::current_mass() const
  {
    double mass = 0.;
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        mass += group[Field::mass][p];
    return mass;
  }

  ExplicitState
  ExplicitMPM::state() const
  {
    ExplicitState s;
    // Of the whole gravity, also while it grows.
    const Tensor<1, dim> g         = scene->gravity.at(1e300);
    double               bounds[4] = {1e300, 1e300, 1e300, 1e300};
    double               fastest   = -1.;
    for (const PointArrays &group : groups)
      {
        const ConstitutiveLaw &law = scene->materials.law(group.material);
        std::vector<double>    values(group.n_history);
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            const double     m = group[Field::mass][p];
            const Point<dim> x = group.position(p);
            if (!(m > 0.))
              continue; // it has left
            ++s.n_points;
            Tensor<1, dim> v;
            v[0] = group[Field::vx][p];
            v[1] = group[Field::vy][p];
            s.mass += m;
            s.volume += group[Field::volume][p];
            s.kinetic += m * v.norm_square() / 2.;
            s.potential -= m * (g * (x - datum));
            s.momentum += m * v;
            s.angular_momentum += m * (x[0] * v[1] - x[1] * v[0]);
            for (unsigned int d = 0; d < dim; ++d)
              {
                bounds[d]       = std::min(bounds[d], x[d]);
                bounds[dim + d] = std::min(bounds[dim + d], -x[d]);
              }
            s.largest_speed          = std::max(s.largest_speed, v.norm());
            s.largest_plastic_strain = std::max(
              s.largest_plastic_strain, group[Field::plastic_strain][p]);
            for (unsigned int k = 0; k < group.n_history; ++k)
              values[k] = group[group.first_history() + k][p];
            const double c2 =
              law.wave_modulus(stress_of(group, p), values.data()) *
              group[Field::volume][p] / m;
            if (c2 > fastest)
              {
                fastest          = c2;
                s.limiting_id    = group.id[p];
                s.limiting_place = x;
              }
          }
      }
    s.n_points         = Utilities::MPI::sum(s.n_points, comm);
    s.mass             = Utilities::MPI::sum(s.mass, comm);
    s.volume           = Utilities::MPI::sum(s.volume, comm);
    s.kinetic          = Utilities::MPI::sum(s.kinetic, comm);
    s.potential        = Utilities::MPI::sum(s.potential, comm);
    s.momentum         = Utilities::MPI::sum(s.momentum, comm);
    s.angular_momentum = Utilities::MPI::sum(s.angular_momentum, comm);
    s.largest_speed    = Utilities::MPI::max(s.largest_speed, comm);
    s.largest_plastic_strain =
      Utilities::MPI::max(s.largest_plastic_strain, comm);
    Utilities::MPI::min(bounds, comm, bounds);
    s.lower = {bounds[0], bounds[1]};
    s.upper = {-bounds[2], -bounds[3]};

    const auto where =
      Utilities::MPI::all_gather(comm,
                                 std::array<double, 4>{{fastest,
                                                        double(s.limiting_id),
                                                        s.limiting_place[0],
                                                        s.limiting_place[1]}});
    for (const auto &w : where)
      if (w[0] >= fastest)
        {
          fastest          = w[0];
          s.limiting_id    = static_cast<unsigned int>(w[1]);
          s.limiting_place = {w[2], w[3]};
        }
    s.limiting_wave_speed = std::sqrt(std::max(fastest, 0.));

    s.left_front  = mass_quantile(0.01 * s.mass, s.lower[0], s.upper[0]);
    s.right_front = mass_quantile(0.99 * s.mass, s.lower[0], s.upper[0]);
    return s;
  }

  double
  ExplicitMPM::mass_quantile(const double wanted,
                             double       left,
                             double       right) const
  {
    // The mass in equal parts of the range, and again in the part that matters.
    double before = 0.;
    for (unsigned int round = 0; round < 2 && right > left; ++round)
      {
        std::vector<double> part(1000, 0.);
        const double        per_width = part.size() / (right - left);
        for (const PointArrays &group : groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            {
              const double place = (group[Field::x][p] - left) * per_width;
              if (place >= 0. && place <= part.size())
                part[std::min<std::size_t>(place, part.size() - 1)] +=
                  group[Field::mass][p];
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

  Balance
  ExplicitMPM::balance() const
  {
    Balance all           = sum;
    all.stress_work       = Utilities::MPI::sum(sum.stress_work, comm);
    all.gravity_work      = Utilities::MPI::sum(sum.gravity_work, comm);
    all.damping_work      = Utilities::MPI::sum(sum.damping_work, comm);
    all.support_work      = Utilities::MPI::sum(sum.support_work, comm);
    all.impulse           = Utilities::MPI::sum(sum.impulse, comm);
    all.removed_mass      = Utilities::MPI::sum(sum.removed_mass, comm);
    all.removed_momentum  = Utilities::MPI::sum(sum.removed_momentum, comm);
    all.removed_energy    = Utilities::MPI::sum(sum.removed_energy, comm);
    all.removed_potential = Utilities::MPI::sum(sum.removed_potential, comm);
    all.stopped_energy    = Utilities::MPI::sum(sum.stopped_energy, comm);
    all.small_masses      = Utilities::MPI::sum(sum.small_masses, comm);
    return all;
  }

  LawCounts
  ExplicitMPM::law_counts() const
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
  ExplicitMPM::memory() const
  {
    std::size_t bytes = transfer->memory();
    for (const PointArrays &group : groups)
      bytes += group.memory();
    return bytes;
  }

  void
  ExplicitMPM::state_of_all(StateRow &row)
  {
    row(n_steps,
        fade,
        fade_end,
        last_step,
        gravity,
        sums,
        energy_n,
        rising,
        stage_start,
        progress.begun,
        progress.now,
        progress.report);
  }

  void
  ExplicitMPM::state_of_ranks(StateRow &row)
  {
    row(n_point_steps, sum, *nodes, counts);
  }

  void
  ExplicitMPM::save(Archive &archive)
  {
    StateRow of_all, of_ranks;
    state_of_all(of_all);
    archive.write_row("explicit", of_all);
    state_of_ranks(of_ranks);
    archive.write("explicit sums", of_ranks.values());
    StateRow list;
    for (PointArrays &group : groups)
      {
        unsigned int material = group.material, n_fields = group.n_fields();
        list(material, group.fading, n_fields);
      }
    archive.write_row("groups", list);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const PointArrays  &group = groups[g];
        std::vector<double> values;
        values.reserve(group.n_points() * (group.n_fields() + 1));
        for (unsigned int p = 0; p < group.n_points(); ++p)
          {
            for (unsigned int field = 0; field < group.n_fields(); ++field)
              values.push_back(group[field][p]);
            values.push_back(group.id[p]);
          }
        archive.write("points " + std::to_string(g), values);
      }
    // The run that goes on and one that is resumed start from the same nodes.
    must_refresh = true;
  }

  std::vector<double>
  ExplicitMPM::points_of_rank(const Archive     &archive,
                              const std::string &name,
                              const std::size_t  size) const
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm),
                       n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (archive.n_ranks_of(name) == n_ranks || transfer->takes_any_point())
      return archive.read_part(name, size);
    // Other ranks than before: each point goes to the lowest one that finds it.
    const std::vector<double> all = archive.read(name);
    std::vector<unsigned int> owner(all.size() / size, n_ranks);
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (transfer->owns({all[i * size + Field::x], all[i * size + Field::y]}))
        owner[i] = rank;
    Utilities::MPI::min(owner, comm, owner);
    std::vector<double> own;
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (owner[i] % n_ranks == rank) // nobody's are the first one's
        own.insert(own.end(), &all[i * size], &all[i * size] + size);
    return own;
  }

  void
  ExplicitMPM::load(const Archive &archive)
  {
    StateRow of_all = archive.read_row("explicit");
    state_of_all(of_all);
    // Sums of ranks that are not there any more go to the first one.
    StateRow mine;
    state_of_ranks(mine);
    const std::size_t         size          = mine.values().size();
    const std::vector<double> sums_of_ranks = archive.read("explicit sums");
    const unsigned int        rank = Utilities::MPI::this_mpi_process(comm);
    const unsigned int        n    = sums_of_ranks.size() / size;
    std::vector<double>       own(size, 0.);
    if (n == Utilities::MPI::n_mpi_processes(comm))
      own.assign(&sums_of_ranks[rank * size],
                 &sums_of_ranks[rank * size] + size);
    else if (rank == 0)
      for (unsigned int i = 0; i < n * size; ++i)
        if ((i + 1) % size == 0)
          own[size - 1] = std::max(own[size - 1], sums_of_ranks[i]); // most
        else
          own[i % size] += sums_of_ranks[i];
    else
      own = mine.values();
    StateRow row(own);
    state_of_ranks(row);

    StateRow list = archive.read_row("groups");
    groups.clear();
    while (!list.at_end())
      {
        unsigned int material = 0, n_fields = 0;
        bool         fading = false;
        list(material, fading, n_fields);
        if (material >= scene->materials.size())
          throw RunError("the checkpoint has other materials");
        groups.emplace_back(
          material, scene->materials.law(material).n_history(), affine);
        PointArrays &group = groups.back();
        group.fading       = fading;
        if (group.n_fields() != n_fields)
          throw RunError("the checkpoint has other variables of points");
        const std::vector<double> values = points_of_rank(
          archive, "points " + std::to_string(groups.size() - 1), n_fields + 1);
        group.reserve(values.size() / (n_fields + 1));
        for (std::size_t i = 0; i < values.size(); i += n_fields + 1)
          group.append(&values[i],
                       static_cast<unsigned int>(values[i + n_fields]));
        group.pad();
      }
    must_refresh = true;
  }
} // namespace geocone
