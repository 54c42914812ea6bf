// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/cell_record.h>
#include <geocone/discretisation/history_start.h>
#include <geocone/discretisation/particles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

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
            if (foot.distance(x) < length_of(volume) &&
                condition.holds_at(foot))
              return true;
          }
      return false;
    }

    Point<dim>
    point_of(const double *coordinates)
    {
      Point<dim> x;
      std::copy_n(coordinates, dim, x.begin_raw());
      return x;
    }
  } // namespace

  Point<dim>
  Particles::inside(const Point<dim> &unit) const
  {
    if (margin == 0.)
      return unit;
    Point<dim> moved;
    for (unsigned int d = 0; d < dim; ++d)
      moved[d] = std::clamp(unit[d], margin, 1. - margin);
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      sum += moved[d];
    if (search->mesh_is_simplicial() && sum > 1. - margin)
      moved *= (1. - margin) / sum;
    return moved;
  }

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

    // What a particle has is one row of numbers.
    MaterialPoints one;
    one.n_history = n_history = scene.materials.n_history();
    one.resize(1, true);
    StateRow row;
    one.state(0, row);
    n_state = row.values().size();
    search  = std::make_unique<CellSearch>(mesh);
    margin  = space.is_spline() ? 0. : 1e-6;

    unsigned int       first = 0;
    const unsigned int n     = seeds.size();
    MPI_Exscan(&n, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
    const auto  &conditions = scene.dirichlet.list;
    HistoryStart start;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Seed            &seed = seeds[i];
        const ConstitutiveLaw &law  = scene.materials.law(seed.material);
        one.weight[0]               = seed.volume;
        one.material[0]             = seed.material;
        one.mass[0]                 = seed.volume * law.density();
        one.velocity[0]             = seed.velocity;
        one.stress[0]               = seed.stress;
        start.set(law,
                  stress_of(extended(seed.stress, seed.stress_zz)),
                  space.band_width(seed.cell),
                  seed.position,
                  one.history.data());
        one.held_by[0] = 0;
        for (unsigned int c = 0; c < conditions.size(); ++c)
          if (conditions[c]->holds() == Imposition::On::particles &&
              in_first_row(
                *conditions[c], scene.geometry, seed.position, seed.volume))
            one.held_by[0] = c + 1;
        std::vector<double> *to = &states;
        if (scene.loading.adds(scene.materials.name(seed.material)))
          {
            Waiting &later  = waiting[seed.material];
            to              = &later.states;
            one.velocity[0] = Tensor<1, dim>();
            later.id.push_back(first + i);
            later.position.push_back(seed.position);
          }
        else
          places.push_back({first + i, unknown_cell, seed.position, {}});
        to->resize(to->size() + n_state);
        StateRow row(&(*to)[to->size() - n_state], false);
        one.state(0, row);
      }
    start.check<InputError>(comm);
    sort();

    const unsigned int k    = seeding.points_per_direction();
    const unsigned int want = mesh.is_simplicial() ? 4 : 3;
    if (space.degree() == 3 && !space.is_spline() && k > 0 && k < want)
      return format("%s with fewer than %u x %u particles per cell: functions "
                    "that no particle sees move freely, loads come out far too "
                    "low; take 'Particles/Points per direction' = %u%s",
                    space.element().c_str(),
                    want,
                    want,
                    want,
                    mesh.is_simplicial() ? " and 'Layout' = sub-cells"
                                         : ", or B-splines");
    return "";
  }

  MaterialPoints
  Particles::collect(const BackgroundMesh &mesh, const Space &space) const
  {
    MaterialPoints     points;
    const unsigned int n_points = places.size();
    const unsigned int n        = space.nodes_per_cell();
    points.n_nodes              = n;
    points.n_history            = n_history;
    points.resize(n_points, true);
    points.values.resize(n_points * n);
    points.gradients.resize(n_points * dim * n);

    std::vector<types::global_dof_index> nodes;
    std::vector<Tensor<1, dim>>          unit_gradient(n);
    std::vector<double>                  state(n_state);
    for (unsigned int p = 0; p < n_points; ++p)
      {
        const Place &place = places[p];
        const auto   cell  = search->cell(place.cell);
        if (p == 0 || place.cell != places[p - 1].cell)
          {
            if (p > 0)
              points.first_point.push_back(p);
            points.cells.push_back(cell);
            space.cell_nodes(cell, nodes);
            for (const types::global_dof_index node : nodes)
              points.nodes.push_back(space.local_node(node));
          }
        const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, place.unit);
        space.evaluate(
          cell, place.unit, &points.values[p * n], unit_gradient.data());
        for (unsigned int i = 0; i < n; ++i)
          {
            const Tensor<1, dim> gradient = unit_gradient[i] * inverse;
            for (unsigned int c = 0; c < dim; ++c)
              points.gradients[(p * dim + c) * n + i] = gradient[c];
          }
        if (mesh.is_axisymmetric())
          for (unsigned int i = 0; i < n; ++i)
            points.hoop.push_back(points.values[p * n + i] / place.position[0]);
        points.position[p] = place.position;
        points.id[p]       = place.id;
        std::copy_n(&states[p * n_state], n_state, state.begin());
        StateRow row(state.data(), true);
        points.state(p, row);
      }
    if (n_points > 0)
      points.first_point.push_back(n_points);
    if (space.has_b_bar())
      project_gradients(space.degree() - 1, points);
    return points;
  }

  void
  Particles::save(Archive &archive, const BackgroundMesh &mesh)
  {
    CellRecord          cells;
    std::vector<double> values;
    std::size_t         p = 0;
    for (const auto &cell : mesh.own_cells())
      {
        const std::size_t first = p;
        for (; p < places.size() && places[p].cell == cell->active_cell_index();
             ++p)
          {
            const Place &place = places[p];
            values.push_back(place.id);
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(place.position[d]);
            // With all its digits, which a search would not give again.
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(place.unit[d]);
            values.insert(values.end(),
                          &states[p * n_state],
                          &states[p * n_state] + n_state);
          }
        cells.add(cell, p - first);
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
    const std::size_t         size   = 1 + 2 * dim + n_state;
    const std::vector<double> values = archive.read("particles/state");
    const CellRecord          cells(archive.read("particles/cells"),
                           values.size() / size);
    places.clear();
    states.clear();
    for (const auto &cell : mesh.own_cells())
      {
        const auto [begin, end] = cells.range(cell);
        for (std::size_t i = begin; i < end; ++i)
          {
            const double *x = &values[i * size];
            places.push_back({static_cast<unsigned int>(x[0]),
                              cell->active_cell_index(),
                              point_of(x + 1),
                              point_of(x + 1 + dim)});
            states.insert(states.end(), x + 1 + 2 * dim, x + size);
          }
      }
    archive.read_row("particles/lost")(n_lost_all);
  }

  void
  Particles::keep(const std::vector<bool> &stays)
  {
    std::size_t n = 0;
    for (std::size_t p = 0; p < places.size(); ++p)
      if (stays[p])
        {
          places[n] = places[p];
          std::copy_n(&states[p * n_state], n_state, &states[n_state * n++]);
        }
    places.resize(n);
    states.resize(n * n_state);
  }

  unsigned long
  Particles::add(const unsigned int material)
  {
    const Waiting &now = waiting[material];
    for (std::size_t i = 0; i < now.id.size(); ++i)
      places.push_back({now.id[i], unknown_cell, now.position[i], {}});
    states.insert(states.end(), now.states.begin(), now.states.end());
    const unsigned long n = Utilities::MPI::sum(now.id.size(), comm);
    waiting.erase(material);
    sort();
    return n;
  }

  std::vector<Particles::Place>
  Particles::sort()
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, std::vector<double>> leaving;
    std::vector<Place>                          lost;
    std::size_t                                 n = 0; // that stay
    for (std::size_t p = 0; p < places.size(); ++p)
      {
        Place       place = places[p];
        const auto *state = &states[p * n_state];
        const auto  found =
          search->find(place.position,
                       place.cell == unknown_cell ? BackgroundMesh::Cell()
                                                  : search->cell(place.cell));
        if (!found)
          {
            lost.push_back(place);
            continue;
          }
        place.cell               = found->cell->active_cell_index();
        place.unit               = inside(found->unit);
        const unsigned int owner = search->owner(found->cell);
        if (owner == rank)
          {
            places[n] = place;
            std::copy(state, state + n_state, &states[n_state * n++]);
            continue;
          }
        std::vector<double> &message = leaving[owner];
        message.insert(message.end(), {double(place.id), double(place.cell)});
        for (const Point<dim> *x : {&place.position, &place.unit})
          message.insert(message.end(), x->begin_raw(), x->end_raw());
        message.insert(message.end(), state, state + n_state);
      }
    places.resize(n);
    states.resize(n * n_state);
    if (Utilities::MPI::logical_or(!leaving.empty(), comm))
      for (const auto &[sender, message] :
           Utilities::MPI::some_to_some(comm, leaving))
        for (std::size_t i = 0; i < message.size(); i += 2 + 2 * dim + n_state)
          {
            const double *x = &message[i];
            places.push_back({static_cast<unsigned int>(x[0]),
                              static_cast<unsigned int>(x[1]),
                              point_of(x + 2),
                              point_of(x + 2 + dim)});
            x += 2 + 2 * dim;
            states.insert(states.end(), x, x + n_state);
          }

    // By cell and number: an order that no history and no number of ranks changes.
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return std::tie(places[a].cell, places[a].id) <
             std::tie(places[b].cell, places[b].id);
    });
    if (!std::is_sorted(order.begin(), order.end()))
      {
        std::vector<Place>  sorted_places;
        std::vector<double> sorted_states;
        sorted_places.reserve(places.size());
        sorted_states.reserve(states.size());
        for (const std::size_t p : order)
          {
            sorted_places.push_back(places[p]);
            sorted_states.insert(sorted_states.end(),
                                 &states[p * n_state],
                                 &states[p * n_state] + n_state);
          }
        places = std::move(sorted_places);
        states = std::move(sorted_states);
      }
    return lost;
  }

  void
  Particles::store(MaterialPoints &points)
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        places[p].position = points.position[p];
        StateRow row(&states[p * n_state], false);
        points.state(p, row);
      }
  }

  void
  Particles::move(MaterialPoints &points)
  {
    store(points);
    const std::vector<Place> lost = sort();

    const unsigned int n_now = Utilities::MPI::sum(lost.size(), comm);
    n_lost_all += n_now;
    if (n_now > 0 && outflow.is_error())
      {
        std::string which;
        if (!lost.empty())
          which = format("particle %u at (%s)",
                         lost[0].id,
                         text_of_place(lost[0].position).c_str());
        throw StepFailure(
          format("%u particles left the background mesh, e.g. ", n_now) +
          text_of_any_rank(comm, which) +
          "\n  remedy:  enlarge 'Mesh/Box', or let them go with "
          "'Particles/Outflow = count'");
      }
  }
} // namespace geocone
