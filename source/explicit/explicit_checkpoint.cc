// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// State of the explicit material point method in a checkpoint.
#include <geocone/base/exceptions.h>
#include <geocone/explicit/explicit_mpm.h>
#include <geocone/points/point_record.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  ExplicitPoints::save(Archive &archive)
  {
    StateRow list;
    for (PointArrays &group : all_groups)
      {
        unsigned int material  = group.of_material;
        std::string  variables = group.variables();
        list(material, group.ramped, variables);
      }
    archive.write_row("groups", list);
    for (unsigned int g = 0; g < all_groups.size(); ++g)
      {
        const PointArrays  &group = all_groups[g];
        std::vector<double> rows;
        rows.reserve(group.n_points() * group.n_numbers());
        for (unsigned int p = 0; p < group.n_points(); ++p)
          group.add_row(p, rows);
        archive.write("points " + std::to_string(g), rows);
      }
  }

  std::vector<double>
  ExplicitPoints::points_of_rank(const Archive     &archive,
                                 const std::string &name,
                                 const std::size_t  size) const
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm),
                       n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (archive.n_ranks_of(name) == n_ranks || transfer->takes_any_point())
      return archive.read_part(name, size);
    // With another number of ranks, each point goes to the lowest one that
    // finds it.
    const std::vector<double> all = archive.read(name);
    std::vector<unsigned int> owner(all.size() / size, n_ranks);
    for (std::size_t i = 0; i < owner.size(); ++i)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = all[i * size + d]; // at the beginning of a row
        if (transfer->owns(x))
          owner[i] = rank;
      }
    Utilities::MPI::min(owner, comm, owner);
    std::vector<double> own;
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (owner[i] % n_ranks == rank) // points without owner go to the first
        own.insert(own.end(), &all[i * size], &all[i * size] + size);
    return own;
  }

  void
  ExplicitPoints::load(const Archive &archive)
  {
    StateRow list = archive.read_row("groups");
    all_groups.clear();
    while (!list.at_end())
      {
        unsigned int material = 0;
        bool         ramped   = false;
        std::string  variables;
        list(material, ramped, variables);
        if (material >= scene->materials.size())
          throw RunError("the checkpoint has other materials");
        all_groups.push_back(make_group(material));
        PointArrays &group = all_groups.back();
        group.ramped       = ramped;
        check_variables(variables, group.variables());
        const unsigned int        size = group.n_numbers();
        const std::vector<double> rows = points_of_rank(
          archive, "points " + std::to_string(all_groups.size() - 1), size);
        group.set_capacity(rows.size() / size);
        for (std::size_t i = 0; i < rows.size(); i += size)
          group.append(&rows[i]);
        group.pad();
      }
  }

  void
  ExplicitMPM::state_of_all(StateRow &row)
  {
    row(n_steps,
        fade_end,
        last_step,
        gravity,
        damping.energy,
        damping.rising,
        stage_start,
        progress.begun,
        progress.now,
        progress.report);
    body.state_of_all(row);
    if (boundary)
      boundary->state(row);
    if (obstacles)
      obstacles->state_of_all(row);
  }

  void
  ExplicitMPM::state_of_ranks(StateRow &row)
  {
    row(sum, *nodes);
    if (obstacles)
      obstacles->state_of_ranks(row);
    body.state_of_ranks(row);
  }

  void
  ExplicitMPM::save(Archive &archive)
  {
    StateRow of_all, of_ranks;
    state_of_all(of_all);
    archive.write_row("explicit", of_all);
    state_of_ranks(of_ranks);
    archive.write("explicit sums", of_ranks.values());
    body.save(archive);
    // Continued and resumed runs thus start from the same nodes.
    must_refresh = true;
  }

  void
  ExplicitMPM::load(const Archive &archive)
  {
    StateRow of_all = archive.read_row("explicit");
    state_of_all(of_all);
    // Sums of ranks that no longer exist go to the first one.
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
          own[size - 1] = std::max(own[size - 1], sums_of_ranks[i]); // maxima
        else
          own[i % size] += sums_of_ranks[i];
    else
      own = mine.values();
    StateRow row(own);
    state_of_ranks(row);
    body.load(archive);
    must_refresh = true;
  }
} // namespace geocone::GEOCONE_DIM
