// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/cell_record.h>
#include <geocone/discretisation/particles.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /**
     * Whether a particle lies in the first row under the part of the body's
     * sides that a condition holds: nearer than the side of its own square.
     */
    bool
    in_first_row(const BoundaryCondition &condition,
                 const Geometry          &geometry,
                 const Point<dim>        &x,
                 const double             volume)
    {
      for (const auto &[name, id] : geometry.sides)
        if (condition.is_on_side(name))
          {
            const auto       ends = geometry.side_ends(id);
            const Point<dim> foot = nearest_on_segment(x, ends[0], ends[1]);
            if (foot.distance(x) < std::sqrt(volume) && condition.in_box(foot))
              return true;
          }
      return false;
    }
  } // namespace

  Particles::Particles(const ParameterFile &file)
    : seeding(file)
  {}

  std::string
  Particles::prepare(const Scene          &scene,
                     const BackgroundMesh &mesh,
                     const Space          &space)
  {
    comm = mesh.triangulation().get_communicator();
    seeding.prepare(scene);
    const std::vector<Seed> seeds = seeding.make(scene, mesh);

    // What a particle has is one row of numbers: its state and, while it moves,
    // how far it has still to go.
    MaterialPoints one;
    one.n_history = n_history = scene.materials.n_history();
    one.resize(1, true);
    StateRow row;
    one.state(0, row);
    n_state = row.values().size();

    handler = std::make_unique<dealii::Particles::ParticleHandler<dim>>(
      mesh.triangulation(), mesh.mapping(), n_state + dim);
    handler->signals.particle_lost.connect(
      [this](const auto &particle, const auto &cell) {
        const auto properties = particle->get_properties();
        lost.push_back({static_cast<unsigned int>(particle->get_id()),
                        particle->get_location(),
                        {properties.begin(), properties.end()},
                        cell});
      });

    unsigned int       first = 0;
    const unsigned int n     = seeds.size();
    MPI_Exscan(&n, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
    const auto &conditions = scene.dirichlet.list;
    // Any cell will do: sorting finds the right one.
    const auto cells = mesh.own_cells();
    for (unsigned int i = 0; i < n; ++i)
      {
        const Seed            &seed = seeds[i];
        const ConstitutiveLaw &law  = scene.materials.law(seed.material);
        one.weight[0]               = seed.volume;
        one.material[0]             = seed.material;
        one.mass[0]                 = seed.volume * law.density();
        one.velocity[0]             = seed.velocity;
        one.stress[0]               = seed.stress;
        law.initialise(plane_strain_stress(seed.stress, seed.stress_zz),
                       one.history.data());
        one.held_by[0] = 0;
        for (unsigned int c = 0; c < conditions.size(); ++c)
          if (conditions[c]->holds() == Imposition::On::particles &&
              in_first_row(
                *conditions[c], scene.geometry, seed.position, seed.volume))
            one.held_by[0] = c + 1;
        std::vector<double> properties(n_state + dim, 0.);
        StateRow            row(properties.data(), false);
        one.state(0, row);
        handler->insert_particle(seed.position,
                                 Point<dim>(-1., -1.),
                                 first + i,
                                 *cells.begin(),
                                 ArrayView<const double>(properties));
      }
    handler->update_cached_numbers();
    sort();

    if (space.degree() == 3 && !space.is_spline() &&
        seeding.points_per_direction() > 0 &&
        seeding.points_per_direction() < 3)
      return "Q3 with fewer than 3 x 3 particles per cell: functions that no "
             "particle sees move freely, loads come out far too low; take "
             "'Particles/Points per direction' = 3, or B-splines";
    return "";
  }

  MaterialPoints
  Particles::collect(const BackgroundMesh &mesh, const Space &space) const
  {
    MaterialPoints     points;
    const unsigned int n_points = handler->n_locally_owned_particles();
    const unsigned int n        = space.nodes_per_cell();
    points.n_nodes              = n;
    points.n_history            = n_history;
    points.resize(n_points, true);
    points.values.resize(n_points * n);
    points.gradients.resize(n_points * dim * n);

    std::vector<types::global_dof_index> nodes;
    std::vector<Tensor<1, dim>>          unit_gradient(n);
    unsigned int                         p = 0;
    for (const auto &cell : mesh.own_cells())
      {
        const auto particles = handler->particles_in_cell(cell);
        if (particles.begin() == particles.end())
          continue;
        points.cells.push_back(cell);
        space.cell_nodes(cell, nodes);
        for (const types::global_dof_index node : nodes)
          points.nodes.push_back(space.local_node(node));
        for (auto &particle : particles)
          {
            const Point<dim>    &unit    = particle.get_reference_location();
            const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
            space.evaluate(
              cell, unit, &points.values[p * n], unit_gradient.data());
            for (unsigned int i = 0; i < n; ++i)
              {
                const Tensor<1, dim> gradient = unit_gradient[i] * inverse;
                for (unsigned int c = 0; c < dim; ++c)
                  points.gradients[(p * dim + c) * n + i] = gradient[c];
              }
            points.position[p] = particle.get_location();
            points.id[p]       = particle.get_id();
            StateRow row(particle.get_properties().begin(), true);
            points.state(p, row);
            ++p;
          }
        points.first_point.push_back(p);
      }
    if (space.has_b_bar())
      average_gradients(points);
    return points;
  }

  void
  Particles::save(Archive &archive, const BackgroundMesh &mesh)
  {
    CellRecord          cells;
    std::vector<double> values;
    for (const auto &cell : mesh.own_cells())
      {
        cells.add(cell, handler->n_particles_in_cell(cell));
        for (const auto &particle : handler->particles_in_cell(cell))
          {
            values.push_back(particle.get_id());
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(particle.get_location()[d]);
            // With all its digits, which a search would not give again.
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(particle.get_reference_location()[d]);
            const auto state = particle.get_properties();
            values.insert(values.end(), state.begin(), state.end());
          }
      }
    archive.write("particles/cells", cells.numbers);
    archive.write("particles/state", values);
    StateRow row;
    row(n_lost_all);
    archive.write_row("particles/lost", row);
  }

  void
  Particles::load(const Archive &archive, const BackgroundMesh &mesh)
  {
    const std::size_t         size   = 1 + 2 * dim + n_state + dim;
    const std::vector<double> values = archive.read("particles/state");
    const CellRecord          cells(archive.read("particles/cells"),
                           values.size() / size);
    handler->clear_particles();
    for (const auto &cell : mesh.own_cells())
      {
        const auto [begin, end] = cells.range(cell);
        for (std::size_t i = begin; i < end; ++i)
          {
            const double *x = &values[i * size];
            handler->insert_particle(
              Point<dim>(x[1], x[2]),
              Point<dim>(x[3], x[4]),
              static_cast<unsigned int>(x[0]),
              cell,
              ArrayView<const double>(x + 1 + 2 * dim, n_state + dim));
          }
      }
    handler->update_cached_numbers();
    archive.read_row("particles/lost")(n_lost_all);
  }

  void
  Particles::sort()
  {
    const std::vector<Lost> lost_before = std::move(lost);
    lost.clear();
    handler->sort_particles_into_subdomains_and_cells();
    // A particle on a face may seem to lie outside of all cells, by rounding:
    // those are tried again a little nearer to where they came from.
    if (Utilities::MPI::sum(lost.size(), comm) > 0)
      {
        const std::vector<Lost> again = std::move(lost);
        lost.clear();
        for (const Lost &particle : again)
          handler->insert_particle(
            particle.position +
              1e-10 * (particle.last_cell->center() - particle.position),
            Point<dim>(-1., -1.),
            particle.id,
            particle.last_cell,
            ArrayView<const double>(particle.properties));
        handler->update_cached_numbers();
        handler->sort_particles_into_subdomains_and_cells();
      }
    lost.insert(lost.begin(), lost_before.begin(), lost_before.end());
  }

  void
  Particles::move(MaterialPoints &points)
  {
    // The library finds a particle in the cells around its old one, which on
    // several ranks may be all that is known: far moves go in parts.
    unsigned int p = 0, n_parts = 1;
    for (const auto &cell : points.cells)
      for (auto &particle : handler->particles_in_cell(cell))
        {
          const auto           state = particle.get_properties();
          const Tensor<1, dim> move =
            points.position[p] - particle.get_location();
          for (unsigned int c = 0; c < dim; ++c)
            {
              state[n_state + c] = move[c];
              n_parts            = std::max<unsigned int>(
                n_parts,
                std::ceil(std::abs(move[c]) / cell->extent_in_direction(c)));
            }
          StateRow row(state.begin(), false);
          points.state(p++, row);
        }
    lost.clear();
    n_parts = Utilities::MPI::n_mpi_processes(comm) == 1
                ? 1
                : Utilities::MPI::max(n_parts, comm);
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        for (auto &particle : *handler)
          {
            const auto state = particle.get_properties();
            particle.set_location(
              particle.get_location() +
              Tensor<1, dim>(
                {state[n_state] / n_parts, state[n_state + 1] / n_parts}));
          }
        sort();
      }

    const unsigned int n_now = Utilities::MPI::sum(lost.size(), comm);
    n_lost_all += n_now;
    if (n_now > 0 && outflow.is_error())
      {
        std::string which;
        if (!lost.empty())
          which = format("particle %u at (%g, %g)",
                         lost[0].id,
                         lost[0].position[0],
                         lost[0].position[1]);
        throw StepFailure(
          format("%u particles left the background mesh, e.g. ", n_now) +
          text_of_any_rank(comm, which) +
          "\n  remedy:  enlarge 'Mesh/Box', or let them go with "
          "'Particles/Outflow = count'");
      }
  }
} // namespace geocone
